#include "reyes/rib/expression.h"

#include <fmt/format.h>

#include <cctype>
#include <string_view>

#include "reyes/rib/number.h"

namespace tomales::rib {
namespace {

constexpr int kDeepest = 200;
constexpr size_t kMostSteps = 1 << 26;  ///< Most steps of a comparison with a pattern, which may compare each of its
                                        ///< characters with each of the text's.
constexpr size_t kMostToldOfUnknown = 1000;  ///< Bytes of unknown names in a message.

void checkLength(size_t bytes) {
  if (bytes > kLongestText) throw ExpressionError(fmt::format("its text would be longer than {} bytes", kLongestText));
}

std::optional<double> asNumber(const std::string& text) {
  ScannedNumber n{};
  const char *first = text.data(), *last = first + text.size();
  return first != last && scanNumber(first, last, n) == last ? std::optional(n.wide) : std::nullopt;
}

bool isTrue(const std::string& value) {
  if (const auto n = asNumber(value)) return *n != 0;
  return !value.empty() && value != "false";
}

std::string truth(bool b) { return b ? "1" : "0"; }

// '*' is any text and '?' any character; on a mismatch the latest star takes one more.
bool matches(std::string_view text, std::string_view pattern) {
  if (text.size() * pattern.size() > kMostSteps)
    throw ExpressionError(
        fmt::format("a text of {} bytes and a pattern of {} are too long to compare", text.size(), pattern.size()));
  size_t t = 0, p = 0, star = std::string_view::npos, starText = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      starText = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++starText;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

int order(const std::string& a, const std::string& b) {
  const auto x = asNumber(a), y = asNumber(b);
  if (x && y) return *x < *y ? -1 : *x > *y;
  return a.compare(b);
}

class Evaluator {
 public:
  Evaluator(std::string_view text, const Variables& variables) : rest_(text), variables_(variables) {}

  std::string all() {
    std::string value = either();
    skipBlanks();
    if (!rest_.empty()) throw ExpressionError(fmt::format("\"{}\" is not understood", rest_.substr(0, 40)));
    return value;
  }

 private:
  void skipBlanks() {
    while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_[0]))) rest_.remove_prefix(1);
  }
  bool take(std::string_view symbol) {
    skipBlanks();
    if (!rest_.starts_with(symbol)) return false;
    rest_.remove_prefix(symbol.size());
    return true;
  }
  void expect(std::string_view symbol) {
    if (!take(symbol)) throw ExpressionError(fmt::format("'{}' is missing", symbol));
  }

  std::string either() {
    std::string value = both();
    while (take("||")) value = truth(isTrue(value) | isTrue(unless(isTrue(value), &Evaluator::both)));
    return value;
  }
  std::string both() {
    std::string value = equality();
    while (take("&&")) value = truth(isTrue(value) & isTrue(unless(!isTrue(value), &Evaluator::equality)));
    return value;
  }
  /// Reads an operand that does not matter if `known`: in "defined(a) && $a > 2", `a` may not exist.
  std::string unless(bool known, std::string (Evaluator::*operand)()) {
    idle_ += known;
    std::string value = (this->*operand)();
    idle_ -= known;
    return value;
  }
  std::string equality() {
    std::string a = comparison();
    for (;;) {
      if (take("=~"))
        a = truth(matches(a, comparison()));
      else if (take("=="))
        a = truth(order(a, comparison()) == 0);
      else if (take("!="))
        a = truth(order(a, comparison()) != 0);
      else
        return a;
    }
  }
  std::string comparison() {
    std::string a = sum();
    for (;;) {
      if (take("<="))
        a = truth(order(a, sum()) <= 0);
      else if (take(">="))
        a = truth(order(a, sum()) >= 0);
      else if (take("<"))
        a = truth(order(a, sum()) < 0);
      else if (take(">"))
        a = truth(order(a, sum()) > 0);
      else
        return a;
    }
  }
  std::string sum() {
    std::string value = product();
    for (;;) {
      if (take("+"))
        value = fmt::format("{}", number(value) + number(product()));
      else if (take("-"))
        value = fmt::format("{}", number(value) - number(product()));
      else
        return value;
    }
  }
  std::string product() {
    std::string value = unary();
    for (;;) {
      if (take("*"))
        value = fmt::format("{}", number(value) * number(unary()));
      else if (take("/"))
        value = fmt::format("{}", number(value) / number(unary()));
      else
        return value;
    }
  }
  std::string unary() {
    if (++depth_ > kDeepest) throw ExpressionError("it is nested too deeply");
    std::string value;
    if (take("!"))
      value = truth(!isTrue(unary()));
    else if (take("-"))
      value = fmt::format("{}", -number(unary()));
    else
      value = primary();
    --depth_;
    return value;
  }
  std::string primary() {
    if (take("'")) return upTo('\'');
    if (take("${")) return variable(upTo('}'));
    if (take("$(") || take("(")) return inParentheses();
    if (take("$")) return variable(word());
    std::string name = word();
    if (name == "defined") return defined();
    if (name == "concat") return concat();
    return name;
  }
  std::string inParentheses() {
    std::string value = either();
    expect(")");
    return value;
  }
  std::string defined() {
    expect("(");
    take("$");
    const std::string name = word();
    expect(")");
    return truth(variables_(name).has_value());
  }
  std::string concat() {
    expect("(");
    std::string value = either();
    while (take(",")) {
      value += either();
      checkLength(value.size());
    }
    expect(")");
    return value;
  }

  std::string upTo(char end) {
    const size_t n = rest_.find(end);
    if (n == std::string_view::npos) throw ExpressionError(fmt::format("{} is missing", end));
    std::string out(rest_.substr(0, n));
    rest_.remove_prefix(n + 1);
    return out;
  }
  // Takes a name, with colons, or a number.
  std::string word() {
    skipBlanks();
    size_t n = 0;
    const auto inWord = [&](char c) {
      const bool exponentSign = (c == '-' || c == '+') && n > 0 && (rest_[n - 1] == 'e' || rest_[n - 1] == 'E') &&
                                std::isdigit(static_cast<unsigned char>(rest_[0]));
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == ':' || c == '.' || exponentSign;
    };
    while (n < rest_.size() && inWord(rest_[n])) ++n;
    if (n == 0)
      throw ExpressionError(rest_.empty() ? "it ends early" : fmt::format("'{}' is not understood", rest_[0]));
    std::string out(rest_.substr(0, n));
    rest_.remove_prefix(n);
    return out;
  }
  std::string variable(const std::string& name) {
    if (auto value = variables_(name)) return *value;
    if (idle_ > 0) return "0";
    throw ExpressionError(fmt::format("there is no variable \"{}\"", name));
  }
  double number(const std::string& value) const {
    if (const auto n = asNumber(value)) return *n;
    if (idle_ > 0) return 0;
    throw ExpressionError(fmt::format("\"{}\" is not a number", value));
  }

  std::string_view rest_;
  const Variables& variables_;
  int depth_ = 0;
  int idle_ = 0;  ///< Greater than 0 while an operand that does not matter is read.
};

}  // namespace

bool holds(const std::string& expression, const Variables& variables) {
  return isTrue(Evaluator(expression, variables).all());
}

// Names contain no braces. Otherwise "${${${..." would be searched for longer and longer names.
std::string substitute(const std::string& text, char mark, const Variables& variables, std::string& unknown) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool opens = text[i] == mark && i + 1 < text.size() && text[i + 1] == '{';
    const size_t close = opens ? text.find_first_of("{}", i + 2) : std::string::npos;
    const bool whole = close != std::string::npos && text[close] == '}';
    const std::string name = whole ? text.substr(i + 2, close - i - 2) : "";
    if (const auto value = name.empty() ? std::nullopt : variables(name)) {
      out += *value;
      checkLength(out.size());
      i = close;
      continue;
    }
    if (!name.empty() && unknown.size() < kMostToldOfUnknown) unknown += (unknown.empty() ? "" : ", ") + name;
    out += text[i];
  }
  return out;
}

}  // namespace tomales::rib
