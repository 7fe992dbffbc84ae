// Which file an #include means, and whether it may be read.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "reyes/rsl/preprocess.h"

namespace tomales::compiler {

/// A file's text with every end of a line as '\n', or why there is none.
struct ReadFile {
  std::string path, text;
  std::string failure;  ///< As a part of a sentence: "there is no such file"; empty: none.
};

ReadFile readFile(const std::string& path);
/// A text that is in no file.
ReadFile asFile(const std::string& name, std::string text);

class IncludeSearch {
 public:
  /// `ownFolder`: of the shader's file; empty: a text without one.
  IncludeSearch(const PreprocessOptions& options, const std::string& ownFolder);
  /// `fromFolder`: of the including file.
  ReadFile find(std::string_view name, bool isQuoted, const std::string& fromFolder) const;

 private:
  bool isPermitted(const std::string& realPath) const;
  std::vector<std::string> folders_;    ///< In the order of the search.
  bool standard_;                       ///< The renderer's own headers come last.
  std::vector<std::string> permitted_;  ///< Without symbolic links.
};

/// The folder that a path names its file in: "." for a plain name.
std::string folderOf(const std::string& path);

}  // namespace tomales::compiler
