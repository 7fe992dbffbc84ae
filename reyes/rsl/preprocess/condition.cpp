#include "reyes/rsl/preprocess/condition.h"

#include <algorithm>
#include <charconv>

#include "reyes/rsl/quote.h"

namespace tomales::compiler {
namespace {

constexpr int kMostDepth = 200;

struct ConditionOperator {
  std::string_view text;
  int level;  ///< Higher binds tighter.
};
constexpr ConditionOperator kConditionOperators[] = {{"||", 1}, {"&&", 2}, {"|", 3}, {"^", 4},  {"&", 5},  {"==", 6},
                                                     {"!=", 6}, {"<", 7},  {">", 7}, {"<=", 7}, {">=", 7}, {"<<", 8},
                                                     {">>", 8}, {"+", 9},  {"-", 9}, {"*", 10}, {"/", 10}, {"%", 10}};

struct Failed {};

/// Values wrap around as two's complement does, so that no expression is undefined.
class Evaluator {
 public:
  Evaluator(const std::vector<Lexeme>& expression, Place directive, Messages& messages)
      : lexemes_(expression), directive_(directive), messages_(messages) {}

  bool run() {
    try {
      const int64_t value = conditional(true);
      if (at_ < lexemes_.size()) fail("expected an operator before " + inQuotes(lexemes_[at_].text));
      return value != 0;
    } catch (const Failed&) {
      return false;
    }
  }

 private:
  [[noreturn]] void failAt(size_t index, std::string text) {
    const bool here = index < lexemes_.size();
    messages_.error(here ? lexemes_[index].place : directive_, std::move(text) + " in this condition",
                    here ? static_cast<int32_t>(lexemes_[index].text.size()) : 1);
    throw Failed{};
  }
  [[noreturn]] void fail(std::string text) { failAt(at_, std::move(text)); }
  bool take(std::string_view punctuator) {
    const bool there = at_ < lexemes_.size() && lexemes_[at_].is(punctuator);
    if (there) ++at_;
    return there;
  }

  /// `counts` is false in a part that is not evaluated, where a division by 0 does no harm.
  int64_t conditional(bool counts) {
    if (++depth_ > kMostDepth) fail("too many levels of nesting");
    int64_t value = binary(1, counts);
    if (take("?")) {
      const bool first = value != 0;
      const int64_t a = conditional(counts && first);
      if (!take(":")) fail("expected ':'");
      const int64_t b = conditional(counts && !first);
      value = first ? a : b;
    }
    --depth_;
    return value;
  }

  const ConditionOperator* operatorHere(int lowest) const {
    if (at_ < lexemes_.size() && lexemes_[at_].kind == LexemeKind::Punctuator)
      for (const ConditionOperator& o : kConditionOperators)
        if (o.text == lexemes_[at_].text) return o.level >= lowest ? &o : nullptr;
    return nullptr;
  }

  int64_t binary(int lowest, bool counts) {
    int64_t left = unary(counts);
    while (const ConditionOperator* o = operatorHere(lowest)) {
      const size_t sign = at_++;
      const bool decided = (o->text == "||" && left != 0) || (o->text == "&&" && left == 0);
      const bool rightCounts = counts && !decided;
      const int64_t right = binary(o->level + 1, rightCounts);
      if ((o->text == "/" || o->text == "%") && right == 0) {
        if (rightCounts) failAt(sign, "division by zero");
        continue;
      }
      left = apply(o->text, left, right);
    }
    return left;
  }

  static int64_t apply(std::string_view o, int64_t a, int64_t b) {
    const auto ua = static_cast<uint64_t>(a), ub = static_cast<uint64_t>(b);
    if (o == "||") return a != 0 || b != 0;
    if (o == "&&") return a != 0 && b != 0;
    if (o == "|") return a | b;
    if (o == "^") return a ^ b;
    if (o == "&") return a & b;
    if (o == "==") return a == b;
    if (o == "!=") return a != b;
    if (o == "<") return a < b;
    if (o == ">") return a > b;
    if (o == "<=") return a <= b;
    if (o == ">=") return a >= b;
    if (o == "<<") return ub < 64 ? static_cast<int64_t>(ua << ub) : 0;
    if (o == ">>") return a >> std::min<uint64_t>(ub, 63);
    if (o == "+") return static_cast<int64_t>(ua + ub);
    if (o == "-") return static_cast<int64_t>(ua - ub);
    if (o == "*") return static_cast<int64_t>(ua * ub);
    if (b == -1) return o == "/" ? static_cast<int64_t>(0 - ua) : 0;
    return o == "/" ? a / b : a % b;
  }

  int64_t unary(bool counts) {
    if (++depth_ > kMostDepth) fail("too many levels of nesting");
    const int64_t value = take("!")   ? unary(counts) == 0
                          : take("~") ? ~unary(counts)
                          : take("-") ? static_cast<int64_t>(0 - static_cast<uint64_t>(unary(counts)))
                          : take("+") ? unary(counts)
                                      : primary(counts);
    --depth_;
    return value;
  }

  int64_t primary(bool counts) {
    if (take("(")) {
      const int64_t value = conditional(counts);
      if (!take(")")) fail("expected ')'");
      return value;
    }
    if (at_ == lexemes_.size()) fail("expected a value");
    const Lexeme& l = lexemes_[at_];
    int64_t value = 0;
    if (l.kind == LexemeKind::Number) {
      value = number(l.text);
    } else if (l.kind == LexemeKind::Character) {
      value = character(l.text);
    } else if (l.kind != LexemeKind::Name) {
      fail("expected a value before " + inQuotes(l.text));
    }
    ++at_;
    return value;
  }

  int64_t number(std::string_view text) {
    const bool hex = text.starts_with("0x") || text.starts_with("0X");
    const std::string_view digits = hex ? text.substr(2) : text;
    uint64_t value = 0;
    const int base = hex ? 16 : text.starts_with("0") ? 8 : 10;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
    const std::string_view suffix = digits.substr(static_cast<size_t>(end - digits.data()));
    if (error != std::errc{} || suffix.find_first_not_of("uUlL") != std::string_view::npos)
      fail(inQuotes(text) + " is not an integer");
    return static_cast<int64_t>(value);
  }

  int64_t character(std::string_view text) {
    const std::string_view inside = text.substr(1, text.size() - 2);
    if (inside.size() != 1 || inside == "\\") fail(inQuotes(text) + " is not one plain character");
    return static_cast<unsigned char>(inside[0]);
  }

  const std::vector<Lexeme>& lexemes_;
  Place directive_;
  Messages& messages_;
  size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

bool holds(const std::vector<Lexeme>& expression, Place directive, Messages& messages) {
  return Evaluator(expression, directive, messages).run();
}

}  // namespace tomales::compiler
