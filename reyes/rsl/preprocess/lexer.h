// A file's text as words of the preprocessor (C90 6.1: preprocessing tokens), without comments and line continuations.
#pragma once
#include <deque>
#include <string>
#include <string_view>

#include "reyes/rsl/source.h"

namespace tomales::compiler {

enum class LexemeKind : uint8_t {
  Name,
  Number,  ///< A pp-number of C, which may be no valid number, such as "1x".
  String,  ///< A text with its quotes, and with escapes as written.
  Character,
  Punctuator,
  Other,    ///< A byte that begins none of these.
  Nothing,  ///< A placemarker: an empty argument during '##'.
  End       ///< Ends a file, a line (Lexer::nextInLine) or an argument.
};

struct Lexeme {
  LexemeKind kind = LexemeKind::End;
  bool spaceBefore = false, startsLine = false;
  bool isFinal = false;  ///< True for a macro's name that must not be replaced any more (C90 6.8.3.4).
  bool isOpen = false;   ///< True for a string without its closing quote.
  std::string_view text{};
  Place place{};
  bool is(std::string_view punctuator) const { return kind == LexemeKind::Punctuator && text == punctuator; }
  bool isEnd() const { return kind == LexemeKind::End; }
  int32_t length() const { return static_cast<int32_t>(text.size()); }
};

/// Holds texts that are in no file, for the views of lexemes.
class MadeTexts {
 public:
  static constexpr size_t kMostBytes = 16u << 20;
  std::string_view keep(std::string text) {
    bytes_ += text.size();
    return texts_.emplace_back(std::move(text));
  }
  bool isFull() const { return bytes_ > kMostBytes; }

 private:
  std::deque<std::string> texts_;
  size_t bytes_ = 0;
};

class Lexer {
 public:
  /// `text` must live as long as what is read from it; its lines end by '\n'.
  Lexer(int32_t file, std::string_view text, MadeTexts& made, Messages& messages);
  Lexeme next();
  /// Returns the next word of this line, or End at the line's end, which is left for next().
  Lexeme nextInLine();
  /// Returns the rest of the line as #error prints it.
  std::string_view restOfLine();
  /// Returns <NAME> if that is next on the line, and otherwise an empty text. `*place` is set to its beginning.
  std::string_view angledName(Place* place);
  /// Returns the comments directly before the last word of next(); empty if there are none.
  std::string_view commentBefore() const { return comment_; }

 private:
  struct Cursor {
    size_t at = 0, lineStart = 0;
    int32_t line = 1;
  };
  char look(Cursor& cursor) const;  ///< The character there, after continuations; '\0' at the end.
  char look() { return look(cursor_); }
  char lookBehind() const;  ///< The character after that of look().
  void step();
  bool atEnd(const Cursor& cursor) const { return cursor.at >= text_.size(); }
  bool skipBlanks(bool inLine);
  void skipBlockComment();
  void skipLineComment();
  void noteComment(size_t begin);
  Lexeme scan();
  void scanName();
  void scanNumber();
  bool scanQuoted(char quote);
  void scanPunctuator();
  Place place(const Cursor& cursor) const;
  std::string_view textFrom(size_t begin);

  int32_t file_;
  std::string_view text_;
  MadeTexts* made_;
  Messages* messages_;
  Cursor cursor_;
  std::string_view comment_;
  bool startsLine_ = true;
};

}  // namespace tomales::compiler
