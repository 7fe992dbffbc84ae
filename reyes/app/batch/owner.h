// Keeps two processes from working on one plan, on one machine or on several that share its folder. Threads: plain
// object.
#pragma once
#include <chrono>

#include "reyes/app/batch/plan.h"
#include "reyes/base/folder_lock.h"

namespace tomales {

/// The process that runs the tasks of a plan. A lock keeps others of this machine away; for others that share the
/// folder, where locks may not reach, a file is renewed as long as the process lives.
class PlanOwner {
 public:
  /// Throws FileError if another process works on the plan, and WriteError.
  explicit PlanOwner(const BatchPlan& plan);
  ~PlanOwner();
  PlanOwner(const PlanOwner&) = delete;
  /// Call it often.
  void renew();
  /// Asks the process of this machine that works on the plan to end. Returns false if there is none.
  static bool endOther(const BatchPlan& plan);

 private:
  void write();

  const std::filesystem::path file_;
  const FolderLock lock_;
  std::chrono::steady_clock::time_point written_;
};

}  // namespace tomales
