#include "reyes/rsl/preprocess/lexer.h"

#include <array>

namespace tomales::compiler {
namespace {

enum : uint8_t { kBlank = 1, kNameStart = 2, kDigit = 4 };

constexpr std::array<uint8_t, 256> kClasses = [] {
  std::array<uint8_t, 256> classes{};
  for (const char c : {' ', '\t', '\v', '\f', '\x1a'})
    classes[static_cast<unsigned char>(c)] = kBlank;  // 1a: DOS's end
  for (size_t c = 'a'; c <= 'z'; ++c) classes[c] = classes[c - 'a' + 'A'] = kNameStart;
  classes['_'] = kNameStart;
  for (size_t c = '0'; c <= '9'; ++c) classes[c] = kDigit;
  return classes;
}();

bool isClass(char c, uint8_t wanted) { return (kClasses[static_cast<unsigned char>(c)] & wanted) != 0; }

/// Punctuators of several characters. '++' and '--' are missing because "a--b" is a - (-b) in RSL: the parser
/// knows where two signs are an increment.
constexpr std::string_view kLongPunctuators[] = {"...", "->", "<<", ">>", "<=", ">=", "==", "!=", "&&",
                                                 "||",  "+=", "-=", "*=", "/=", "^=", ".=", "##"};
constexpr std::string_view kPunctuators = "+-*/.^<>=!?:,;()[]{}&|~%#";

}  // namespace

Lexer::Lexer(int32_t file, std::string_view text, MadeTexts& made, Messages& messages)
    : file_(file), text_(text), made_(&made), messages_(&messages) {
  if (text_.starts_with("\xEF\xBB\xBF")) cursor_.at = cursor_.lineStart = 3;
}

char Lexer::look(Cursor& cursor) const {
  while (cursor.at < text_.size() && text_[cursor.at] == '\\') {
    // Blanks after the backslash are accepted, because they are invisible.
    const size_t end = text_.find_first_not_of(" \t", cursor.at + 1);
    if (end == std::string_view::npos || text_[end] != '\n') break;
    cursor = {end + 1, end + 1, cursor.line + 1};
  }
  return cursor.at < text_.size() ? text_[cursor.at] : '\0';
}

char Lexer::lookBehind() const {
  Cursor next = cursor_;
  ++next.at;
  return look(next);
}

void Lexer::step() {
  if (look() == '\n') {
    ++cursor_.line;
    cursor_.lineStart = cursor_.at + 1;
  }
  if (!atEnd(cursor_)) ++cursor_.at;
}

Place Lexer::place(const Cursor& cursor) const {
  return {file_, cursor.line, static_cast<int32_t>(cursor.at - cursor.lineStart) + 1, -1};
}

bool Lexer::skipBlanks(bool inLine) {
  bool any = false;
  for (;; any = true) {
    const char c = look();
    if (isClass(c, kBlank)) {
      step();
    } else if (c == '/' && lookBehind() == '*') {
      skipBlockComment();
    } else if (c == '/' && lookBehind() == '/') {
      skipLineComment();
    } else if (c == '\n' && !inLine) {
      step();
      startsLine_ = true;
    } else {
      return any;
    }
  }
}

void Lexer::skipBlockComment() {
  const size_t begin = cursor_.at;
  const Place start = place(cursor_);
  step();
  step();
  while (!(look() == '*' && lookBehind() == '/')) {
    if (atEnd(cursor_)) {
      messages_->error(start, "this comment is not closed: there is no '*/' after it", 2);
      return;
    }
    step();
  }
  step();
  step();
  noteComment(begin);
}

void Lexer::skipLineComment() {
  const size_t begin = cursor_.at;
  while (look() != '\n' && !atEnd(cursor_)) step();
  noteComment(begin);
}

/// Notes a comment. Comments with nothing but blanks between them count as one.
void Lexer::noteComment(size_t begin) {
  if (!comment_.empty()) begin = static_cast<size_t>(comment_.data() - text_.data());
  comment_ = text_.substr(begin, cursor_.at - begin);
}

Lexeme Lexer::next() {
  comment_ = {};
  const bool space = skipBlanks(false);
  Lexeme out = scan();
  out.startsLine = startsLine_;
  out.spaceBefore = space;
  startsLine_ = false;
  return out;
}

Lexeme Lexer::nextInLine() {
  const bool space = skipBlanks(true);
  if (look() == '\n' || atEnd(cursor_)) return {.place = place(cursor_)};
  Lexeme out = scan();
  out.spaceBefore = space;
  return out;
}

std::string_view Lexer::restOfLine() {
  skipBlanks(true);
  const size_t begin = cursor_.at;
  while (look() != '\n' && !atEnd(cursor_)) step();
  const std::string_view rest = textFrom(begin);
  return rest.substr(0, rest.find_last_not_of(" \t") + 1);
}

std::string_view Lexer::angledName(Place* start) {
  skipBlanks(true);
  if (look() != '<') return {};
  *start = place(cursor_);
  const Cursor before = cursor_;
  while (look() != '>' && look() != '\n' && !atEnd(cursor_)) step();
  if (look() != '>') {
    cursor_ = before;
    return {};
  }
  step();
  return textFrom(before.at);
}

Lexeme Lexer::scan() {
  const char c = look();
  const size_t begin = cursor_.at;
  Lexeme out{.place = place(cursor_)};
  if (atEnd(cursor_)) return out;
  if (isClass(c, kNameStart)) {
    out.kind = LexemeKind::Name;
    scanName();
  } else if (isClass(c, kDigit) || (c == '.' && isClass(lookBehind(), kDigit))) {
    out.kind = LexemeKind::Number;
    scanNumber();
  } else if (c == '"') {
    out.kind = LexemeKind::String;
    out.isOpen = !scanQuoted(c);
  } else if (kPunctuators.find(c) != std::string_view::npos) {
    out.kind = LexemeKind::Punctuator;
    scanPunctuator();
  } else {
    out.kind = LexemeKind::Other;
    const Cursor before = cursor_;
    if (c == '\'' && scanQuoted(c)) {
      out.kind = LexemeKind::Character;
    } else {
      cursor_ = before;
      step();
    }
  }
  out.text = textFrom(begin);
  return out;
}

void Lexer::scanName() {
  while (isClass(look(), kNameStart | kDigit)) step();
}

void Lexer::scanNumber() {
  for (char c = look(); isClass(c, kNameStart | kDigit) || c == '.'; c = look()) {
    step();
    if ((c == 'e' || c == 'E') && (look() == '+' || look() == '-')) step();
  }
}

/// Reads to the closing quote or to the end of the line. Returns false if there is no quote.
bool Lexer::scanQuoted(char quote) {
  step();
  while (look() != quote) {
    if (look() == '\n' || atEnd(cursor_)) return false;
    if (look() == '\\' && lookBehind() != '\n') step();
    step();
  }
  step();
  return true;
}

void Lexer::scanPunctuator() {
  for (const std::string_view wanted : kLongPunctuators) {
    Cursor c = cursor_;
    size_t same = 0;
    while (same < wanted.size() && look(c) == wanted[same]) {
      ++c.at;
      ++same;
    }
    if (same == wanted.size()) {
      cursor_ = c;
      return;
    }
  }
  step();
}

/// Returns the text that was read since `begin`, without the continuations in it.
std::string_view Lexer::textFrom(size_t begin) {
  const std::string_view raw = text_.substr(begin, cursor_.at - begin);
  if (raw.find('\n') == std::string_view::npos) return raw;
  std::string clean;
  for (Cursor c{begin, begin, 1}; c.at < cursor_.at; ++c.at) {
    const char letter = look(c);
    if (c.at < cursor_.at) clean += letter;
  }
  return made_->keep(std::move(clean));
}

}  // namespace tomales::compiler
