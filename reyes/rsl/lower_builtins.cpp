#include <fmt/format.h>

#include <algorithm>

#include "reyes/rsl/lowering.h"

namespace tomales::compiler {

std::vector<int32_t> Lowering::arguments(const Expr& e, const Builtin& b, size_t count) {
  std::vector<const Expr*> list;
  std::vector<Type> types;
  for (size_t i = 0; i < count; ++i) {
    list.push_back(e.args[i].get());
    const Slot& slot = b.slots[std::min(i, b.slots.size() - 1)];
    types.push_back(slot.any || i >= b.slots.size() ? e.args[i]->type : Type{slot.base, slot.array ? kOpenArray : 0});
  }
  return list.empty() ? std::vector<int32_t>{} : values(list, types);
}

int32_t Lowering::builtin(const Expr& e, const Builtin& b) {
  switch (b.emit) {
    case Emit::Instruction:
      return instruction(e, b);
    case Emit::Fold:
      return fold(e, b);
    case Emit::Component:
      return component(e, b);
    case Emit::SetComponent:
      return setComponent(e, b);
    case Emit::Derivative:
      return derivative(e, b);
    case Emit::Normal:
      return calculatedNormal(e, b);
    case Emit::Spline:
      return spline(e, b);
    case Emit::Transform:
      return transform(e, b);
    case Emit::ColorTransform:
      return colorTransform(e, b);
    case Emit::Texture:
      return texture(e, b);
    case Emit::Environment:
      return environment(e, b);
    case Emit::Shadow:
      return shadow(e, b);
    case Emit::List:
    case Emit::Traced:
      return withList(e, b);
    case Emit::Ask:
      return ask(e, b);
    case Emit::ShaderName:
      return shaderName(e, b);
    case Emit::Print:
      return print(e, b);
    case Emit::ArrayLength:
      return arrayLength(e, b);
    case Emit::Plugin:
      return plugin(e, b);
  }
  return 0;
}

int32_t Lowering::instruction(const Expr& e, const Builtin& b) {
  return compute(b.op, arguments(e, b, e.args.size()), shapeOf({b.result}));
}

int32_t Lowering::fold(const Expr& e, const Builtin& b) {
  const std::vector<int32_t> in = arguments(e, b, e.args.size());
  int32_t out = in[0];
  for (size_t i = 1; i < in.size(); ++i) out = compute(b.op, {out, in[i]}, shapeOf({b.result}));
  return out;
}

int32_t Lowering::component(const Expr& e, const Builtin& b) {
  return compute(b.op, {value(*e.args[0]), number(b.number)});
}

int32_t Lowering::derivative(const Expr& e, const Builtin& b) {
  const Shape of = shapeOf({b.result});
  const int32_t step = compute(b.op, arguments(e, b, 1), of);
  const int32_t size = global(b.op == Op::StepU ? Global::du : Global::dv);
  const int32_t moves = compute(Op::NotEqual, {size, number(0)});
  return compute(Op::Select, {moves, compute(Op::Div, {step, size}, of), number(0)}, of);
}

int32_t Lowering::colorTransform(const Expr& e, const Builtin& b) {
  std::vector<int32_t> in = arguments(e, b, e.args.size());
  if (in.size() == 2) in.insert(in.begin(), text("rgb"));
  return compute(b.op, in);
}

int32_t Lowering::shaderName(const Expr& e, const Builtin&) {
  if (e.args.empty()) return text(code_.name);
  const int32_t of = value(*e.args[0]);
  return compute(Op::ShaderName, {of});
}

int32_t Lowering::print(const Expr& e, const Builtin& b) {
  std::vector<int32_t> in = arguments(e, b, e.args.size());
  for (size_t i = 0; i < in.size(); ++i) in[i] = widened(in[i], e.args[i]->type);
  if (b.op != Op::Print) return compute(b.op, in);
  emit(b.op, {}, in);
  return number(0);
}

int32_t Lowering::arrayLength(const Expr& e, const Builtin&) {
  return number(static_cast<float>(std::max(code_.registers[static_cast<size_t>(value(*e.args[0]))].length, 0)));
}

int32_t Lowering::setComponent(const Expr& e, const Builtin& b) {
  std::vector<int32_t> in = arguments(e, b, e.args.size());
  if (b.number >= 0) in.insert(in.begin() + 1, number(b.number));
  store(*e.args[0], compute(b.op, in));
  return number(0);
}

int32_t Lowering::plugin(const Expr& e, const Builtin& b) {
  const std::vector<int32_t> in = arguments(e, b, e.args.size());
  std::vector<int32_t> out;
  std::vector<std::pair<const Expr*, int32_t>> after;
  if (b.result != Base::Void) out.push_back(temporary(shapeOf({b.result})));
  for (size_t i = 0; i < e.args.size(); ++i)
    if (b.slots[i].output) out.push_back(target(*e.args[i], after));
  emit(Op::Plugin, out, in).extra = static_cast<int32_t>(code_.plugins.size());
  code_.plugins.push_back(&b);
  for (const auto& [to, from] : after) store(*to, from);
  return b.result != Base::Void ? out[0] : number(0);
}

int32_t Lowering::calculatedNormal(const Expr& e, const Builtin&) { return normalOf(value(*e.args[0])); }

// A surface's normal follows from steps, which the passes derive; for a displacement the host takes differences on its
// grid.
int32_t Lowering::normalOf(int32_t position) {
  if (code_.kind == ShaderKind::Displacement) return compute(Op::CalculateNormal, {position});
  const int32_t across = compute(
      Op::Cross, {compute(Op::StepU, {position}, Shape::Triple), compute(Op::StepV, {position}, Shape::Triple)});
  // A shader cannot know which way dPdu ^ dPdv points, so the normal is put on the side of the geometric one. Steps are
  // dPdu du and dPdv dv. On a polygon, whose u and v are its x and y, du or dv may be a rounding error of either sign.
  const auto edge = [&](Global derivative, Global size) {
    return compute(Op::Mul, {global(derivative), global(size)}, Shape::Triple);
  };
  const int32_t natural = compute(Op::Cross, {edge(Global::dPdu, Global::du), edge(Global::dPdv, Global::dv)});
  const int32_t against = compute(Op::Less, {compute(Op::Dot, {natural, global(Global::Ng)}), number(0)});
  const int32_t turned =
      compute(Op::Select, {against, compute(Op::Neg, {across}, Shape::Triple), across}, Shape::Triple);
  const int32_t exists = compute(Op::Less, {number(0), compute(Op::Length, {across})});
  return compute(Op::Select, {exists, compute(Op::Normalize, {turned}), global(Global::N)}, Shape::Triple);
}

int32_t Lowering::spline(const Expr& e, const Builtin& b) {
  std::vector<int32_t> in = arguments(e, b, e.args.size());
  if (b.slots[0].base != Base::String) in.insert(in.begin(), text("catmull-rom"));
  const bool numbers = b.result == Base::Float;
  const size_t knots = in.size() - 2;
  if (!b.slots.back().array && knots < 4)
    messages_.error(e.place, fmt::format("spline() needs four knots or more, and has {}", knots), e.length);
  return compute(numbers ? Op::SplineF : Op::SplineT, in);
}

int32_t Lowering::transform(const Expr& e, const Builtin& b) {
  std::vector<int32_t> in = arguments(e, b, e.args.size());
  const auto between = [&](int32_t from, int32_t to, int32_t x) {
    const int32_t out = compute(Op::TransformSpace, {from, to, x});
    block_->back().extra = static_cast<int32_t>(b.number);
    return out;
  };
  const int32_t current = text("current");
  if (b.op == Op::TransformSpace) return in.size() == 2 ? between(current, in[0], in[1]) : between(in[0], in[1], in[2]);
  return compute(b.op, {in[1], between(current, in[0], in[2])});
}

std::vector<Setting> Lowering::settings(const std::vector<ExprPtr>& list, size_t from, std::string_view function,
                                        std::vector<std::pair<const Expr*, int32_t>>& after) {
  std::vector<Setting> out;
  for (size_t i = from; i + 1 < list.size(); i += 2) {
    const Expr &name = *list[i], &of = *list[i + 1];
    Setting s;
    s.fills = name.kind == ExprKind::String && isFilled(function, name.text);
    s.name = value(name);
    s.value = s.fills ? target(of, after) : widened(value(of), of.type);
    s.base = of.type.base;
    out.push_back(s);
  }
  return out;
}

int32_t Lowering::withList(const Expr& e, const Builtin& b) {
  const size_t n = b.slots.size();
  std::vector<int32_t> in = arguments(e, b, n);
  std::vector<std::pair<const Expr*, int32_t>> after;
  std::vector<Setting> list = settings(e.args, n, b.name, after);
  if (b.op == Op::Subsurface) {
    int32_t file = text("");
    for (size_t k = 0; k < list.size(); ++k)
      if (const Expr& name = *e.args[n + 2 * k]; name.kind == ExprKind::String && name.text == "filename") {
        file = list[k].value;
        list.erase(list.begin() + static_cast<long>(k));
        break;
      }
    in.insert(in.begin(), file);
  } else if (b.slots[0].base == Base::String && b.op == Op::Occlusion) {
    in.erase(in.begin());  // a map of another renderer, which is replaced by traced rays
  } else if (b.emit == Emit::Traced && in.size() == 2) {
    constexpr float kRays = 64;  // used where neither an argument nor the list says how many
    in.push_back(number(kRays));
  }
  const int32_t out = compute(b.op, in);
  block_->back().settings = std::move(list);
  for (const auto& [to, reg] : after) store(*to, reg);
  return out;
}

int32_t Lowering::ask(const Expr& e, const Builtin& b) {
  std::vector<std::pair<const Expr*, int32_t>> after;
  const size_t last = e.args.size() - 1;
  std::vector<int32_t> in;
  for (size_t i = 0; i < last; ++i) in.push_back(value(*e.args[i]));
  const Setting filled{-1, target(*e.args[last], after), true, e.args[last]->type.base};
  const int32_t out = compute(b.op, in);
  block_->back().settings = {filled};
  block_->back().extra = static_cast<int32_t>(b.number);
  for (const auto& [to, reg] : after) store(*to, reg);
  return out;
}

}  // namespace tomales::compiler
