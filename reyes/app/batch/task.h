// Runs one task of a plan as a process of its own, and keeps its state on the disk. Threads: plain object.
#pragma once
#include <sys/types.h>

#include <chrono>
#include <memory>

#include "reyes/app/batch/plan.h"
#include "reyes/base/child_process.h"

namespace tomales {

constexpr int kMostAttempts = 3;
/// Exit code of a task that was stopped and shall be run again elsewhere: EX_TEMPFAIL of sysexits.h.
constexpr int kRequeue = 75;

class RunningTask {
 public:
  /// Starts the program with the task's arguments; its messages are appended to the task's log. Throws WriteError.
  RunningTask(const BatchPlan& plan, const BatchTask& task, int attempt);
  /// Returns true when the process has ended. By then its state is written, and files that nobody needs any more are
  /// gone.
  bool ended();
  /// Asks the process to end, as a render farm does.
  void stop();
  const TaskState& state() const { return state_; }
  pid_t child() const { return child_; }
  const BatchTask& task() const { return task_; }

 private:
  const BatchPlan& plan_;
  const BatchTask& task_;
  TaskState state_;
  std::chrono::steady_clock::time_point start_;
  pid_t child_ = -1;
  std::unique_ptr<ChildGuard> guard_;
  bool stopped_ = false;
};

/// Runs a task until it has succeeded or has failed as often as tasks may; does nothing if it is done. Returns
/// an exit code: kRequeue after SIGTERM.
int runTask(const BatchPlan& plan, const std::string& name);

}  // namespace tomales
