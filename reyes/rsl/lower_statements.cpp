#include <utility>

#include "reyes/rsl/lowering.h"

namespace tomales::compiler {

void Lowering::initialiseArray(const Variable& v, int32_t reg) {
  const Expr& e = *v.initial;
  if (e.kind == ExprKind::Tuple) {
    for (size_t k = 0; k < e.args.size(); ++k)
      emit(Op::SetElement, {reg}, {number(static_cast<float>(k)), value(*e.args[k], {v.type.base})});
  } else if (e.type.isArray()) {
    copy(reg, value(e));
  } else {
    const int32_t same = value(e, {v.type.base});
    for (int32_t k = 0; k < v.type.length; ++k) emit(Op::SetElement, {reg}, {number(static_cast<float>(k)), same});
  }
}

void Lowering::declaration(const Variable& v) {
  if (v.outer) return;
  if (v.type.isArray()) {
    const int32_t reg = variable(v);
    if (shape(reg) != Shape::Text) initialise(reg, number(0));
    if (v.initial) initialiseArray(v, reg);
    return;
  }
  // The value is lowered first: in `float x = x` it means the outer x.
  const Shape of = shapeOf(v.type);
  const int32_t from = v.initial ? value(*v.initial, v.type) : of == Shape::Text ? text("") : number(0);
  const int32_t reg = variable(v);
  if (!v.used && !v.assigned) return;
  initialise(reg, v.initial || of != Shape::Matrix ? from : compute(Op::MatrixOf, {from}));
}

void Lowering::statement(const Stmt& s) {
  const Place outer = std::exchange(place_, s.place);
  switch (s.kind) {
    case StmtKind::Empty:
    case StmtKind::Define:
      break;
    case StmtKind::Block:
      for (const StmtPtr& part : s.body) statement(*part);
      break;
    case StmtKind::Expression:
      value(*s.exprs[0]);
      break;
    case StmtKind::Declare:
      for (const auto& v : s.variables) declaration(*v);
      break;
    case StmtKind::If:
      ifElse(*s.exprs[0], s.body[0].get(), s.body.size() > 1 ? s.body[1].get() : nullptr);
      break;
    case StmtKind::While:
      loop(s.exprs[0].get(), *s.body[0], nullptr);
      break;
    case StmtKind::For:
      if (s.exprs[0]) value(*s.exprs[0]);
      loop(s.exprs[1].get(), *s.body[0], s.exprs[2].get());
      break;
    case StmtKind::Break:
    case StmtKind::Continue:
      jump(s);
      break;
    case StmtKind::Return: {
      const Inlined function = functions_.back();  // a call in the expression may move the list
      if (!s.exprs.empty() && s.exprs[0]) copy(function.result, value(*s.exprs[0], function.type));
      emit(Op::Leave, {}, {}).extra = function.label;
      break;
    }
    case StmtKind::Illuminance:
      illuminance(s);
      break;
    case StmtKind::Illuminate:
      illuminate(s);
      break;
    case StmtKind::Solar:
      solar(s);
      break;
    case StmtKind::Gather:
      gather(s);
      break;
  }
  place_ = outer;
}

void Lowering::ifElse(const Expr& e, const Stmt* then, const Stmt* otherwise) {
  const int32_t chosen = condition(e);
  Block first = block([&] { statement(*then); }), second;
  if (otherwise) second = block([&] { statement(*otherwise); });
  ifElse(chosen, std::move(first), std::move(second));
}

void Lowering::ifElse(int32_t condition, Block then, Block otherwise) {
  Instruction& i = emit(Op::If, {}, {condition});
  i.blocks.push_back(std::move(then));
  i.blocks.push_back(std::move(otherwise));
}

void Lowering::loop(const Expr* until, const Stmt& body, const Expr* step) {
  const int32_t label = code_.labels;
  code_.labels += 2;
  loops_.push_back({label, label + 1});
  int32_t reg = -1;
  Block test = block([&] {
    reg = until ? condition(*until) : number(1);
    // The loop reads a register that its own block must have written.
    if (code_.registers[static_cast<size_t>(reg)].origin != Origin::Temporary)
      reg = compute(Op::NotEqual, {reg, number(0)});
  });
  Block inner = block([&] { statement(body); });
  Block after = block([&] {
    if (step) value(*step);
  });
  loops_.pop_back();
  Instruction& i = emit(Op::Loop, {}, {reg});
  i.extra = label;
  i.blocks.push_back(std::move(test));
  i.blocks.push_back(std::move(inner));
  i.blocks.push_back(std::move(after));
}

void Lowering::jump(const Stmt& s) {
  const LoopLabels& labels = loops_[loops_.size() - static_cast<size_t>(s.count)];
  emit(Op::Leave, {}, {}).extra = s.kind == StmtKind::Break ? labels.leave : labels.next;
}

}  // namespace tomales::compiler
