#include "reyes/app/commands/import.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "reyes/app/exit_code.h"
#include "reyes/base/child_process.h"
#include "reyes/base/chunk_file.h"
#include "reyes/base/input_file.h"
#include "reyes/base/process.h"
#include "reyes/base/temporary_folder.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

int statusOf(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

/// The user's own limit (ulimit -t) may be lower.
rlim_t limitOfChild_s(const model::Settings& settings) {
  rlimit now{};
  getrlimit(RLIMIT_CPU, &now);
  return std::min(now.rlim_cur, static_cast<rlim_t>(model::mostSeconds(settings)));
}

/// Runs the program that reads models, which reports what it leaves out. Returns the worst severity of these reports.
Severity read(const model::Settings& settings, Log& log) {
  const SourceLoc where{std::make_shared<const std::string>(settings.model), 0};
  const auto fail = [&](const std::string& what) {
    log.report(Severity::Error, "import-unreadable", where, "cannot be read: " + what);
    return Severity::Error;
  };
  const auto programs = besideProgram("tomales_assimp");
  if (programs.empty())
    return fail("the program tomales_assimp, which reads models, is neither beside this one nor in ../lib/tomales");
  std::vector<std::string> arguments = model::argumentsOf(settings);
  arguments.insert(arguments.begin(), programs.front().string());
  int problem = 0, status = 0;
  const pid_t child = startChild({programs.front(), arguments, {}}, problem);
  if (child < 0) return fail(std::string("tomales_assimp cannot be started: ") + std::strerror(problem));
  {
    const ChildGuard guard(child);
    siginfo_t ended;
    while (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
  }
  status = statusOf(child);
  const int answer = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  if (answer >= model::answerOf(Severity::Info) && answer <= model::answerOf(Severity::Output))
    return static_cast<Severity>(answer - model::kFirstAnswer);
  if (!WIFSIGNALED(status)) return fail("tomales_assimp ends without an answer");
  if (WTERMSIG(status) == SIGXCPU)
    return fail(fmt::format("Assimp has not read it within {} s of CPU time", limitOfChild_s(settings)));
  return fail(fmt::format("Assimp ends while it reads it ({})", strsignal(WTERMSIG(status))));
}

void move(const fs::path& from, const fs::path& to) {
  std::string error;
  if (!moveFinished(from, to, error)) throw WriteError(fmt::format("{} cannot be written: {}", to.string(), error));
}

/// Moves the files that the RIB names first, then the RIB.
void movePlaces(const model::Settings& made, const fs::path& scene) {
  if (fs::exists(made.parts)) {
    fs::create_directories(made.partsByName);
    for (const auto& part : fs::directory_iterator(made.parts))
      move(part.path(), fs::path(made.partsByName) / part.path().filename());
  }
  move(made.scene, scene);
}

}  // namespace

int importCommand(model::Settings settings) {
  Log log;
  Severity told = Severity::Info;
  guarded(log, [&] {
    if (const std::string problem = inputProblem(settings.model); !problem.empty())
      return log.report(Severity::Error, "import-unreadable", {std::make_shared<const std::string>(settings.model), 0},
                        "cannot be read: " + problem);
    const fs::path scene = fs::absolute(throughLinks(settings.scene));
    if (isAmong(scene, {settings.model})) throw WriteError(scene.string() + " is the model itself");
    if (!fs::is_directory(scene.parent_path()))
      throw WriteError(settings.scene + " cannot be written: its folder is missing");
    const TemporaryFolder scratch(scene.parent_path());
    settings.scene = (scratch.path() / scene.filename()).string();
    settings.parts = (scratch.path() / "parts").string();
    settings.partsByName = (scene.parent_path() / (scene.stem().string() + "_parts")).string();
    told = read(settings, log);
    if (told < Severity::Error) movePlaces(settings, scene);
  });
  return std::max(exitCodeOf(told), exitCodeOf(log));
}

}  // namespace tomales
