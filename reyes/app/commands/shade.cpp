#include "reyes/app/commands/shade.h"

#include "reyes/app/exit_code.h"
#include "reyes/app/frame/granted.h"
#include "reyes/app/frame/shot.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/app/watch/run_report.h"
#include "reyes/base/parallel.h"

namespace tomales {
namespace {

int runOnShot(const RenderSettings& asked, void (ShotJob::*work)()) {
  const OrderlyEnd orderly;
  Log log(asked.report.verbosity);
  RunReport report(asked, log);
  const RenderSettings settings = asGranted(asked, log);
  const ThreadLimit threads(settings.resources.threads);
  if (const auto job = ShotJob::open(settings, report.stats(), log)) {
    report.begin(job->frame());
    (job.get()->*work)();
    report.end({});
  }
  report.finish();
  const int code = interruptExitCode();
  return code ? code : exitCodeOf(log, settings.report.strict);
}

}  // namespace

int shadeCommand(const RenderSettings& settings) { return runOnShot(settings, &ShotJob::shadePicture); }
int gatherCommand(const RenderSettings& settings) { return runOnShot(settings, &ShotJob::gatherIrradiance); }

}  // namespace tomales
