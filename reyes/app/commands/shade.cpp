#include "reyes/app/commands/shade.h"

#include <filesystem>

#include "reyes/app/commands/render.h"
#include "reyes/app/exit_code.h"
#include "reyes/app/frame/granted.h"
#include "reyes/app/frame/shot.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/app/watch/stats_json.h"
#include "reyes/base/parallel.h"
#include "reyes/base/temporary_folder.h"

namespace tomales {
namespace {

int runOnShot(const RenderSettings& asked, void (ShotJob::*work)()) {
  const OrderlyEnd orderly;
  const auto start = std::chrono::steady_clock::now();
  Log log(asked.verbosity);
  const RenderSettings settings = asGranted(asked, log);
  const ThreadLimit threads(settings.threads);
  Stats stats;
  if (const auto job = ShotJob::open(settings, stats, log)) (job.get()->*work)();
  const std::chrono::duration<double> total = std::chrono::steady_clock::now() - start;
  writeLastStats(settings, stats, total.count(), log);
  const int code = interruptExitCode();
  return code ? code : exitCodeOf(log, settings.strict);
}

}  // namespace

int shadeCommand(const RenderSettings& settings) { return runOnShot(settings, &ShotJob::shadePicture); }
int gatherCommand(const RenderSettings& settings) { return runOnShot(settings, &ShotJob::gatherIrradiance); }

int relightFirst(RelightCommand command) {
  if (std::filesystem::path(command.render.files.front()).extension() == ".dfb") return relightCommand(command);
  const TemporaryFolder folder(std::filesystem::temp_directory_path());
  RenderSettings hide = command.render;
  hide.output = (folder.path() / "shot.dfb").string();
  const int code = hideCommand(hide);
  if (!std::filesystem::exists(hide.output)) return code;
  command.render.files = {hide.output};
  return relightCommand(command);
}

}  // namespace tomales
