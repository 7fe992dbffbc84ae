// Finds the file that an #include means, and tells whether it may be read.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "reyes/rsl/preprocess.h"

namespace tomales::compiler {

/// The text of a file with every end of a line as '\n', or why it cannot be read.
struct ReadFile {
  std::string path, text;
  std::string failure;  ///< Part of a sentence, such as "there is no such file"; empty if there was none.
};

ReadFile readFile(const std::string& path);
/// Makes a ReadFile of a text that is in no file.
ReadFile asFile(const std::string& name, std::string text);

class IncludeSearch {
 public:
  /// `ownFolder` is the folder of the shader's file; empty for a text without a file.
  IncludeSearch(const PreprocessOptions& options, const std::string& ownFolder);
  /// `fromFolder` is the folder of the including file.
  ReadFile find(std::string_view name, bool isQuoted, const std::string& fromFolder) const;

 private:
  bool isPermitted(const std::string& realPath) const;
  /// Returns false if the way from the folder to the real path leads over symbolic links.
  bool isHeaderOfCollection(const std::string& folder, const std::string& wanted, const std::string& real) const;
  std::vector<std::string> folders_;    ///< Folders in the order in which they are searched.
  bool standard_;                       ///< True if the renderer's own headers come last.
  std::vector<std::string> permitted_;  ///< Paths without symbolic links.
  /// Folders in which collections of shaders keep their headers, as K-3D does above its folders of surfaces and
  /// displacements. Only headers are read from there, and not through links.
  std::vector<std::string> collections_;
};

/// Returns the folder part of a path: "." for a plain name.
std::string folderOf(const std::string& path);

}  // namespace tomales::compiler
