#include "reyes/rib/lexer.h"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <utility>

namespace tomales::rib {
namespace {

bool isBlank(int c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }
/// Tells whether a line ends here: at the '\n' of Unix and DOS, or at the '\r' of the old Macintosh.
bool endsLine(const char* at, const char* last) {
  return *at == '\n' || (*at == '\r' && at + 1 < last && at[1] != '\n');
}
bool isWord(int c) { return c > ' ' && c < 0x7f && c != '"' && c != '[' && c != ']' && c != '#'; }

void append(std::vector<float>& out, const ScannedNumber& n) { out.push_back(n.narrow); }
void append(std::vector<int>& out, const ScannedNumber& n) { out.push_back(toInt(n.wide)); }

}  // namespace

std::string describe(const Token& token) {
  switch (token.kind) {
    case Token::Kind::End:
      return "the end of the file";
    case Token::Kind::Number:
      return fmt::format("the number {}", token.number.wide);
    case Token::Kind::Floats:
      return fmt::format("an array of {} numbers", token.floats.size());
    case Token::Kind::String:
      return fmt::format("the string \"{}\"", token.text.substr(0, 40));
    case Token::Kind::Name:
      return fmt::format("the word {}", token.text.substr(0, 40));
    case Token::Kind::Open:
      return "'['";
    case Token::Kind::Close:
      return "']'";
    case Token::Kind::Junk:
      return token.text;
  }
  return "";
}

int toInt(double d) {
  if (d > INT_MIN && d < INT_MAX && d == static_cast<int>(d)) return static_cast<int>(d);
  return std::isnan(d) ? INT_MIN : static_cast<int>(std::lround(std::clamp<double>(d, INT_MIN, INT_MAX)));
}

void Lexer::advance() {
  while (!readToken()) {
  }
}

void Lexer::advancePastNumbers() {
  static constexpr auto kWithin = [] {
    std::array<bool, 256> out{};
    for (const char c : std::string_view("0123456789+-.[] \t\r\n")) out[static_cast<unsigned char>(c)] = true;
    return out;
  }();
  const auto isWithin = [](char c) { return kWithin[static_cast<unsigned char>(c)]; };
  while (stream_.peek() != ByteStream::kEnd && isWithin(*stream_.begin())) {
    const char* const end = std::find_if_not(stream_.begin(), stream_.end(), isWithin);
    for (const char* p = stream_.begin(); p != end; ++p) line_ += endsLine(p, stream_.end());
    stream_.skipTo(end);
  }
  advance();
}

bool Lexer::readToken() {
  skipBlanks();
  token_.line = line_;
  token_.text.clear();
  const int c = stream_.peek();
  if (c == 0377 && stream_.isProgram()) stream_.close();
  if (c == ByteStream::kEnd || stream_.closed()) {
    token_.kind = Token::Kind::End;
  } else if (c == '"') {
    readString();
  } else if (c == '[' || c == ']') {
    stream_.get();
    token_.kind = c == '[' ? Token::Kind::Open : Token::Kind::Close;
  } else if (isWord(c)) {
    readWord();
  } else if (isBinary(c)) {
    return readBinary();
  } else {
    readJunk();
  }
  return true;
}

void Lexer::junk(std::string what) {
  token_.kind = Token::Kind::Junk;
  token_.text = std::move(what);
}

template <class T>
void Lexer::appendToken(std::vector<T>& out) const {
  if (token_.kind == Token::Kind::Number) return append(out, token_.number);
  out.reserve(out.size() + token_.floats.size());
  for (const float f : token_.floats) append(out, {f, f});
}

template <class T>
void Lexer::takeNumber(std::vector<T>& out) {
  appendToken(out);
  advance();
}
template void Lexer::takeNumber(std::vector<float>& out);
template void Lexer::takeNumber(std::vector<int>& out);

template <class T>
void Lexer::takeNumbers(std::vector<T>& out) {
  for (; atNumbers(); advance()) {
    appendToken(out);
    takeWrittenNumbers(out);
  }
}
template void Lexer::takeNumbers(std::vector<float>& out);
template void Lexer::takeNumbers(std::vector<int>& out);

// Reads common numbers that are wholly in the buffer, without making tokens of them.
template <class T>
void Lexer::takeWrittenNumbers(std::vector<T>& out) {
  const char *p = stream_.begin(), *const last = stream_.end();
  int lines = 0;
  ScannedNumber number;
  for (const char* q = p; q < last;) {
    if (isBlank(*q)) {
      lines += endsLine(q++, last);
      continue;
    }
    q = scanEverydayNumber(q, last, number);
    if (!q || q == last || !(isBlank(*q) || *q == ']')) break;
    append(out, number);
    line_ += std::exchange(lines, 0);
    p = q;
  }
  stream_.skipTo(p);
}

void Lexer::skipBlanks() {
  for (int c = stream_.peek(); isBlank(c) || c == '#'; c = stream_.peek()) {
    if (c == '#') {
      skipComment();
      continue;
    }
    stream_.get();
    line_ += c == '\n' || (c == '\r' && stream_.peek() != '\n');
  }
}

void Lexer::skipComment() {
  std::string text;
  for (int c = stream_.peek(); c != '\n' && c != '\r'; c = stream_.peek()) {
    if (c == ByteStream::kEnd) return;
    if (text.size() < kLongestWord) text += static_cast<char>(c);
    stream_.get();
  }
  skipLineEnd();
  int line = 0, begin = 0;
  const size_t end = text.rfind('"');
  if (std::sscanf(text.c_str(), "#line %9d \"%n", &line, &begin) != 1 || begin == 0 || end < static_cast<size_t>(begin))
    return;
  line_ = line;
  file_ =
      std::make_shared<const std::string>(text.substr(static_cast<size_t>(begin), end - static_cast<size_t>(begin)));
}

void Lexer::skipLineEnd() {
  if (stream_.get() == '\r' && stream_.peek() == '\n') stream_.get();
  ++line_;
}

void Lexer::readString() {
  token_.kind = Token::Kind::String;
  stream_.get();
  bool tooLong = false;
  for (int c = stream_.get(); c != '"'; c = stream_.get()) {
    if (c == ByteStream::kEnd) return junk("a string without closing quote");
    tooLong = tooLong || token_.text.size() >= kLongestString;
    if (tooLong) token_.text.clear();
    if (c == '\n' || (c == '\r' && stream_.peek() != '\n')) ++line_;
    if (c == '\\')
      readEscape();
    else
      token_.text += static_cast<char>(c);
  }
  if (tooLong) junk("a string that is too long");
}

// Reads the escapes of C strings that RISpec names: \n \r \t \b \f \\ \" \ooo, and a line end, which is skipped.
void Lexer::readEscape() {
  static constexpr std::string_view kLetters = "nrtbf", kMeanings = "\n\r\t\b\f";
  if (stream_.peek() == '\n' || stream_.peek() == '\r') return skipLineEnd();
  const int c = stream_.get();
  if (c == ByteStream::kEnd) return;
  if (c >= '0' && c <= '7') {
    int code = c - '0';
    for (int i = 0; i < 2 && stream_.peek() >= '0' && stream_.peek() <= '7'; ++i)
      code = code * 8 + (stream_.get() - '0');
    token_.text += static_cast<char>(code);
  } else {
    const size_t at = kLetters.find(static_cast<char>(c));
    token_.text += at == std::string_view::npos ? static_cast<char>(c) : kMeanings[at];
  }
}

// RISpec has no 'string', but scenes use it: a word in single quotes is a string.
void Lexer::readWord() {
  bool tooLong = false;
  while (isWord(stream_.peek())) {
    const char *const first = stream_.begin(), *const last = std::find_if_not(first, stream_.end(), isWord);
    tooLong |= token_.text.size() + static_cast<size_t>(last - first) > kLongestWord;
    if (!tooLong) token_.text.append(first, last);
    stream_.skipTo(last);
  }
  if (tooLong) return junk(fmt::format("a word longer than {} characters", kLongestWord));
  if (token_.text.size() >= 2 && token_.text.front() == '\'' && token_.text.back() == '\'') {
    token_.kind = Token::Kind::String;
    token_.text = token_.text.substr(1, token_.text.size() - 2);
    return;
  }
  const char *const first = token_.text.data(), *const last = first + token_.text.size();
  if (scanNumber(first, last, token_.number) == last)
    token_.kind = Token::Kind::Number;
  else if ((*first >= 'a' && *first <= 'z') || (*first >= 'A' && *first <= 'Z'))
    token_.kind = Token::Kind::Name;
  else
    junk("\"" + token_.text.substr(0, 40) + "\", which is neither a number nor a name");
}

// Reads a whole run at once: one token, one message.
void Lexer::readJunk() {
  int c = stream_.peek();
  junk(fmt::format("byte 0x{:02x}, which begins nothing in RIB", c));
  while (c != ByteStream::kEnd && !isWord(c) && !isBlank(c) && !isBinary(c) && c != '"' && c != '[' && c != ']' &&
         c != '#') {
    stream_.get();
    c = stream_.peek();
  }
}

}  // namespace tomales::rib
