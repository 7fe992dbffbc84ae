// Runs a plan on this machine, with several processes at a time.
#pragma once
#include <functional>

#include "reyes/app/batch/plan.h"

namespace tomales {

/// Runs all tasks that are not done, each up to kMostAttempts times. A task that keeps failing holds up only the tasks
/// that need it. It returns early when the process is asked to end, and `changed` is called after each task. Returns
/// the states.
std::vector<TaskState> runLocally(const BatchPlan& plan, int processes,
                                  const std::function<void(const std::vector<TaskState>&)>& changed);

}  // namespace tomales
