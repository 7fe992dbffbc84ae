// A new file or folder that is for this process alone and does not outlive it.
//
// Its name, `.STEM.RANDOM.part`, cannot be guessed, and an existing file of that name is never opened: neither another
// process of the same number, as containers have, nor a link that somebody has put there can interfere. It is locked
// (flock) while its owner lives. So a file that a killed process has left differs from one in use, and the next
// ScratchPath of the same stem in the same folder removes it. Where there are no locks, nothing is removed. Threads:
// plain object.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "reyes/base/abrupt_end.h"

namespace tomales {

class ScratchPath {
 public:
  enum class Kind { File, Folder };

  /// Makes it in `folder`. Throws std::filesystem::filesystem_error.
  ScratchPath(const std::filesystem::path& folder, const std::string& stem, Kind kind);
  ~ScratchPath();  ///< Removes it with all that is in it, unless released.
  ScratchPath(const ScratchPath&) = delete;
  ScratchPath& operator=(const ScratchPath&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Gives the caller the descriptor, which it has to close. It is that of the file, open for reading and writing, and
  /// holds the lock. Pre: it was not called before.
  int takeDescriptor() { return std::exchange(descriptor_, -1); }
  /// Gives up the path, because the file has been renamed or removed.
  void release();

 private:
  bool create(Kind kind);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::optional<AtAbruptEnd> removal_;
};

}  // namespace tomales
