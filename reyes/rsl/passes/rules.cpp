#include "reyes/rsl/passes/rules.h"

#include <algorithm>

namespace tomales::compiler {
namespace {

/// Emits instructions that compute a change. Terms with a register of zero are left out.
class Rule {
 public:
  explicit Rule(RuleContext& c) : c_(c), place_(c.i.place) {}

  int32_t in(size_t k) const { return c_.i.in[k]; }
  int32_t d(size_t k) const { return c_.stepOf(c_.i.in[k]); }
  int32_t y() const { return c_.i.out[0]; }
  Shape shape(int32_t r) const { return c_.code.registers[static_cast<size_t>(r)].shape; }
  bool none(int32_t r) const { return r == c_.zero; }

  int32_t constant(float value) {
    c_.code.registers.push_back(
        {.shape = Shape::Number, .origin = Origin::Constant, .varying = false, .floats = {value}});
    return static_cast<int32_t>(c_.code.registers.size()) - 1;
  }
  int32_t compute(Op op, std::vector<int32_t> in, Shape shape) {
    c_.code.registers.push_back({.shape = shape});
    const auto out = static_cast<int32_t>(c_.code.registers.size()) - 1;
    c_.out.push_back({.op = op, .out = {out}, .in = std::move(in), .place = place_});
    return out;
  }
  /// Emits a componentwise instruction, as wide as its widest operand.
  int32_t each(Op op, std::vector<int32_t> in) {
    const bool triple = std::any_of(in.begin(), in.end(), [&](int32_t r) { return shape(r) == Shape::Triple; });
    return compute(op, std::move(in), triple ? Shape::Triple : Shape::Number);
  }
  int32_t add(int32_t a, int32_t b) { return none(a) ? b : none(b) ? a : each(Op::Add, {a, b}); }
  int32_t sub(int32_t a, int32_t b) { return none(b) ? a : none(a) ? each(Op::Neg, {b}) : each(Op::Sub, {a, b}); }
  int32_t mul(int32_t a, int32_t b) { return none(a) || none(b) ? c_.zero : each(Op::Mul, {a, b}); }
  int32_t div(int32_t a, int32_t b) { return none(a) ? a : each(Op::Div, {a, b}); }
  int32_t neg(int32_t a) { return none(a) ? a : each(Op::Neg, {a}); }
  int32_t dot(int32_t a, int32_t b) { return none(a) || none(b) ? c_.zero : compute(Op::Dot, {a, b}, Shape::Number); }
  int32_t cross(int32_t a, int32_t b) {
    return none(a) || none(b) ? c_.zero : compute(Op::Cross, {a, b}, Shape::Triple);
  }
  /// Gives `value` where a number is greater than 0, and 0 elsewhere.
  int32_t wherePositive(int32_t number, int32_t value) {
    if (none(value)) return value;
    return each(Op::Select, {compute(Op::Less, {c_.zero, number}, Shape::Number), value, c_.zero});
  }

  /// Returns the change of a transformed point. The point is divided by its weight w = p . c + m33, where c is the last
  /// column of the matrix, unless w is 0. So with the result y its change is (d M - y (d . c)) / w, or d M.
  int32_t changeOfPoint() {
    const auto weightOf = [&](float row) {
      return compute(Op::MatrixElement, {in(0), constant(row), constant(3)}, Shape::Number);
    };
    const int32_t column = compute(Op::MakeTriple, {weightOf(0), weightOf(1), weightOf(2)}, Shape::Triple);
    const int32_t turned = compute(Op::TransformVector, {in(0), d(1)}, Shape::Triple);
    const int32_t weight = add(dot(in(1), column), weightOf(3));
    const int32_t isDivided = compute(Op::NotEqual, {weight, c_.zero}, Shape::Number);
    const int32_t divisor = each(Op::Select, {isDivided, weight, constant(1)});
    return each(Op::Select, {isDivided, div(sub(turned, mul(y(), dot(d(1), column))), divisor), turned});
  }

  int32_t changeOfDirection() {
    const int32_t length = compute(Op::Length, {in(0)}, Shape::Number);
    return wherePositive(length, div(sub(d(0), mul(dot(y(), d(0)), y())), length));
  }

  /// Returns the registers of the change; empty if there is no short rule.
  std::vector<int32_t> change() {
    switch (c_.i.op) {
      case Op::Copy:
        return {d(0)};
      case Op::Add:
        return {add(d(0), d(1))};
      case Op::Sub:
        return {sub(d(0), d(1))};
      case Op::Neg:
        return {neg(d(0))};
      case Op::Mul:
        return {add(mul(in(0), d(1)), mul(in(1), d(0)))};
      case Op::Div:
        return {div(sub(d(0), mul(y(), d(1))), in(1))};
      case Op::Mix:
        return {add(add(d(0), mul(in(2), sub(d(1), d(0)))), none(d(2)) ? c_.zero : mul(sub(in(1), in(0)), d(2)))};
      case Op::Select:
        return {none(d(1)) && none(d(2)) ? c_.zero : each(Op::Select, {in(0), d(1), d(2)})};
      case Op::MakeTriple:
        return {compute(Op::MakeTriple, {d(0), d(1), d(2)}, Shape::Triple)};
      case Op::Component:
        return {none(d(0)) ? c_.zero : compute(Op::Component, {d(0), in(1)}, Shape::Number)};
      case Op::SetComponent:
        return {compute(Op::SetComponent, {d(0), in(1), d(2)}, Shape::Triple)};
      case Op::ElementF:
        return {none(d(0)) ? c_.zero : compute(c_.i.op, {d(0), in(1)}, Shape::Number)};
      case Op::ElementT:
        return {none(d(0)) ? c_.zero : compute(c_.i.op, {d(0), in(1)}, Shape::Triple)};
      case Op::Dot:
        return {add(dot(in(0), d(1)), dot(d(0), in(1)))};
      case Op::Cross:
        return {add(cross(in(0), d(1)), cross(d(0), in(1)))};
      case Op::Length:
        return {wherePositive(y(), div(dot(in(0), d(0)), y()))};
      case Op::Normalize:
        return {changeOfDirection()};
      case Op::Faceforward:  // plus or minus N
        return {none(d(0)) ? c_.zero : compute(Op::Faceforward, {d(0), in(1), in(2)}, Shape::Triple)};
      case Op::TransformPoint:
        return {none(d(1)) ? c_.zero : changeOfPoint()};
      case Op::TransformVector:
      case Op::TransformNormal:
        return {none(d(1)) ? c_.zero : compute(c_.i.op, {in(0), d(1)}, Shape::Triple)};
      case Op::Noise3F:
        return {none(d(0)) ? c_.zero : compute(Op::Slope3F, {in(0), d(0)}, Shape::Number)};
      case Op::Noise3T:
        return {none(d(0)) ? c_.zero : compute(Op::Slope3T, {in(0), d(0)}, Shape::Triple)};
      default:
        return number();
    }
  }

 private:
  /// Returns the rules for functions of numbers, which hold for each component.
  std::vector<int32_t> number() {
    const auto square = [&](int32_t r) { return each(Op::Mul, {r, r}); };
    const auto one = [&] { return constant(1); };
    switch (c_.i.op) {
      case Op::Abs:
        return {mul(each(Op::Sign, {in(0)}), d(0))};
      case Op::Sqrt:
        return {wherePositive(y(), div(d(0), each(Op::Mul, {constant(2), y()})))};
      case Op::InverseSqrt:
        return {mul(mul(constant(-.5f), mul(y(), square(y()))), d(0))};
      case Op::Exp:
        return {mul(y(), d(0))};
      case Op::Log:
        return {wherePositive(in(0), div(d(0), in(0)))};
      case Op::Sin:
        return {mul(each(Op::Cos, {in(0)}), d(0))};
      case Op::Cos:
        return {neg(mul(each(Op::Sin, {in(0)}), d(0)))};
      case Op::Tan:
        return {mul(add(one(), square(y())), d(0))};
      case Op::Atan:
        return {div(d(0), add(one(), square(in(0))))};
      case Op::Atan2:
        return {div(sub(mul(in(1), d(0)), mul(in(0), d(1))), add(square(in(0)), square(in(1))))};
      case Op::Mod:
        return none(d(1)) ? std::vector{d(0)} : std::vector<int32_t>{};
      default:
        return shape(y()) == Shape::Number ? numberAlone() : std::vector<int32_t>{};
    }
  }

  /// Returns the rules that hold for numbers, but not for the components of triples.
  std::vector<int32_t> numberAlone() {
    switch (c_.i.op) {
      case Op::Pow:
        return {changeOfPower()};
      case Op::Min:
        return {changeOfChosen(0, 1)};
      case Op::Max:
        return {changeOfChosen(1, 0)};
      case Op::Clamp:
        return {changeOfClamped()};
      default:
        return {};
    }
  }

  /// y (b dx / x + log(x) db), where x > 0
  int32_t changeOfPower() {
    return wherePositive(
        in(0), mul(y(), add(div(mul(in(1), d(0)), in(0)), none(d(1)) ? c_.zero : mul(each(Op::Log, {in(0)}), d(1)))));
  }

  /// Returns the change of operand `then` where the first operand is less than the second one, else that of
  /// `otherwise`.
  int32_t changeOfChosen(size_t then, size_t otherwise) {
    return each(Op::Select, {compute(Op::Less, {in(0), in(1)}, Shape::Number), d(then), d(otherwise)});
  }

  int32_t changeOfClamped() {
    const int32_t below = compute(Op::Less, {in(0), in(1)}, Shape::Number);
    const int32_t above = compute(Op::Less, {in(2), in(0)}, Shape::Number);
    return each(Op::Select, {below, d(1), each(Op::Select, {above, d(2), d(0)})});
  }

  RuleContext& c_;
  const Place place_;
};

/// Computes f(x + dx/2) - f(x - dx/2), in all operands that change.
int32_t byDifference(RuleContext& c, Rule& rule) {
  int32_t ends[2];
  for (int k = 0; k < 2; ++k) {
    Instruction moved{.op = c.i.op,
                      .out = {},
                      .in = c.i.in,
                      .extra = c.i.extra,
                      .settings = c.i.settings,
                      .place = c.i.place,
                      .masked = c.i.masked};
    for (const size_t at : differentiated(c.i)) {
      const int32_t step = rule.d(at);
      if (rule.none(step) || c.code.registers[static_cast<size_t>(c.i.in[at])].length != 0) continue;  // knots stay
      const int32_t half = rule.mul(rule.constant(k == 0 ? -.5f : .5f), step);
      moved.in[at] = rule.each(Op::Add, {c.i.in[at], half});
    }
    const bool picture = c.i.op == Op::TextureF || c.i.op == Op::TextureT;
    if (picture && moved.in[4] < 0) {  // half a micropolygon away, the region is as large as in the middle
      const Shape number = Shape::Number;
      moved.in[4] = rule.compute(Op::StepU, {c.i.in[2]}, number);
      moved.in[5] = rule.compute(Op::StepU, {c.i.in[3]}, number);
      moved.in[6] = rule.compute(Op::StepV, {c.i.in[2]}, number);
      moved.in[7] = rule.compute(Op::StepV, {c.i.in[3]}, number);
    }
    c.code.registers.push_back({.shape = rule.shape(rule.y())});
    ends[k] = static_cast<int32_t>(c.code.registers.size()) - 1;
    moved.out = {ends[k]};
    c.out.push_back(std::move(moved));
  }
  return rule.sub(ends[1], ends[0]);
}

}  // namespace

void writeChange(RuleContext& c, int32_t to) {
  Rule rule(c);
  if (c.i.op == Op::SetElement) {
    c.out.push_back({.op = Op::SetElement,
                     .out = {to},
                     .in = {c.i.in[0], c.stepOf(c.i.in[1])},
                     .place = c.i.place,
                     .masked = c.i.masked});
    return;
  }
  const std::vector<size_t> operands = differentiated(c.i);
  const bool still = std::all_of(operands.begin(), operands.end(), [&](size_t k) { return rule.none(rule.d(k)); });
  std::vector<int32_t> value = still ? std::vector{c.zero} : rule.change();
  if (value.empty()) value = {byDifference(c, rule)};
  // The change of a Copy is masked like the Copy itself; results of pure instructions are for all points.
  const bool masked = c.i.op == Op::Copy && c.i.masked;
  c.out.push_back({.op = Op::Copy, .out = {to}, .in = {value[0]}, .place = c.i.place, .masked = masked});
}

}  // namespace tomales::compiler
