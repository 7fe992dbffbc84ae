// Where a piece of a shader's text stands, and what is said about it: messages with the line and a caret.
// Threads: a Sources and its Messages belong to one compilation.
#pragma once
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace tomales::compiler {

/// A character of a file. Lines and columns count from 1; line 0: no place, as of a definition on the command line.
struct Place {
  int32_t file = -1;  ///< Of Sources::files.
  int32_t line = 0, column = 0;
  int32_t expansion = -1;  ///< Of Sources::expansions: the macro whose text this is; -1: none.
};

struct SourceFile {
  std::string path;      ///< As messages print it.
  std::string text;      ///< Lines end by '\n'.
  Place includedFrom{};  ///< Of the #include; line 0: the file that was asked for.
};

/// One use of a macro. Text that it makes has the place of the macro's definition.
struct Expansion {
  std::string macro;
  Place use{};  ///< Of the macro's name; within another macro it has an expansion of its own.
};

/// The files of one compilation. Files and expansions are only added, so places stay valid.
class Sources {
 public:
  int32_t addFile(SourceFile file);
  int32_t addExpansion(Expansion expansion);
  const SourceFile& file(int32_t index) const { return files_[static_cast<size_t>(index)]; }
  const Expansion& expansion(int32_t index) const { return expansions_[static_cast<size_t>(index)]; }
  size_t fileCount() const { return files_.size(); }
  /// The text of a line, without its end; empty: there is no such line.
  std::string_view line(int32_t file, int32_t line) const;
  /// Where the outermost macro is used that the place comes from; the place itself where none is.
  Place outermost(Place place) const;
  /// "file:line:column"
  std::string text(Place place) const;

 private:
  std::deque<SourceFile> files_;
  std::deque<std::vector<size_t>> lineStarts_;  ///< Of each file: where in its text.
  std::deque<Expansion> expansions_;
};

enum class Severity : uint8_t { Error, Warning, Note };

struct Message {
  Severity severity = Severity::Error;
  Place place{};
  int32_t length = 1;  ///< Characters that the caret underlines.
  std::string text;    ///< One sentence without a full stop, lower case at first: "expected ';' before 'float'".
};

/// What is wrong with a shader, in the order in which it was found. A note belongs to the message before it.
class Messages {
 public:
  void error(Place place, std::string text, int32_t length = 1);
  void warning(Place place, std::string text, int32_t length = 1);
  /// A warning of something that the shader needs and nobody has: it runs, with a substitute.
  void missing(Place place, std::string text, int32_t length = 1);
  int missingCount() const { return missing_; }
  void note(Place place, std::string text, int32_t length = 1);
  bool hasErrors() const { return errors_ > 0; }
  int errorCount() const { return errors_; }
  const std::vector<Message>& all() const { return all_; }
  /// More errors than this are counted and not kept; so with warnings, and with the notes of one message.
  static constexpr int kMostErrors = 20;

  /// As good compilers print them: "file:line:column: error: text", the line, a caret below it, and one line
  /// for each macro and each #include that the place comes from.
  std::string rendered(const Sources& sources) const;

 private:
  void add(Severity severity, Place place, std::string text, int32_t length);
  std::vector<Message> all_;
  int errors_ = 0, warnings_ = 0, notes_ = 0, missing_ = 0;
  bool keeps_ = true;  ///< The error or warning that notes now belong to.
};

/// The names that `wanted` may be a misspelling of, the nearest first, at most `most`. Capitals count least.
std::vector<std::string> nearNames(std::string_view wanted, const std::vector<std::string>& known, size_t most = 1);

}  // namespace tomales::compiler
