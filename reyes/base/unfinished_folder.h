// A folder on its way to be whole: several files that make sense together alone. Each of them is whole by itself
// (UnfinishedFile); who is ended between two of them leaves a mark.
// Threads: plain object.
#pragma once
#include <filesystem>

namespace tomales {

class UnfinishedFolder {
 public:
  /// Marks a folder that is there. Throws WriteError.
  explicit UnfinishedFolder(const std::filesystem::path& folder);
  /// Takes the mark away; without, it stays.
  void finish();

 private:
  const std::filesystem::path mark_;
};

/// Throws FileError for a folder with a mark.
void requireFinished(const std::filesystem::path& folder);

}  // namespace tomales
