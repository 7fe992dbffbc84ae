// A folder of one's own for files that somebody needs for a while.
// Threads: plain object.
#pragma once
#include "reyes/base/scratch_path.h"

namespace tomales {

/// Gone with everything in it at the end. What still has a file open can go on reading it.
class TemporaryFolder {
 public:
  /// In `parent`. Throws std::filesystem::filesystem_error.
  explicit TemporaryFolder(const std::filesystem::path& parent)
      : place_(parent, "tomales", ScratchPath::Kind::Folder) {}

  const std::filesystem::path& path() const { return place_.path(); }

 private:
  const ScratchPath place_;
};

}  // namespace tomales
