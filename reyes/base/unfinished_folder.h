// A folder of several files that make sense together alone, until all of them are there. Each file is whole by itself
// (UnfinishedFile); a process that is ended between two of them leaves a mark in the folder.
// Threads: plain object.
#pragma once
#include <filesystem>

namespace tomales {

class UnfinishedFolder {
 public:
  /// Marks a folder, which must exist. Throws WriteError.
  explicit UnfinishedFolder(const std::filesystem::path& folder);
  /// Takes the mark away; if it is not called, the mark stays.
  void finish();

 private:
  const std::filesystem::path mark_;
};

/// Throws FileError if the folder has a mark.
void requireFinished(const std::filesystem::path& folder);

}  // namespace tomales
