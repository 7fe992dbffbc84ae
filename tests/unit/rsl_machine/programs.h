// Programs made of choices: nested conditions, loops, scopes and what leaves them, with values that are the same for
// all points and values that are not. And a plain interpreter of one point at a time, which knows no masks. The choices
// come from whoever asks: a generator of random numbers, or a fuzzer's bytes.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "tests/unit/rsl_machine/builder.h"

namespace tomales::compiler {

/// A number below the given one.
using Choice = std::function<uint32_t(uint32_t)>;

class MadeProgram {
 public:
  explicit MadeProgram(const Choice& choice) : choice_(choice) {
    u_ = b.global("u", Shape::Number);
    for (int k = 0; k < kOutputs; ++k)
      varying_.push_back(b.parameter("out" + std::to_string(k), Base::Float, {static_cast<float>(k)}, true));
    for (int k = 0; k < 2; ++k) varying_.push_back(b.variable());
    for (int k = 0; k < 2; ++k) uniform_.push_back(b.variable(Shape::Number, false));
    array_ = b.variable(Shape::Number, true, 3);
    block(0);
    for (int k = 0; k < 2; ++k) b.copy(varying_[static_cast<size_t>(k)], uniform_[static_cast<size_t>(k)]);
    b.copy(varying_[2], b.value(Op::ElementF, {array_, varying_[2]}));
  }

  Builder b;
  static constexpr int kOutputs = 5;  ///< The first parameters.

 private:
  struct Label {
    int32_t label;
    bool ofSome;  ///< Points may leave it one by one.
  };
  uint32_t pick(uint32_t below) { return choice_(below); }

  int32_t operand(bool uniform) {
    if (pick(3) == 0) return b.number(static_cast<float>(pick(9)) - 4);
    if (uniform || pick(4) == 0) return uniform_[pick(static_cast<uint32_t>(uniform_.size()))];
    const uint32_t k = pick(static_cast<uint32_t>(varying_.size()) + 1);
    return k == varying_.size() ? u_ : varying_[k];
  }
  int32_t computed(bool uniform) {
    static constexpr Op kOps2[] = {Op::Add, Op::Sub, Op::Mul, Op::Min, Op::Max, Op::Less, Op::And};
    if (!uniform && pick(8) == 0) return b.value(Op::ElementF, {array_, operand(pick(2) == 0)});
    const int32_t x = b.value(kOps2[pick(7)], {operand(uniform), operand(uniform)}, Shape::Number, !uniform);
    // Held, so that loops leave neither infinity nor what is not a number.
    return b.value(Op::Max, {b.number(-8), b.value(Op::Min, {x, b.number(8)}, Shape::Number, !uniform)}, Shape::Number,
                   !uniform);
  }
  int32_t condition(bool uniform) {
    return b.value(Op::Less, {operand(uniform), operand(uniform)}, Shape::Number, !uniform);
  }

  /// Under control that varies nothing uniform is assigned.
  bool mayBeUniform() const { return varies_ == 0; }

  void assign() {
    if (mayBeUniform() && pick(3) == 0)
      b.copy(uniform_[pick(2)], computed(true));
    else if (pick(5) == 0)
      b.emit(Op::SetElement, {array_}, {operand(pick(2) == 0), operand(false)});
    else
      b.copy(varying_[pick(static_cast<uint32_t>(varying_.size()))], computed(false));
  }
  void within(bool varies, const Builder::Body& body) {
    varies_ += varies;
    body();
    varies_ -= varies;
  }
  void branch(int depth) {
    const bool uniform = pick(3) == 0;
    const int32_t c = condition(uniform);
    within(!uniform, [&] {
      const Builder::Body body = [&] { block(depth + 1); };
      if (pick(2))
        b.branch(c, body, body);
      else
        b.branch(c, body);
    });
  }
  /// Ends by a counter that nothing else reads or writes.
  void loop(int depth) {
    const bool uniform = pick(3) == 0, ofSome = varies_ > 0 || !uniform || pick(2) == 0;
    const int32_t counter = b.variable(Shape::Number, !ofSome ? false : pick(2) == 0), label = b.label(2);
    const bool varying = b.code.registers[static_cast<size_t>(counter)].varying;
    b.copy(counter, b.number(0));
    const int32_t holds = b.temporary(Shape::Number, varying || !uniform);
    within(ofSome, [&] {
      labels_.push_back({label, ofSome});
      labels_.push_back({label + 1, ofSome});
      b.loop(
          holds, label,
          [&] {
            const int32_t counts =
                b.value(Op::Less, {counter, b.number(static_cast<float>(pick(5)))}, Shape::Number, varying);
            b.emit(Op::And, {holds}, {counts, uniform ? counts : condition(false)});
          },
          [&] { block(depth + 1); },
          [&] {
            b.copy(counter, b.value(Op::Add, {counter, b.number(1)}, Shape::Number, varying));
          });
      labels_.pop_back();
      labels_.pop_back();
    });
  }
  void scope(int depth) {
    const bool ofSome = varies_ > 0 || pick(2) == 0;
    const int32_t label = b.label();
    within(ofSome, [&] {
      labels_.push_back({label, ofSome});
      b.scope(label, [&] { block(depth + 1); });
      labels_.pop_back();
    });
  }
  void leave() {
    std::vector<int32_t> open;
    for (const Label& l : labels_)
      if (varies_ == 0 || l.ofSome) open.push_back(l.label);
    if (!open.empty()) b.leave(open[pick(static_cast<uint32_t>(open.size()))]);
  }
  void block(int depth) {
    const uint32_t count = 1 + pick(4);
    for (uint32_t k = 0; k < count; ++k) {
      const uint32_t what = pick(depth < 5 ? 10 : 5);
      if (what < 4)
        assign();
      else if (what == 4)
        leave();
      else if (what < 7)
        branch(depth);
      else if (what < 9)
        loop(depth);
      else
        scope(depth);
    }
  }

  const Choice& choice_;
  int32_t u_ = -1, array_ = -1, varies_ = 0;
  std::vector<int32_t> varying_, uniform_;
  std::vector<Label> labels_;
};

/// One point through a made program, by plain control flow.
class OnePoint {
 public:
  OnePoint(const Code& code, float u) : code_(code), values_(code.registers.size()) {
    for (size_t k = 0; k < values_.size(); ++k) {
      const Register& r = code.registers[k];
      values_[k].assign(static_cast<size_t>(std::max(1, r.length)), 0.0f);
      if (r.origin == Origin::Constant) values_[k] = r.floats;
      if (r.origin == Origin::Global) values_[k] = {u};
      if (r.origin == Origin::Parameter) values_[k] = code.parameters[static_cast<size_t>(r.index)].floats;
    }
    run(code.body);
  }
  float parameter(int32_t index) const {
    for (size_t k = 0; k < values_.size(); ++k)
      if (code_.registers[k].origin == Origin::Parameter && code_.registers[k].index == index) return values_[k][0];
    return -1000;
  }

 private:
  static constexpr int32_t kGoesOn = -1;
  float& at(int32_t r) { return values_[static_cast<size_t>(r)][0]; }
  float& element(int32_t array, float index) {
    auto& all = values_[static_cast<size_t>(array)];
    const float last = static_cast<float>(all.size()) - 1;
    return all[static_cast<size_t>(std::clamp(std::floor(index), 0.0f, last))];
  }
  /// The label that is left; kGoesOn: none.
  int32_t run(const Block& block) {
    for (const Instruction& i : block)
      if (const int32_t left = run(i); left != kGoesOn) return left;
    return kGoesOn;
  }
  int32_t loop(const Instruction& i) {
    for (;;) {
      if (const int32_t left = run(i.blocks[0]); left != kGoesOn) return left == i.extra ? kGoesOn : left;
      if (at(i.in[0]) == 0) return kGoesOn;
      if (const int32_t left = run(i.blocks[1]); left != kGoesOn && left != i.extra + 1)
        return left == i.extra ? kGoesOn : left;
      if (const int32_t left = run(i.blocks[2]); left != kGoesOn) return left == i.extra ? kGoesOn : left;
    }
  }
  int32_t run(const Instruction& i) {
    const auto x = [&](size_t k) { return at(i.in[k]); };
    switch (i.op) {
      case Op::If:
        return x(0) != 0 ? run(i.blocks[0]) : i.blocks.size() > 1 ? run(i.blocks[1]) : kGoesOn;
      case Op::Loop:
        return loop(i);
      case Op::Leave:
        return i.extra;
      case Op::Scope: {
        const int32_t left = run(i.blocks[0]);
        return left == i.extra ? kGoesOn : left;
      }
      case Op::SetElement:
        element(i.out[0], x(0)) = x(1);
        return kGoesOn;
      case Op::ElementF:
        at(i.out[0]) = element(i.in[0], x(1));
        return kGoesOn;
      default:
        break;
    }
    float& out = at(i.out[0]);
    switch (i.op) {
      case Op::Copy:
        out = x(0);
        break;
      case Op::Add:
        out = x(0) + x(1);
        break;
      case Op::Sub:
        out = x(0) - x(1);
        break;
      case Op::Mul:
        out = x(0) * x(1);
        break;
      case Op::Min:
        out = std::min(x(0), x(1));
        break;
      case Op::Max:
        out = std::max(x(0), x(1));
        break;
      case Op::Less:
        out = x(0) < x(1);
        break;
      case Op::And:
        out = x(0) != 0 && x(1) != 0;
        break;
      default:
        std::abort();
    }
    return kGoesOn;
  }
  const Code& code_;
  std::vector<std::vector<float>> values_;
};

}  // namespace tomales::compiler
