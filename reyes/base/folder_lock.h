// Of the processes that make the files of a folder together, one at a time: the next finds them made, or
// makes all of its own. Threads: plain object.
#pragma once
#include <filesystem>
#include <functional>

namespace tomales {

class FolderLock {
 public:
  /// Waits for other processes, after it has called `waits` if it must; throws Stopped (reyes/base/stop.h).
  /// Where folders cannot be locked, as over networks, nobody waits. Pre: the folder is there, and no
  /// TemporaryFolder, which is locked already.
  FolderLock(const std::filesystem::path& folder, const std::function<void()>& waits);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  const int descriptor_;
};

}  // namespace tomales
