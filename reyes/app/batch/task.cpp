#include "reyes/app/batch/task.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <thread>

#include "reyes/app/exit_code.h"
#include "reyes/app/watch/cpu_time.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/base/chunk_file.h"
#include "reyes/base/nursery.h"
#include "reyes/base/process.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kPause{20};
constexpr std::chrono::seconds kBeforeRetry{2};

}  // namespace

RunningTask::RunningTask(const BatchPlan& plan, const BatchTask& task, int attempt)
    : plan_(plan), task_(task), start_(std::chrono::steady_clock::now()) {
  const fs::path log = plan.logOf(task);
  const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666),
            in = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const auto closeBoth = [&] {
    for (const int file : {in, out})
      if (file >= 0) ::close(file);
  };
  if (out < 0) {
    const std::string why = std::strerror(errno);
    closeBoth();
    throw WriteError(fmt::format("\"{}\" could not be written: {}", log.string(), why));
  }
  state_.kind = TaskState::Running;
  state_.attempts = attempt;
  state_.host = hostName();
  writeState(plan, task, state_);
  std::vector<std::string> arguments{"tomales"};
  arguments.insert(arguments.end(), task.arguments.begin(), task.arguments.end());
  int problem = 0;
  child_ = startInNursery(plan.workingFolder, log.string(), arguments);
  if (child_ < 0) child_ = startChild({"/proc/self/exe", arguments, {{in, 0}, {out, 1}, {out, 2}}}, problem);
  closeBoth();
  if (child_ < 0)
    throw WriteError(fmt::format("task \"{}\" could not be started: {}", task.name, std::strerror(problem)));
  guard_ = std::make_unique<ChildGuard>(child_);
}

bool RunningTask::ended() {
  if (state_.kind != TaskState::Running) return true;
  int status = 0;
  // The guard is destroyed before the process is waited for, because its process id may be reused afterwards.
  siginfo_t info{};
  const bool isOurs = ::waitid(P_PID, static_cast<id_t>(child_), &info, WEXITED | WNOHANG | WNOWAIT) == 0;
  if (isOurs ? info.si_pid == 0 : errno != ECHILD) return false;
  guard_.reset();
  rusage used{};
  if (!isOurs || ::wait4(child_, &status, 0, &used) != child_) status = W_EXITCODE(kNotBegun, 0);
  state_.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  state_.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  state_.cpu_s = secondsOf(used.ru_utime) + secondsOf(used.ru_stime);
  state_.peak_bytes = int64_t{used.ru_maxrss} * 1024;
  state_.kind = succeeded(state_.code) ? TaskState::Done : stopped_ ? TaskState::Waiting : TaskState::Failed;
  std::error_code none;
  const auto sizes = sizesOf(plan_, task_);
  state_.sizes = sizes.value_or(std::vector<int64_t>());
  if (state_.kind == TaskState::Done && !sizes) state_.kind = TaskState::Failed;
  writeState(plan_, task_, state_);
  if (state_.kind == TaskState::Done)
    for (const std::string& file : task_.removes) fs::remove(fs::path(plan_.workingFolder) / file, none);
  return true;
}

void RunningTask::stop() {
  if (!stopped_ && state_.kind == TaskState::Running) ::kill(child_, SIGTERM);
  stopped_ = true;
}

int runTask(const BatchPlan& plan, const std::string& name) {
  const BatchTask* task = plan.find(name);
  if (!task) throw FileError(fmt::format("the plan \"{}\" has no task \"{}\"", plan.file.string(), name));
  const TaskState before = readState(plan, *task);
  if (before.kind == TaskState::Done && before.sizes == sizesOf(plan, *task)) return kDone;
  fs::current_path(plan.workingFolder);
  const OrderlyEnd orderly;
  for (int attempt = 1;; ++attempt) {
    RunningTask run(plan, *task, attempt);
    while (!run.ended()) {
      if (stopRequested()) run.stop();
      std::this_thread::sleep_for(kPause);
    }
    if (run.state().kind == TaskState::Done) return kDone;
    if (stopRequested()) return kRequeue;
    if (attempt == kMostAttempts) return kUnwritable;
    std::this_thread::sleep_for(kBeforeRetry);
  }
}

}  // namespace tomales
