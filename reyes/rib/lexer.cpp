#include "reyes/rib/lexer.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

namespace tomales::rib {
namespace {

bool isBlank(int c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f'; }
bool isWord(int c) { return c > ' ' && c < 0x7f && c != '"' && c != '[' && c != ']' && c != '#'; }

std::optional<double> parseNumber(const std::string& word) {
  const char* first = word.data() + (word[0] == '+' ? 1 : 0);
  const char* last = word.data() + word.size();
  double value = 0;
  const auto [end, error] = std::from_chars(first, last, value);  // takes "inf" and "nan" in any case, too
  if (end != last || end == first) return std::nullopt;
  if (error == std::errc::result_out_of_range) return std::strtod(word.c_str(), nullptr);  // 0 or infinity
  return value;
}

}  // namespace

std::string describe(const Token& token) {
  switch (token.kind) {
    case Token::Kind::End:
      return "the end of the file";
    case Token::Kind::Number:
      return fmt::format("the number {}", token.number);
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

void Lexer::advance() {
  skipBlanks();
  token_.line = line_;
  token_.text.clear();
  const int c = stream_.peek();
  if (c == ByteStream::kEnd) {
    token_.kind = Token::Kind::End;
  } else if (c == '"') {
    readString();
  } else if (c == '[' || c == ']') {
    stream_.get();
    token_.kind = c == '[' ? Token::Kind::Open : Token::Kind::Close;
  } else if (isWord(c)) {
    readWord();
  } else {
    readJunk();
  }
}

void Lexer::skipBlanks() {
  bool comment = false;
  for (int c = stream_.peek(); c != ByteStream::kEnd; c = stream_.peek()) {
    if (c == '#') comment = true;
    if (!comment && !isBlank(c)) return;
    if (c == '\n') {
      ++line_;
      comment = false;
    }
    stream_.get();
  }
}

void Lexer::readString() {
  token_.kind = Token::Kind::String;
  stream_.get();
  for (int c = stream_.get(); c != '"'; c = stream_.get()) {
    if (c == ByteStream::kEnd || token_.text.size() >= kLongestString) {
      token_.kind = Token::Kind::Junk;
      token_.text = "a string without closing quote";
      return;
    }
    if (c == '\n') ++line_;
    if (c == '\\')
      readEscape();
    else
      token_.text += static_cast<char>(c);
  }
}

// The escapes of C strings that RISpec names: \n \r \t \b \f \\ \" \ooo, and a line end that is skipped.
void Lexer::readEscape() {
  const int c = stream_.get();
  static constexpr std::string_view kLetters = "nrtbf", kMeanings = "\n\r\t\b\f";
  if (c == ByteStream::kEnd) return;
  if (c == '\n') {
    ++line_;
  } else if (c >= '0' && c <= '7') {
    int code = c - '0';
    for (int i = 0; i < 2 && stream_.peek() >= '0' && stream_.peek() <= '7'; ++i)
      code = code * 8 + (stream_.get() - '0');
    token_.text += static_cast<char>(code);
  } else {
    const size_t at = kLetters.find(static_cast<char>(c));
    token_.text += at == std::string_view::npos ? static_cast<char>(c) : kMeanings[at];
  }
}

void Lexer::readWord() {
  bool tooLong = false;
  while (isWord(stream_.peek())) {
    const char c = static_cast<char>(stream_.get());
    if (token_.text.size() < kLongestWord)
      token_.text += c;
    else
      tooLong = true;
  }
  const int c = token_.text[0];
  const std::optional<double> number = parseNumber(token_.text);
  if (tooLong) {
    token_.kind = Token::Kind::Junk;
    token_.text = fmt::format("a word longer than {} characters", kLongestWord);
  } else if (number) {
    token_.kind = Token::Kind::Number;
    token_.number = *number;
  } else if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')) {
    token_.kind = Token::Kind::Name;
  } else {
    token_.kind = Token::Kind::Junk;
    token_.text = "\"" + token_.text.substr(0, 40) + "\", which is neither a number nor a name";
  }
}

// A whole run at once: one token, one message.
void Lexer::readJunk() {
  int c = stream_.peek();
  token_.kind = Token::Kind::Junk;
  token_.text = fmt::format("byte 0x{:02x}, which ASCII RIB does not use (binary RIB is not read)", c);
  while (c != ByteStream::kEnd && !isWord(c) && !isBlank(c) && c != '"' && c != '[' && c != ']' && c != '#') {
    stream_.get();
    c = stream_.peek();
  }
}

}  // namespace tomales::rib
