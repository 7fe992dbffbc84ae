// Hidden buckets in a file beside the picture. With --resume the file keeps all of them, those of an interrupted run
// included. Otherwise it keeps those that do not fit in memory, and is removed when the program ends. Threads: any.
#pragma once
#include <atomic>
#include <mutex>

#include "reyes/app/settings.h"
#include "reyes/dfb.h"

namespace tomales {

class BucketFile {
 public:
  BucketFile(const Scene& scene, const DeepFrame& layout, int world, const RenderSettings& settings, Log& log);

  /// Returns nothing if the file has no bucket of this index.
  std::optional<DeepTile> tile(size_t index) const;
  /// Does nothing without --resume.
  void keepForResume(size_t index, const DeepTile& tile);
  void spill(size_t index, const DeepTile& tile);
  int64_t spilled() const { return spilled_; }  ///< The number of buckets that spill() has written.
  /// Tells that the picture is written, so that nothing is left to resume.
  void forget();

 private:
  DfbWriter* opened() const;
  std::unique_ptr<DfbWriter> openUnnamed(std::string& error) const;

  const std::string picture_;
  const DeepFrame layout_;
  Log& log_;
  const bool resumes_;
  mutable std::mutex opening_;
  std::unique_ptr<DfbWriter> file_;  ///< Set under the mutex, once, so a pointer to it stays good.
  std::atomic<int64_t> spilled_{0};
};

}  // namespace tomales
