#include <fmt/format.h>

#include <charconv>
#include <limits>

#include "reyes/rsl/preprocess/preprocessor.h"
#include "reyes/rsl/quote.h"
#include "reyes/rsl/tree.h"

namespace tomales::compiler {
namespace {

/// Returns the character that an escape stands for; `at` moves behind it. Unknown escapes stand for their letter.
char unescaped(std::string_view text, size_t& at) {
  const char c = text[at++];
  if (c >= '0' && c <= '7') {
    int value = c - '0';
    for (int digits = 1; digits < 3 && at < text.size() && text[at] >= '0' && text[at] <= '7'; ++digits)
      value = value * 8 + (text[at++] - '0');
    return static_cast<char>(value);
  }
  constexpr std::string_view kLetters = "ntrabfv", kMeanings = "\n\t\r\a\b\f\v";
  const size_t index = kLetters.find(c);
  return index == std::string_view::npos ? c : kMeanings[index];
}

std::string withoutEscapes(std::string_view text) {
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const char c = text[at++];
    out += c == '\\' && at < text.size() ? unescaped(text, at) : c;
  }
  return out;
}

bool mayBeginShader(std::string_view name) { return shaderKindNamed(name).has_value(); }

}  // namespace

void Preprocessor::put(const Lexeme& l) {
  bytesOut_ += l.text.size();
  if (bytesOut_ > kMostBytes) return stop(l.place, fmt::format("the shader has more than {} MiB", kMostBytes >> 20));
  if (out_.size() >= kMostTokens) return stop(l.place, fmt::format("the shader has more than {} words", kMostTokens));
  Token token{.text = std::string(l.text), .place = l.place};
  switch (l.kind) {
    case LexemeKind::Name:
      token.kind = TokenKind::Name;
      if (mayBeginShader(l.text) && rows_.empty() && !files_.empty() && !files_.back().lexer.commentBefore().empty())
        token.comment = std::make_shared<const std::string>(files_.back().lexer.commentBefore());
      break;
    case LexemeKind::Punctuator:
      token.kind = TokenKind::Punctuator;
      break;
    case LexemeKind::Number:
      putNumber(l, token);
      break;
    case LexemeKind::String:
      return putString(l, std::move(token));
    case LexemeKind::Character:
      messages_.error(l.place, inQuotes(l.text) + " is not of the language: strings stand in double quotes",
                      l.length());
      return;
    default:
      messages_.error(l.place,
                      fmt::format("a stray byte {:#04x}: {}", static_cast<unsigned char>(l.text[0]), inQuotes(l.text)));
      return;
  }
  out_.push_back(std::move(token));
}

void Preprocessor::putNumber(const Lexeme& l, Token& token) {
  token.kind = TokenKind::Number;
  const std::string_view text = l.text;
  const bool hex = text.starts_with("0x") || text.starts_with("0X");
  const char* const end = text.data() + text.size();
  double value = 0;
  uint64_t integer = 0;
  const auto [stop, error] =
      hex ? std::from_chars(text.data() + 2, end, integer, 16) : std::from_chars(text.data(), end, value);
  if (hex) value = static_cast<double>(integer);
  const std::string_view suffix(stop, static_cast<size_t>(end - stop));
  if (error == std::errc::invalid_argument || (!suffix.empty() && suffix != "f" && suffix != "F")) {
    messages_.error(l.place, inQuotes(text) + " is not a number", l.length());
    return;
  }
  if (error == std::errc::result_out_of_range) value = std::strtod(std::string(text).c_str(), nullptr);
  if (value > static_cast<double>(std::numeric_limits<float>::max())) {
    messages_.warning(l.place, inQuotes(text) + " is more than a float can be: the largest, 3.40282347e38, is used",
                      l.length());
    value = static_cast<double>(std::numeric_limits<float>::max());
  }
  token.number = static_cast<float>(value);
}

/// Joins strings beside each other, as in C.
void Preprocessor::putString(const Lexeme& l, Token token) {
  if (l.isOpen) messages_.error(l.place, "this string is not closed on its line", l.length());
  token.kind = TokenKind::String;
  token.text = withoutEscapes(l.text.substr(1, l.text.size() - (l.isOpen ? 1 : 2)));
  if (!out_.empty() && out_.back().kind == TokenKind::String) {
    out_.back().text += token.text;
  } else {
    out_.push_back(std::move(token));
  }
}

}  // namespace tomales::compiler
