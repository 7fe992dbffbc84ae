// A lock on a folder for processes that make the files in it: one works at a time, and the next one finds the files
// finished, or makes all of them itself. Threads: plain object.
#pragma once
#include <filesystem>
#include <functional>

namespace tomales {

class FolderLock {
 public:
  /// Waits for other processes, and calls `waits` first if it has to. Throws Stopped (reyes/base/stop.h). Where folders
  /// cannot be locked, as on some network file systems, it does not wait. Pre: the folder exists and is no
  /// TemporaryFolder, which is locked already.
  FolderLock(const std::filesystem::path& folder, const std::function<void()>& waits);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  const int descriptor_;
};

}  // namespace tomales
