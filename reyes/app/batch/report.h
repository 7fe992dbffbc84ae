// The state of a batch, for people and for farms. Threads: plain functions.
#pragma once
#include "reyes/app/batch/plan.h"

namespace tomales {

/// A task that failed.
struct BatchFailure {
  std::string task;
  std::vector<int> blocks;  ///< Numbers of other frames that cannot be made without it.
};

struct BatchReport {
  /// Numbers of frames. A frame is finished when all of its tasks are, and fails if one of them does; it is blocked if
  /// one of them needs a task that failed.
  std::vector<int> finished, running, failed, blocked, waiting;
  std::vector<BatchFailure> failures;
  double cpu_s = 0;
  int64_t peak_bytes = 0;
  /// Seconds left, estimated from the tasks that are done, with as many at a time as run now; negative: not known.
  double left_s = -1;

  size_t frames() const { return finished.size() + running.size() + failed.size() + blocked.size() + waiting.size(); }
};

BatchReport reportOf(const BatchPlan& plan, const std::vector<TaskState>& states);
/// Returns a line for each state, and the last lines of what failed.
std::string textOf(const BatchPlan& plan, const BatchReport& report);
std::string jsonOf(const BatchPlan& plan, const std::vector<TaskState>& states);
/// Returns a page that needs no other files: figures of each frame and small pictures of the finished ones.
std::string pageOf(const BatchPlan& plan, const std::vector<TaskState>& states);

}  // namespace tomales
