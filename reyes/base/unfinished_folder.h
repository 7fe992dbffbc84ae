// A folder of several files that are of use only together. Each file is complete by itself (UnfinishedFile); a process
// that is ended between two of them leaves a mark in the folder. Threads: plain object.
#pragma once
#include <filesystem>

namespace tomales {

class UnfinishedFolder {
 public:
  /// Marks a folder, which must exist. Throws WriteError.
  explicit UnfinishedFolder(const std::filesystem::path& folder);
  /// Removes the mark; if it is not called, the mark stays.
  void finish();

 private:
  const std::filesystem::path mark_;
};

/// Throws FileError if the folder has a mark.
void requireFinished(const std::filesystem::path& folder);

}  // namespace tomales
