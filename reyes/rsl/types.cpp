#include "reyes/rsl/types.h"

namespace tomales::compiler {

std::optional<int> conversion(const Type& from, const Type& to) {
  if (from == kUnknown || to == kUnknown || from == to) return 0;
  if (from.isArray() || to.isArray())
    return from.isArray() && to.isArray() && from.base == to.base &&
                   (to.length == kOpenArray || from.length == kOpenArray)
               ? std::optional(0)
               : std::nullopt;
  if (isSpatial(from) && isSpatial(to)) return 1;
  if (from.is(Base::Float) && to.isTriple()) return 3;
  if (from.is(Base::Float) && to.is(Base::Matrix)) return 4;
  if (from.isTriple() && to.isTriple()) return kDoubtful + 1;
  return std::nullopt;
}

namespace {

Type sumType(std::string_view text, const Type& a, const Type& b) {
  if (a.is(Base::Float)) return b;
  if (b.is(Base::Float)) return a;
  if (a.is(Base::Color) || b.is(Base::Color)) return {Base::Color};
  if (a.is(Base::Point) && b.is(Base::Point)) return {text == "-" ? Base::Vector : Base::Point};
  if (a.is(Base::Point) || b.is(Base::Point)) return {Base::Point};
  return a;
}

std::optional<Operation> arithmetic(std::string_view text, const Type& a, const Type& b) {
  const Op op = text == "+" ? Op::Add : text == "-" ? Op::Sub : text == "*" ? Op::Mul : Op::Div;
  if (a.is(Base::Matrix) || b.is(Base::Matrix)) {
    if (!(a.is(Base::Matrix) || a.is(Base::Float)) || !(b.is(Base::Matrix) || b.is(Base::Float))) return {};
    const bool product = op == Op::Mul || op == Op::Div;
    const bool scaled = product && b.is(Base::Float);  // a sum converts each element, and so does this
    return Operation{
        product && !scaled ? Op::MatrixProduct : op, {Base::Matrix}, scaled ? kUnknown : Type{Base::Matrix}};
  }
  if (!isNumeric(a) || !isNumeric(b)) return {};
  return Operation{op, op == Op::Add || op == Op::Sub ? sumType(text, a, b) : sumType("*", a, b)};
}

std::optional<Operation> comparison(std::string_view text, const Type& a, const Type& b) {
  const bool equality = text == "==" || text == "!=", negated = text == "!=";
  if (a.is(Base::String) && b.is(Base::String) && equality)
    return Operation{Op::TextEqual, {Base::Float}, kUnknown, negated};
  if (a.is(Base::Matrix) && b.is(Base::Matrix) && equality)
    return Operation{Op::MatrixEqual, {Base::Float}, kUnknown, negated};
  if (!isNumeric(a) || !isNumeric(b)) return {};
  if (a.isTriple() || b.isTriple()) {
    if (!equality) return {};
    return Operation{Op::TripleEqual, {Base::Float}, a.isTriple() ? a : b, negated};
  }
  if (equality) return Operation{negated ? Op::NotEqual : Op::Equal, {Base::Float}};
  // a > b is b < a: the lowering exchanges the two.
  return Operation{text == "<" || text == ">" ? Op::Less : Op::LessEqual, {Base::Float}};
}

}  // namespace

std::optional<Operation> binaryOperation(std::string_view text, const Type& a, const Type& b) {
  if (a == kUnknown || b == kUnknown) return Operation{Op::Add, kUnknown};
  if (text == "+" || text == "-" || text == "*" || text == "/") return arithmetic(text, a, b);
  if (text == "." || text == "^") {
    if (!isNumeric(a) || !isNumeric(b) || !(a.isTriple() || b.isTriple())) return {};
    if (text == ".") return Operation{Op::Dot, {Base::Float}};
    return Operation{Op::Cross, {Base::Vector}};
  }
  if (text == "&&" || text == "||") {
    if (!a.is(Base::Float) || !b.is(Base::Float)) return {};
    return Operation{text == "&&" ? Op::And : Op::Or, {Base::Float}};
  }
  return comparison(text, a, b);
}

}  // namespace tomales::compiler
