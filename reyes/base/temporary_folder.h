// A folder of this process alone for files that it needs for a while. Threads: plain object.
#pragma once
#include "reyes/base/scratch_path.h"

namespace tomales {

/// The folder is removed with everything in it at the end. Whoever still has a file open can go on reading it.
class TemporaryFolder {
 public:
  /// Makes it in `parent`. Throws std::filesystem::filesystem_error.
  explicit TemporaryFolder(const std::filesystem::path& parent)
      : place_(parent, "tomales", ScratchPath::Kind::Folder) {}

  const std::filesystem::path& path() const { return place_.path(); }

 private:
  const ScratchPath place_;
};

}  // namespace tomales
