#include <fmt/format.h>

#include <algorithm>

#include "reyes/rsl/parse/parser.h"

namespace tomales::compiler {
namespace {

struct Operator {
  std::string_view text;
  int level;
};
/// Operators and their precedence (RISpec 3.2 appendix B); a higher number binds tighter. Unary operators and casts
/// bind tighter than all of these.
constexpr Operator kOperators[] = {{"||", 1}, {"&&", 2}, {"==", 3}, {"!=", 3}, {"<", 4}, {"<=", 4}, {">", 4},
                                   {">=", 4}, {"+", 5},  {"-", 5},  {"^", 6},  {"*", 7}, {"/", 7},  {".", 8}};

const Operator* operatorOf(const Token& t) {
  if (t.kind != TokenKind::Punctuator) return nullptr;
  const auto* found = std::ranges::find(kOperators, t.text, &Operator::text);
  return found == std::end(kOperators) ? nullptr : found;
}

bool isAssignment(const Token& t) {
  constexpr std::string_view kAll[] = {"=", "+=", "-=", "*=", "/=", "^=", ".="};
  return t.kind == TokenKind::Punctuator && std::ranges::find(kAll, t.text) != std::end(kAll);
}

/// Tells whether evaluating it changes a variable.
bool assigns(const Expr& e) {
  return e.kind == ExprKind::Assign || std::ranges::any_of(e.args, [](const ExprPtr& a) { return assigns(*a); });
}

bool endsOperand(const Token& t) { return t.is(";") || t.is(")") || t.is(",") || t.is("]"); }

/// Tells whether nothing stands between two punctuators of one character.
bool touches(const Token& a, const Token& b) {
  return a.place.file == b.place.file && a.place.line == b.place.line && a.place.column + 1 == b.place.column &&
         a.place.expansion == b.place.expansion;
}

bool hasSpaces(Base base) { return base >= Base::Color && base <= Base::Matrix; }

bool beginsOperand(const Token& t) {
  return t.kind == TokenKind::Name || t.kind == TokenKind::Number || t.kind == TokenKind::String || t.is("(") ||
         t.is("-") || t.is("+") || t.is("!") || t.is("{");
}

}  // namespace

ExprPtr Parser::make(ExprKind kind, const Token& token) const {
  auto e = std::make_unique<Expr>();
  e->kind = kind;
  e->place = token.place;
  e->length = static_cast<int32_t>(token.text.size()) + (token.kind == TokenKind::String ? 2 : 0);
  e->text = token.text;
  return e;
}

void Parser::adopt(Expr& parent, ExprPtr child) {
  parent.height = std::max(parent.height, child->height + 1);
  if (parent.height > kMostHeight) {
    messages_.error(parent.place, fmt::format("this expression has more than {} levels of operators", kMostHeight),
                    parent.length);
    throw GaveUp{};
  }
  parent.args.push_back(std::move(child));
}

bool Parser::isDoubledSign() const { return (here().is("+") || here().is("-")) && here(1).is(here().text); }

// i++ is not in RISpec, but some compilers have it. Its value is the old one.
bool Parser::isIncrement() const { return isDoubledSign() && endsOperand(here(2)); }

// Recognizes ++i and --a[1]. Signs that do not touch, as in - -y, or that come from macros, are separate signs, and so
// are all signs of a---b.
bool Parser::isEarlyIncrement() const {
  const bool isThird = at_ > 0 && tokens_[at_ - 1].is(here().text) && touches(tokens_[at_ - 1], here());
  return isDoubledSign() && touches(here(), here(1)) && !isThird && here(2).kind == TokenKind::Name &&
         !baseNamed(here(2).text) && !here(3).is("(");
}

ExprPtr Parser::one(const Token& at) const {
  ExprPtr out = make(ExprKind::Number, at);
  out->number = 1;
  return out;
}

ExprPtr Parser::added(const Token& sign, ExprPtr variable) {
  ExprPtr out = make(ExprKind::Assign, sign);
  out->text += "=";
  adopt(*out, std::move(variable));
  adopt(*out, one(sign));
  return out;
}

ExprPtr Parser::increment(ExprPtr variable) {
  const Token& sign = take();
  take();
  ExprPtr out = make(ExprKind::Binary, sign);
  out->text = sign.is("+") ? "-" : "+";
  adopt(*out, added(sign, std::move(variable)));
  adopt(*out, one(sign));
  return out;
}

ExprPtr Parser::earlyIncrement() {
  const Token& sign = take();
  take();
  ExprPtr variable = postfix();
  checkAssigned(*variable, sign, true);
  return added(sign, std::move(variable));
}

ExprPtr Parser::expression() {
  ExprPtr first = assignment();
  if (!here().is(",")) return first;
  ExprPtr all = make(ExprKind::Comma, here());
  adopt(*all, std::move(first));
  while (takeIf(",")) adopt(*all, assignment());
  return all;
}

void Parser::checkAssigned(const Expr& variable, const Token& sign, bool isReadToo) {
  if (variable.kind != ExprKind::Name && variable.kind != ExprKind::Index)
    failAt(sign, "only a variable or an element of an array can be assigned");
  if (isReadToo && variable.kind == ExprKind::Index && assigns(*variable.args[1]))  // it would be evaluated twice
    failAt(sign, fmt::format("the index before '{}' changes a variable; do that before", sign.text));
}

ExprPtr Parser::assignment() {
  ExprPtr left = conditional();
  if (!isAssignment(here()) && !isIncrement()) return left;
  checkAssigned(*left, here(), !here().is("="));
  if (isIncrement()) return increment(std::move(left));
  const Level level(*this);
  ExprPtr out = make(ExprKind::Assign, take());
  adopt(*out, std::move(left));
  adopt(*out, assignment());
  return out;
}

ExprPtr Parser::conditional() {
  ExprPtr condition = binary(1);
  if (!here().is("?")) return condition;
  const Level level(*this);
  const Token& question = take();
  ExprPtr out = make(ExprKind::Conditional, question);
  adopt(*out, std::move(condition));
  adopt(*out, assignment());
  expectClosing(":", question);
  adopt(*out, assignment());
  return out;
}

ExprPtr Parser::binary(int lowest) {
  ExprPtr left = unary();
  for (const Operator* o = operatorOf(here()); o && o->level >= lowest && !isIncrement(); o = operatorOf(here())) {
    ExprPtr out = make(ExprKind::Binary, take());
    adopt(*out, std::move(left));
    adopt(*out, binary(o->level + 1));
    left = std::move(out);
  }
  return left;
}

ExprPtr Parser::unary() {
  const Level level(*this);
  if (isEarlyIncrement()) return earlyIncrement();
  if (here().is("-") || here().is("!") || here().is("+")) {
    ExprPtr out = make(ExprKind::Unary, take());
    adopt(*out, unary());
    return out;
  }
  if (here().kind == TokenKind::Name && baseNamed(here().text)) return cast();
  return postfix();
}

ExprPtr Parser::cast() {
  ExprPtr out = make(ExprKind::Cast, here());
  out->written.base = *baseNamed(take().text);
  out->text.clear();
  if (hasSpaces(out->written.base) && here().kind == TokenKind::String && beginsOperand(here(1))) {
    out->text = take().text;
    out->hasSpace = true;
  }
  adopt(*out, unary());
  return out;
}

ExprPtr Parser::postfix() {
  ExprPtr out = primary();
  while (here().is("[")) {
    const Token& open = take();
    ExprPtr element = make(ExprKind::Index, open);
    adopt(*element, std::move(out));
    adopt(*element, expression());
    expectClosing("]", open);
    out = std::move(element);
  }
  return out;
}

ExprPtr Parser::primary() {
  const Token& t = here();
  switch (t.kind) {
    case TokenKind::Number: {
      ExprPtr out = make(ExprKind::Number, take());
      out->number = t.number;
      return out;
    }
    case TokenKind::String:
      return make(ExprKind::String, take());
    case TokenKind::Name:
      return here(1).is("(") ? call() : make(ExprKind::Name, take());
    default:
      if (t.is("(")) return inBrackets();
      if (t.is("{")) return arrayValue();
      failNoExpression();
  }
}

void Parser::failNoExpression() {
  const Token* first = at_ >= 2 ? &tokens_[at_ - 2] : nullptr;
  if (first && (first->is("+") || first->is("-")) && tokens_[at_ - 1].is(first->text))
    failAt(*first, fmt::format("RSL has no '{0}{0}'; '{0}= 1' does the same", first->text));
  fail("expected an expression");
}

ExprPtr Parser::call() {
  ExprPtr out = make(ExprKind::Call, take());
  const Token& open = take();
  std::vector<ExprPtr> args;
  if (!here().is(")")) list(args);
  expectClosing(")", open);
  for (ExprPtr& arg : args) adopt(*out, std::move(arg));
  return out;
}

void Parser::list(std::vector<ExprPtr>& out) {
  do {
    out.push_back(assignment());
  } while (takeIf(","));
}

/// Reads (expression), a triple, or the 16 elements of a matrix.
ExprPtr Parser::inBrackets() {
  const Token& open = take();
  std::vector<ExprPtr> values;
  list(values);
  expectClosing(")", open);
  if (values.size() == 1) return std::move(values[0]);
  if (values.size() != 3 && values.size() != 16)
    failAt(open, fmt::format("{} values in brackets; a triple has 3, and a matrix 16", values.size()));
  ExprPtr out = make(ExprKind::Tuple, open);
  for (ExprPtr& value : values) adopt(*out, std::move(value));
  return out;
}

ExprPtr Parser::arrayValue() {
  const Token& open = take();
  ExprPtr out = make(ExprKind::Tuple, open);
  while (!here().is("}")) {
    adopt(*out, assignment());
    if (!takeIf(",")) break;
  }
  expectClosing("}", open);
  return out;
}

}  // namespace tomales::compiler
