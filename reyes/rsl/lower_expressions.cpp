#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "reyes/rsl/lowering.h"
#include "reyes/rsl/types.h"
#include "reyes/shader_api.h"

namespace tomales::compiler {
namespace {

/// Tells whether evaluating the expression may change a variable.
bool changesVariables(const Expr& e) {
  if (e.kind == ExprKind::Assign) return true;
  if (e.kind == ExprKind::Call && e.function) return true;
  if (e.kind == ExprKind::Call && e.builtin)
    for (const Slot& s : e.builtin->slots)
      if (s.output) return true;
  return std::any_of(e.args.begin(), e.args.end(), [](const ExprPtr& a) { return changesVariables(*a); });
}

/// Tells whether it costs nothing to compute the expression where its value is not wanted.
bool isCheap(const Expr& e) {
  if (e.kind == ExprKind::Assign) return false;
  if (e.kind == ExprKind::Call) {
    if (e.function || !e.builtin) return false;
    const Builtin& b = *e.builtin;
    if (!info(b.op).pure() || b.emit == Emit::Print) return false;
  }
  return std::all_of(e.args.begin(), e.args.end(), [](const ExprPtr& a) { return isCheap(*a); });
}

}  // namespace

int32_t Lowering::value(const Expr& e, const Type& wanted) {
  const int32_t reg = value(e);
  const bool widens = wanted.is(Base::Matrix) && shape(reg) == Shape::Number;
  return widens ? compute(Op::MatrixOf, {reg}) : reg;
}

int32_t Lowering::widened(int32_t reg, const Type& type) {
  return type.isTriple() && shape(reg) == Shape::Number ? compute(Op::MakeTriple, {reg, reg, reg}) : reg;
}

std::vector<int32_t> Lowering::values(const std::vector<const Expr*>& list, const std::vector<Type>& wanted) {
  std::vector<int32_t> out;
  for (size_t i = 0; i < list.size(); ++i) {
    int32_t reg = value(*list[i], wanted[std::min(i, wanted.size() - 1)]);
    const Origin origin = code_.registers[static_cast<size_t>(reg)].origin;
    const bool mayChange = origin == Origin::Variable || origin == Origin::Global || origin == Origin::Parameter;
    if (mayChange && !list[i]->type.isArray() &&
        std::any_of(list.begin() + static_cast<long>(i) + 1, list.end(),
                    [](const Expr* e) { return changesVariables(*e); })) {
      const int32_t kept = temporary(shape(reg));
      initialise(kept, reg);
      reg = kept;
    }
    out.push_back(reg);
  }
  return out;
}

int32_t Lowering::value(const Expr& e) {
  const Place outer = std::exchange(place_, e.place);
  int32_t out = -1;
  switch (e.kind) {
    case ExprKind::Number:
      out = number(e.number);
      break;
    case ExprKind::String:
      out = text(e.text);
      break;
    case ExprKind::Name:
      out = name(e);
      break;
    case ExprKind::Index:
      out = element(e);
      break;
    case ExprKind::Tuple:
      out = tuple(e);
      break;
    case ExprKind::Unary:
      out = value(*e.args[0]);
      if (e.text == "!") out = compute(Op::Not, {out});
      if (e.text == "-") out = compute(Op::Neg, {out}, shape(out));
      break;
    case ExprKind::Binary:
      out = binary(e);
      break;
    case ExprKind::Conditional:
      out = conditional(e);
      break;
    case ExprKind::Assign:
      out = assign(e);
      break;
    case ExprKind::Call:
      out = call(e);
      break;
    case ExprKind::Cast:
      out = cast(e);
      break;
    case ExprKind::Comma:
      for (const ExprPtr& part : e.args) out = value(*part);
      break;
  }
  place_ = outer;
  return out;
}

int32_t Lowering::name(const Expr& e) {
  const Variable& v = *e.variable;
  if (v.global >= 0) {
    const auto g = static_cast<Global>(v.global);
    if (!info(g).readableIn(code_.kind))
      messages_.error(e.place, fmt::format("{} shaders have no \"{}\"", compiler::name(code_.kind), e.text), e.length);
    return code_.kind == ShaderKind::Light ? ofLight(g) : global(g);
  }
  const auto it = registers_.find(&v);
  return it != registers_.end() ? it->second : variable(v);
}

// Returns P or N of a light shader: the place of the light and the direction in which it looks. They are a point of the
// geometry of AreaLightSource, or the origin and the z axis of its space (RISpec 3.2, table 12.2).
int32_t Lowering::ofLight(Global g) {
  if (g != Global::P && g != Global::N && g != Global::Ng) return global(g);
  code_.asksPlace |= g == Global::P;
  if (code_.onGeometry) return global(g == Global::P ? g : Global::N);
  const auto [it, isNew] = ofLight_.try_emplace(g, -1);
  if (!isNew) return it->second;
  const bool position = g == Global::P;
  const int32_t own = constant(Shape::Triple, {0, 0, position ? 0.0f : 1.0f}), current = temporary(Shape::Triple);
  it->second = add({.shape = Shape::Triple, .origin = Origin::Variable});
  Register& r = code_.registers[static_cast<size_t>(it->second)];
  r.name = info(g).name;
  r.depth = 0;
  Instruction first{.op = Op::TransformSpace, .out = {current}, .in = {text("shader"), text("current"), own}};
  first.extra = position ? TM_AS_POINT : TM_AS_NORMAL;
  Instruction second{.op = Op::Copy, .out = {it->second}, .in = {current}};
  second.masked = false;
  code_.body.insert(code_.body.begin(), {std::move(first), std::move(second)});
  return it->second;
}

int32_t Lowering::element(const Expr& e) {
  const int32_t array = value(*e.args[0]), index = value(*e.args[1]);
  if (e.args[0]->type.isTriple()) return compute(Op::Component, {array, index});
  return element(array, index);
}

int32_t Lowering::element(int32_t array, int32_t index) {
  switch (shape(array)) {
    case Shape::Number:
      return compute(Op::ElementF, {array, index});
    case Shape::Triple:
      return compute(Op::ElementT, {array, index});
    case Shape::Matrix:
      return compute(Op::ElementM, {array, index});
    default:
      return compute(Op::ElementS, {array, index});
  }
}

int32_t Lowering::tuple(const Expr& e) {
  std::vector<const Expr*> parts;
  for (const ExprPtr& part : e.args) parts.push_back(part.get());
  const std::vector<int32_t> in = values(parts, {{Base::Float}});
  return e.args.size() == 16 ? compute(Op::MakeMatrix, in) : compute(Op::MakeTriple, in);
}

int32_t Lowering::binary(const Expr& e) {
  const auto operation = binaryOperation(e.text, e.args[0]->type, e.args[1]->type);
  const Type wanted = operation->operand == kUnknown ? Type{Base::Float} : operation->operand;
  std::vector<int32_t> in = values({e.args[0].get(), e.args[1].get()}, {wanted});
  if (e.text == ">" || e.text == ">=") std::swap(in[0], in[1]);
  if (e.text == "/" && operation->op == Op::MatrixProduct) in[1] = compute(Op::MatrixInverse, {in[1]});
  // In a product that the context needs as a triple, numbers stay numbers.
  const bool triple = shape(in[0]) == Shape::Triple || shape(in[1]) == Shape::Triple;
  const bool matrix = shape(in[0]) == Shape::Matrix || shape(in[1]) == Shape::Matrix;
  const int32_t out = compute(operation->op, in, matrix ? Shape::Matrix : triple ? Shape::Triple : Shape::Number);
  return operation->negated && operation->op != Op::NotEqual ? compute(Op::Not, {out}) : out;
}

int32_t Lowering::condition(const Expr& e) {
  const int32_t reg = value(e);
  return shape(reg) == Shape::Triple ? compute(Op::Not, {compute(Op::TripleEqual, {reg, number(0)})}) : reg;
}

int32_t Lowering::conditional(const Expr& e) {
  const int32_t chosen = condition(*e.args[0]);
  const Shape of = shapeOf(e.type);
  if (of != Shape::Text && isCheap(*e.args[1]) && isCheap(*e.args[2])) {
    const int32_t a = value(*e.args[1], e.type), b = value(*e.args[2], e.type);
    return compute(Op::Select, {chosen, a, b}, of);
  }
  const int32_t out = add({.shape = of, .origin = Origin::Variable});
  if (of != Shape::Text) initialise(out, number(0));
  Block then = block([&] { copy(out, value(*e.args[1], e.type)); });
  Block otherwise = block([&] { copy(out, value(*e.args[2], e.type)); });
  ifElse(chosen, std::move(then), std::move(otherwise));
  return out;
}

void Lowering::store(const Expr& to, int32_t from) {
  if (to.kind == ExprKind::Index) {
    const int32_t array = value(*to.args[0]), index = value(*to.args[1]);
    if (to.args[0]->type.isTriple()) return store(*to.args[0], compute(Op::SetComponent, {array, index, from}));
    emit(Op::SetElement, {array}, {index, from});
    return;
  }
  const Variable& v = *to.variable;
  const GlobalInfo* global = v.global >= 0 ? &info(static_cast<Global>(v.global)) : nullptr;
  const bool moves = code_.kind == ShaderKind::Surface && v.global == static_cast<int32_t>(Global::P);
  if (global && global->readableIn(code_.kind) && !global->writableIn(code_.kind) && !moves)
    messages_.warning(
        to.place,
        fmt::format("a {} shader that assigns \"{}\" changes it for itself alone", compiler::name(code_.kind), to.text),
        to.length);
  copy(name(to), from);
}

int32_t Lowering::assign(const Expr& e) {
  const Expr &to = *e.args[0], &from = *e.args[1];
  if (e.text == "=") {
    const int32_t reg = value(from, to.type);
    store(to, reg);
    return reg;
  }
  const std::string op = e.text.substr(0, e.text.size() - 1);
  const auto operation = binaryOperation(op, to.type, from.type);
  const Type wanted = operation->operand == kUnknown ? Type{Base::Float} : operation->operand;
  int32_t right = value(from, wanted);
  if (op == "/" && operation->op == Op::MatrixProduct) right = compute(Op::MatrixInverse, {right});
  const int32_t left = value(to);
  const int32_t reg = compute(operation->op, {left, right}, shapeOf(to.type));
  store(to, reg);
  return reg;
}

int32_t Lowering::cast(const Expr& e) {
  const int32_t reg = value(*e.args[0], e.written);
  if (!e.hasSpace || e.text.empty()) return reg;
  if (e.written.is(Base::Color))
    return e.text == "rgb" ? reg : compute(Op::ColorTransform, {text(e.text), text("rgb"), reg});
  if (e.written.is(Base::Matrix))
    return compute(Op::MatrixProduct, {reg, compute(Op::SpaceMatrix, {text(e.text), text("current")})});
  if (e.text == "current") return reg;
  const int32_t out = compute(Op::TransformSpace, {text(e.text), text("current"), reg});
  block_->back().extra = e.written.is(Base::Point)    ? TM_AS_POINT
                         : e.written.is(Base::Vector) ? TM_AS_VECTOR
                                                      : TM_AS_NORMAL;
  return out;
}

int32_t Lowering::target(const Expr& to, std::vector<std::pair<const Expr*, int32_t>>& after) {
  if (to.kind == ExprKind::Name) return name(to);
  const int32_t reg = add({.shape = shapeOf(to.type), .origin = Origin::Variable});
  initialise(reg, value(to));
  after.push_back({&to, reg});
  return reg;
}

}  // namespace tomales::compiler
