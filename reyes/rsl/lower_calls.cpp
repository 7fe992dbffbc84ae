#include <fmt/format.h>

#include "reyes/rsl/lowering.h"

namespace tomales::compiler {

int32_t Lowering::call(const Expr& e) {
  if (e.function) return inlined(e, *e.function);
  if (e.missing) {
    emit(Op::Report, {}, {text(fmt::format("calls {}(), which is unknown; its value is magenta, or 1", e.text))});
    if (e.type.is(Base::String)) return text("");
    if (e.type.is(Base::Matrix)) return compute(Op::MatrixOf, {number(1)});
    return e.type.isTriple() ? constant(Shape::Triple, {1, 0, 1}) : number(1);
  }
  return builtin(e, *e.builtin);
}

namespace {

int returnsIn(const Stmt& s) {
  int n = s.kind == StmtKind::Return;
  for (const StmtPtr& part : s.body) n += returnsIn(*part);
  return n;
}

}  // namespace

// Arguments are passed by reference (RISpec 12.3): a plain variable of the parameter's own type is the parameter.
std::vector<std::pair<const Expr*, int32_t>> Lowering::bindArguments(const Expr& e, const Function& f) {
  std::vector<const Expr*> arguments;
  std::vector<Type> types;
  for (size_t i = 0; i < e.args.size(); ++i) {
    arguments.push_back(e.args[i].get());
    types.push_back(f.parameters[i]->type);
  }
  std::vector<int32_t> given;
  std::vector<std::pair<const Expr*, int32_t>> after;
  if (!arguments.empty()) given = values(arguments, types);
  for (size_t i = 0; i < given.size(); ++i) {
    const Variable& p = *f.parameters[i];
    if (p.output) {
      registers_[&p] = target(*e.args[i], after);
    } else if (p.type.isArray() || (!p.assigned && shape(given[i]) == shapeOf(p.type))) {
      registers_[&p] = given[i];
    } else {
      const int32_t from = given[i];
      initialise(variable(p), from);
    }
  }
  return after;
}

int32_t Lowering::inlineStraight(const Function& f) {
  int32_t result = -1;
  functions_.push_back({});
  const Stmt* last = f.body->body.empty() ? nullptr : f.body->body.back().get();
  for (const StmtPtr& s : f.body->body) {
    if (s.get() == last && last->kind == StmtKind::Return)
      result = last->exprs.empty() || !last->exprs[0] ? -1 : value(*last->exprs[0], f.result);
    else
      statement(*s);
  }
  functions_.pop_back();
  return result;
}

int32_t Lowering::inlineWithReturns(const Function& f) {
  int32_t result = -1;
  if (f.result != Type{}) result = add({.shape = shapeOf(f.result), .origin = Origin::Variable});
  if (result >= 0) initialise(result, shape(result) == Shape::Text ? text("") : number(0));
  functions_.push_back({result, code_.labels++, f.result});
  Block body = block([&] { statement(*f.body); });
  Instruction& scope = emit(Op::Scope, {}, {});
  scope.extra = functions_.back().label;
  scope.blocks.push_back(std::move(body));
  functions_.pop_back();
  return result;
}

int32_t Lowering::inlined(const Expr& e, const Function& f) {
  const auto after = bindArguments(e, f);
  const auto nothing = [&] { return shapeOf(f.result) == Shape::Text ? text("") : number(0); };
  if (!hasRoom()) return nothing();  // functions that each call the next one twice double the code
  const int returns = returnsIn(*f.body);
  const bool straight = returns == 0 || (returns == 1 && f.body->body.back()->kind == StmtKind::Return);
  const int32_t result = straight ? inlineStraight(f) : inlineWithReturns(f);
  for (const auto& [to, from] : after) store(*to, from);
  return result < 0 ? nothing() : result;
}

}  // namespace tomales::compiler
