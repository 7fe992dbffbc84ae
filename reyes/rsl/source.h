// A place in the text of a shader, and the messages about it, with the line and a caret. Threads: a Sources and its
// Messages belong to one compilation.
#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace tomales::compiler {

/// A character of a file. Lines and columns count from 1; line 0 is no place, for instance a definition of -D.
struct Place {
  int32_t file = -1;  ///< An index into Sources::files.
  int32_t line = 0, column = 0;
  int32_t expansion = -1;  ///< The macro whose text this is, an index into Sources::expansions; -1 if none.
  bool operator==(const Place&) const = default;
};

struct SourceFile {
  std::string path;      ///< The path that messages print.
  std::string text;      ///< Lines end by '\n'.
  Place includedFrom{};  ///< The place of the #include; line 0 for the main file.
};

/// One use of a macro. Text that it makes has the place of the macro's definition.
struct Expansion {
  std::string macro;
  Place use{};  ///< The place of the macro's name. Inside another macro that place has an expansion itself.
};

/// The files of one compilation. Files and expansions are only added, so places stay valid.
class Sources {
 public:
  int32_t addFile(SourceFile file);
  int32_t addExpansion(Expansion expansion);
  const SourceFile& file(int32_t index) const { return files_[static_cast<size_t>(index)]; }
  const Expansion& expansion(int32_t index) const { return expansions_[static_cast<size_t>(index)]; }
  size_t fileCount() const { return files_.size(); }
  /// Returns the text of a line, without its end. Empty if there is no such line.
  std::string_view line(int32_t file, int32_t line) const;
  /// Returns the place where the outermost enclosing macro is used, or the place itself if it is in no macro.
  Place outermost(Place place) const;
  /// Returns "file:line:column".
  std::string text(Place place) const;

 private:
  std::deque<SourceFile> files_;
  std::deque<std::vector<size_t>> lineStarts_;  ///< The offsets of the lines of each file in its text.
  std::deque<Expansion> expansions_;
};

enum class Severity : uint8_t { Error, Warning, Note };

struct Message {
  Severity severity = Severity::Error;
  Place place{};
  int32_t length = 1;  ///< The number of characters that the caret underlines.
  std::string text;    ///< One sentence without a full stop and without a capital: "expected ';' before 'float'".
};

/// The problems of a shader, in the order in which they were found. A note belongs to the message before it.
/// Each is kept once, since a class that is a shader of two kinds is checked twice.
class Messages {
 public:
  void error(Place place, std::string text, int32_t length = 1);
  void warning(Place place, std::string text, int32_t length = 1);
  /// Warns of something that the shader needs and that does not exist. The shader runs with a substitute.
  void missing(Place place, std::string text, int32_t length = 1);
  int missingCount() const { return missing_; }
  void note(Place place, std::string text, int32_t length = 1);
  bool hasErrors() const { return errors_ > 0; }
  int errorCount() const { return errors_; }
  const std::vector<Message>& all() const { return all_; }
  /// More errors than this are counted but not kept; the same holds for warnings, and for the notes of one message.
  static constexpr int kMostErrors = 20;

  /// Returns the messages in the form of common compilers: "file:line:column: error: text", the line, a caret below it,
  /// and one line for each macro and each #include that the place comes from.
  std::string rendered(const Sources& sources) const;

 private:
  bool isTold(Severity severity, Place place, const std::string& text) const;
  void add(Severity severity, Place place, std::string text, int32_t length);
  std::vector<Message> all_;
  int errors_ = 0, warnings_ = 0, notes_ = 0, missing_ = 0;
  bool keeps_ = true;  ///< True if the error or warning that notes now belong to is kept.
};

/// Returns the names that `wanted` may be a misspelling of, at most `most`, nearest first. Capitals count least.
std::vector<std::string> nearNames(std::string_view wanted, const std::vector<std::string>& known, size_t most = 1);

}  // namespace tomales::compiler
