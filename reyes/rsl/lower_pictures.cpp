#include <array>

#include "reyes/rsl/lowering.h"

namespace tomales::compiler {

std::pair<int32_t, int32_t> Lowering::picture(const Expr& e) {
  if (e.kind != ExprKind::Index) return {value(e), number(0)};
  const int32_t file = value(*e.args[0]);
  return {file, value(*e.args[1])};
}

// The region is what the micropolygon covers. The host knows it if s and t are the surface's own; if the shader has
// computed them, it follows from their steps. Four corners become the parallelogram with their middle and their mean
// sides.
int32_t Lowering::texture(const Expr& e, const Builtin& b) {
  const auto [file, channel] = picture(*e.args[0]);
  std::vector<int32_t> at;
  size_t i = 1;
  for (; i < e.args.size() && !e.args[i]->type.is(Base::String); ++i) at.push_back(value(*e.args[i]));
  std::vector<int32_t> in{file, channel};
  const auto mean = [&](size_t axis, std::array<float, 4> weights) {
    int32_t sum = -1;
    for (size_t corner = 0; corner < 4; ++corner) {
      const int32_t term = compute(Op::Mul, {number(weights[corner]), at[2 * corner + axis]}, Shape::Number);
      sum = sum < 0 ? term : compute(Op::Add, {sum, term}, Shape::Number);
    }
    return sum;
  };
  if (at.size() == 8) {
    for (const auto& weights :
         {std::array{.25f, .25f, .25f, .25f}, std::array{-.5f, .5f, -.5f, .5f}, std::array{-.5f, -.5f, .5f, .5f}}) {
      in.push_back(mean(0, weights));
      in.push_back(mean(1, weights));
    }
  } else {
    const int32_t s = global(Global::s), t = global(Global::t);
    const int32_t x = at.empty() ? s : at[0], y = at.empty() ? t : at[1];
    in.insert(in.end(), {x, y});
    const bool known = (x == s && y == t) || code_.kind == ShaderKind::Displacement || code_.kind == ShaderKind::Imager;
    if (known) {
      in.insert(in.end(), 4, -1);
    } else {
      for (const Op step : {Op::StepU, Op::StepV}) {
        in.push_back(compute(step, {x}, Shape::Number));
        in.push_back(compute(step, {y}, Shape::Number));
      }
    }
  }
  std::vector<std::pair<const Expr*, int32_t>> after;
  std::vector<Setting> list = settings(e.args, i, b.name, after);
  const int32_t out = compute(b.op, in);
  block_->back().settings = std::move(list);
  return out;
}

// Four directions become their middle and the cone around it that contains them.
int32_t Lowering::environment(const Expr& e, const Builtin& b) {
  const auto [file, channel] = picture(*e.args[0]);
  std::vector<int32_t> directions;
  size_t i = 1;
  for (; i < e.args.size() && !e.args[i]->type.is(Base::String); ++i) directions.push_back(value(*e.args[i]));
  int32_t direction = directions[0], angle = -1;
  if (directions.size() >= 4) {
    int32_t sum = -1;
    for (int32_t& d : directions) {
      d = compute(Op::Normalize, {d});
      sum = sum < 0 ? d : compute(Op::Add, {sum, d}, Shape::Triple);
    }
    direction = compute(Op::Normalize, {sum});
    int32_t least = number(1);
    for (const int32_t d : directions)
      least = compute(Op::Min, {least, compute(Op::Dot, {d, direction})}, Shape::Number);
    constexpr float kSquareOfCircle = 1.41421356f;  // the side of a square over the radius of the circle around it
    angle = compute(Op::Mul, {number(2 / kSquareOfCircle), compute(Op::Acos, {least}, Shape::Number)}, Shape::Number);
  }
  std::vector<std::pair<const Expr*, int32_t>> after;
  std::vector<Setting> list = settings(e.args, i, b.name, after);
  const int32_t out = compute(b.op, {file, channel, direction, angle});
  block_->back().settings = std::move(list);
  return out;
}

// Four corners give the mean of the quarters of their quadrilateral.
int32_t Lowering::shadow(const Expr& e, const Builtin& b) {
  const auto [file, channel] = picture(*e.args[0]);
  std::vector<int32_t> at;
  size_t i = 1;
  for (; i < e.args.size() && !e.args[i]->type.is(Base::String); ++i) at.push_back(value(*e.args[i]));
  std::vector<std::pair<const Expr*, int32_t>> after;
  const std::vector<Setting> list = settings(e.args, i, b.name, after);
  const auto lookUp = [&, file = file](int32_t position) {  // clang 14 captures no structured binding by reference
    const int32_t out = compute(Op::Shadow, {file, position});
    block_->back().settings = list;
    return out;
  };
  int32_t result = -1;
  if (at.size() < 4) {
    result = lookUp(at[0]);
  } else {
    const auto mix = [&](int32_t p, int32_t q, float t) { return compute(Op::Mix, {p, q, number(t)}, Shape::Triple); };
    for (const float a : {.25f, .75f})
      for (const float c : {.25f, .75f}) {
        const int32_t quarter = lookUp(mix(mix(at[0], at[1], a), mix(at[2], at[3], a), c));
        result = result < 0 ? quarter : compute(Op::Add, {result, quarter}, Shape::Triple);
      }
    result = compute(Op::Mul, {result, number(.25f)}, Shape::Triple);
  }
  return b.result == Base::Float ? compute(Op::Component, {result, channel}) : result;
}

}  // namespace tomales::compiler
