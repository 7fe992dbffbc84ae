// Derivatives by forward differentiation of the code itself. Each register that a Step needs gets two more, for its
// changes over one micropolygon along u and v. After each instruction that writes the register come instructions that
// write its changes. Short rules are written by hand (rules.cpp); otherwise central differences f(x + dx/2) - f(x -
// dx/2) are taken. Light is taken to be constant over a micropolygon.
#include <algorithm>

#include "reyes/rsl/globals.h"
#include "reyes/rsl/passes/passes.h"
#include "reyes/rsl/passes/rules.h"
#include "reyes/rsl/passes/walk.h"

namespace tomales::compiler {
namespace {

bool isStep(const Instruction& i) { return i.op == Op::StepU || i.op == Op::StepV; }

class Derivation {
 public:
  explicit Derivation(Code& code) : code_(code), writes_(writeCounts(code)) {}

  void run() {
    bool asks = false;
    forEach(code_.body, [&](const Instruction& i) {
      asks |= isStep(i);
      if (isStep(i)) need(i.in[0]);
    });
    if (!asks) return;
    for (bool more = true; more;) {
      const size_t before = needed_.size();
      forEach(code_.body, [&](const Instruction& i) { reach(i); });
      more = needed_.size() != before;
    }
    makeRegisters();
    Block body = std::move(code_.body);
    Block first = starts();
    Block rest = rewritten(std::move(body));
    // The changes that the host knows are asked for first, once.
    code_.body = std::move(asked_);
    for (Block* part : {&first, &rest})
      code_.body.insert(code_.body.end(), std::make_move_iterator(part->begin()), std::make_move_iterator(part->end()));
  }

 private:
  const Register& at(int32_t r) const { return code_.registers[static_cast<size_t>(r)]; }
  /// Tells whether the host can give the change of the register.
  bool isOfHost(int32_t r) const { return isGiven(r) && writes_[static_cast<size_t>(r)] == 0; }
  /// Tells whether the register holds a value before the shader runs.
  bool isGiven(int32_t r) const {
    return at(r).origin == Origin::Global ||
           (at(r).origin == Origin::Parameter && !code_.parameters[static_cast<size_t>(at(r).index)].output);
  }
  bool changes(int32_t r) const {
    return r >= 0 && at(r).varying && (at(r).shape == Shape::Number || at(r).shape == Shape::Triple);
  }
  void need(int32_t r) {
    if (changes(r) && !isOfHost(r) && std::find(needed_.begin(), needed_.end(), r) == needed_.end())
      needed_.push_back(r);
  }
  bool isNeeded(int32_t r) const {
    return steps_.size() > static_cast<size_t>(r) && steps_[static_cast<size_t>(r)].u >= 0;
  }

  void reach(const Instruction& i) {
    const bool wanted = std::any_of(i.out.begin(), i.out.end(), [&](int32_t r) {
      return std::find(needed_.begin(), needed_.end(), r) != needed_.end();
    });
    if (!wanted) return;
    for (const size_t k : differentiated(i)) need(i.in[k]);
  }

  int32_t add(Shape shape, Origin origin, int32_t length, int32_t depth) {
    Register r{.shape = shape, .origin = origin, .length = length};
    r.depth = depth;
    code_.registers.push_back(std::move(r));
    return static_cast<int32_t>(code_.registers.size()) - 1;
  }

  void makeRegisters() {
    steps_.assign(code_.registers.size(), {});
    zero_ = add(Shape::Number, Origin::Constant, 0, 0);
    code_.registers.back().floats = {0};
    code_.registers.back().varying = false;
    for (const int32_t r : needed_) {
      const Register reg = at(r);  // a copy: the list grows
      const Origin origin = reg.origin == Origin::Temporary ? Origin::Temporary : Origin::Variable;
      for (int32_t* side : {&steps_[static_cast<size_t>(r)].u, &steps_[static_cast<size_t>(r)].v}) {
        *side = add(reg.shape, origin, reg.length, reg.depth);
        if (!reg.name.empty())
          code_.registers.back().name = (side == &steps_[static_cast<size_t>(r)].u ? "d" : "e") + reg.name;
      }
    }
  }

  /// Initialises the changes of globals and parameters that the shader assigns with the changes that the host knows.
  Block starts() {
    Block out;
    for (const int32_t r : needed_) {
      if (!isGiven(r)) continue;
      for (const Op side : {Op::StepU, Op::StepV}) {
        out.push_back({.op = Op::Copy, .out = {step(r, side)}, .in = {hostStep(r, side)}, .masked = false});
      }
    }
    return out;
  }

  /// Returns the register that holds the change of a register.
  int32_t step(int32_t r, Op side) {
    if (!changes(r)) return zero_;
    if (static_cast<size_t>(r) < steps_.size() && isNeeded(r))
      return side == Op::StepU ? steps_[static_cast<size_t>(r)].u : steps_[static_cast<size_t>(r)].v;
    return isOfHost(r) ? hostStep(r, side) : zero_;
  }

  /// Asks the host for a change. It knows the changes of positions, normals, coordinates and primitive variables. I
  /// changes like the position that it leads to.
  int32_t hostStep(int32_t r, Op side) {
    if (at(r).origin == Origin::Global) switch (static_cast<Global>(at(r).index)) {
        case Global::P:
        case Global::N:
        case Global::u:
        case Global::v:
        case Global::s:
        case Global::t:
          break;
        case Global::I:
        case Global::Ps:
          r = place();
          break;
        default:
          return zero_;
      }
    for (const Instruction& i : asked_)
      if (i.op == side && i.in[0] == r) return i.out[0];
    const int32_t out = add(at(r).shape, Origin::Temporary, 0, 0);
    asked_.push_back({.op = side, .out = {out}, .in = {r}});
    return out;
  }
  /// Returns the register of P.
  int32_t place() {
    for (size_t k = 0; k < code_.registers.size(); ++k)
      if (code_.registers[k].origin == Origin::Global && code_.registers[k].index == static_cast<int32_t>(Global::P))
        return static_cast<int32_t>(k);
    const int32_t r = add(Shape::Triple, Origin::Global, 0, 0);
    code_.registers.back().name = info(Global::P).name;
    code_.registers.back().index = static_cast<int32_t>(Global::P);
    return r;
  }

  Block rewritten(Block block) {
    Block out;
    for (Instruction& i : block) {
      for (Block& inner : i.blocks) inner = rewritten(std::move(inner));
      if (isStep(i)) {
        const int32_t value = step(i.in[0], i.op);
        // A Step under a mask works on all points, like every pure instruction.
        out.push_back({.op = Op::Copy, .out = i.out, .in = {value}, .place = i.place, .masked = false});
        if (isNeeded(i.out[0])) still(i, out);
        continue;
      }
      std::vector<int32_t> before, after;
      forEachWrite(i, [&](int32_t r) {
        if (isNeeded(r)) after.push_back(r);
      });
      const Instruction copy = after.empty() ? Instruction{Op::Leave, {}, {}} : withoutBlocks(i);
      // The rules read the old operands, so a variable's change is written before the variable.
      if (!after.empty() && !i.out.empty() && at(i.out[0]).origin != Origin::Temporary) {
        changeOf(copy, out);
        out.push_back(std::move(i));
      } else {
        out.push_back(std::move(i));
        if (!after.empty()) changeOf(copy, out);
      }
    }
    return out;
  }
  static Instruction withoutBlocks(const Instruction& i) {
    return {.op = i.op,
            .out = i.out,
            .in = i.in,
            .extra = i.extra,
            .settings = i.settings,
            .place = i.place,
            .masked = i.masked};
  }

  /// Sets the changes of the results to 0, because they do not change or their change is not known.
  void still(const Instruction& i, Block& out) {
    forEachWrite(i, [&](int32_t r) {
      if (!isNeeded(r)) return;
      for (const Op side : {Op::StepU, Op::StepV})
        out.push_back({.op = Op::Copy,
                       .out = {step(r, side)},
                       .in = {zero_},
                       .place = i.place,
                       .masked = i.masked && !info(i.op).pure()});
    });
  }

  void changeOf(const Instruction& i, Block& out) {
    if (i.out.size() != 1 || differentiated(i).empty()) return still(i, out);
    for (const Op side : {Op::StepU, Op::StepV}) {
      RuleContext context{code_, out, i, zero_, side, [&](int32_t r) { return step(r, side); }};
      writeChange(context, step(i.out[0], side));
    }
  }

  struct Steps {
    int32_t u = -1, v = -1;
  };
  Code& code_;
  const std::vector<int> writes_;
  std::vector<int32_t> needed_;
  std::vector<Steps> steps_;
  Block asked_;
  int32_t zero_ = -1;
};

}  // namespace

void deriveSteps(Code& code) {
  if (code.kind == ShaderKind::Displacement) return;
  Derivation(code).run();
}

}  // namespace tomales::compiler
