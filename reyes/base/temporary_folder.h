// A folder of one's own for files that somebody needs for a while.
// Threads: plain object.
#pragma once
#include <filesystem>

namespace tomales {

/// Gone with everything in it at the end. What still has a file open can go on reading it.
class TemporaryFolder {
 public:
  /// In `parent`, with a name that nothing has. Throws std::filesystem::filesystem_error.
  explicit TemporaryFolder(const std::filesystem::path& parent);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace tomales
