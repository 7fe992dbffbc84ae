// Computes constants once, by the kernels that would run them, and replaces copies of registers that never change.
#include <map>
#include <set>

#include "reyes/rsl/kernels.h"
#include "reyes/rsl/passes/passes.h"
#include "reyes/rsl/passes/walk.h"
#include "reyes/shader/shadeops.h"

namespace tomales::compiler {
namespace {

class Folding {
 public:
  explicit Folding(Code& code) : code_(code), writes_(writeCounts(code)) {
    by_.resize(code.registers.size());
    for (size_t k = 0; k < by_.size(); ++k) by_[k] = static_cast<int32_t>(k);
  }

  void run(Block& block) {
    dropFirstValues(block);
    findStraight(block);
    for (Instruction& i : block) {
      replaceReads(i, by_);
      if (i.blocks.empty()) {
        fold(i);
      } else {
        for (Block& inner : i.blocks) run(inner);
        replaceReads(i, by_);  // a loop's condition is computed by its own block
      }
    }
  }
  int32_t now(int32_t reg) const {
    while (by_[static_cast<size_t>(reg)] != reg) reg = by_[static_cast<size_t>(reg)];
    return reg;
  }

 private:
  const Register& at(int32_t r) const { return code_.registers[static_cast<size_t>(r)]; }
  bool isConstant(int32_t r) const { return r >= 0 && at(r).origin == Origin::Constant && at(r).length == 0; }
  bool isNumber(int32_t r, float value) const {
    return isConstant(r) && at(r).shape == Shape::Number && at(r).floats[0] == value;
  }
  /// Tells whether the register holds the same value wherever it may be read.
  bool isFixed(int32_t r) const {
    const Register& reg = at(r);
    if (reg.origin == Origin::Constant) return true;
    if (reg.origin == Origin::Temporary) return true;
    return writes_[static_cast<size_t>(r)] == 0;
  }
  void become(const Instruction& i, int32_t reg) { by_[static_cast<size_t>(i.out[0])] = reg; }

  int32_t constant(Shape shape, std::vector<float> floats) {
    code_.registers.push_back(
        {.shape = shape, .origin = Origin::Constant, .varying = false, .floats = std::move(floats)});
    const auto reg = static_cast<int32_t>(code_.registers.size()) - 1;
    by_.push_back(reg);
    writes_.push_back(0);
    return reg;
  }
  int32_t text(std::string value) {
    code_.registers.push_back(
        {.shape = Shape::Text, .origin = Origin::Constant, .varying = false, .texts = {std::move(value)}});
    const auto reg = static_cast<int32_t>(code_.registers.size()) - 1;
    by_.push_back(reg);
    writes_.push_back(0);
    return reg;
  }

  /// Finds variables that are only ever assigned as a whole, in this very block: a read gives the last assignment.
  void findStraight(const Block& block) {
    std::map<int32_t, int> here;
    for (const Instruction& i : block)
      if (i.op == Op::Copy && !i.masked && at(i.out[0]).origin == Origin::Variable && at(i.out[0]).length == 0)
        ++here[i.out[0]];
    for (const auto& [v, count] : here)
      if (count == writes_[static_cast<size_t>(v)]) straight_.insert(v);
  }

  /// Drops the 0 of a declaration if nothing reads it before the first assignment, which becomes the first value.
  void dropFirstValues(Block& block) {
    for (size_t k = 0; k < block.size(); ++k) {
      Instruction& first = block[k];
      if (first.op != Op::Copy || first.masked || first.out[0] < 0) continue;
      const int32_t v = first.out[0];
      if (at(v).origin != Origin::Variable || at(v).length != 0 || !isConstant(first.in[0])) continue;
      for (size_t n = k + 1; n < block.size(); ++n) {
        Instruction& next = block[n];
        bool touched = false;
        const auto touch = [&](int32_t r) { touched |= r == v; };
        const auto look = [&](const Instruction& i) {
          forEachRead(i, touch);
          forEachWrite(i, touch);
        };
        look(next);
        for (const Block& inner : next.blocks) forEach(inner, look);
        if (!touched) continue;
        if (next.op == Op::Copy && next.out[0] == v && next.in[0] != v) {
          next.masked = false;
          --writes_[static_cast<size_t>(v)];
          block.erase(block.begin() + static_cast<long>(k));
          --k;
        }
        break;
      }
    }
  }

  void fold(Instruction& i) {
    if (i.op == Op::Copy) {
      const int32_t v = i.out[0];
      const bool once = at(v).origin == Origin::Temporary && !i.masked && writes_[static_cast<size_t>(v)] == 1;
      if (!once && straight_.count(v) == 0) return;
      const bool same = at(v).length == 0 && at(v).shape == at(i.in[0]).shape;
      by_[static_cast<size_t>(v)] = same && isFixed(i.in[0]) ? i.in[0] : v;
      return;
    }
    if (!info(i.op).pure() || i.out.size() != 1) return;
    bool all = true;
    for (const int32_t r : i.in) all &= isConstant(r);
    if (all && compute(i)) return;
    simplify(i);
  }

  bool compute(const Instruction& i) {
    if (i.op == Op::StepU || i.op == Op::StepV) {
      become(i, constant(at(i.out[0]).shape, zeros(i)));
      return true;
    }
    if (const Kernel kernel = kernelOf(i.op)) {
      become(i, byKernel(i, kernel));
      return true;
    }
    if (i.op == Op::TextEqual) {
      become(i, constant(Shape::Number, {at(i.in[0]).texts[0] == at(i.in[1]).texts[0] ? 1.0f : 0.0f}));
      return true;
    }
    if (i.op == Op::Concat) {
      std::string all;
      for (const int32_t r : i.in) {
        if (at(r).shape != Shape::Text) return false;
        all += at(r).texts[0];
      }
      if (all.size() > kLongestText) return false;  // the machine cuts it, and says so
      become(i, text(all));
      return true;
    }
    if (i.op == Op::ColorTransform) {
      const std::string &from = at(i.in[0]).texts[0], &into = at(i.in[1]).texts[0];
      if (!::rsl::isColorSpace(from) || !::rsl::isColorSpace(into)) return false;  // the machine says so
      const std::vector<float>& c = at(i.in[2]).floats;
      const ::rsl::Vec3 in = c.size() == 1 ? ::rsl::Vec3{c[0], c[0], c[0]} : ::rsl::Vec3{c[0], c[1], c[2]};
      const ::rsl::Vec3 out = ::rsl::ctransform(from, into, in);
      become(i, constant(Shape::Triple, {out.x, out.y, out.z}));
      return true;
    }
    return false;
  }
  std::vector<float> zeros(const Instruction& i) const {
    return std::vector<float>(static_cast<size_t>(floatsOf(at(i.out[0]).shape)), 0.0f);
  }

  int32_t byKernel(const Instruction& i, Kernel kernel) {
    struct alignas(64) Lane {
      float x[kBlock];
    };
    constexpr size_t kMost = 16;
    Lane memory[17][kMost];
    Lanes in[kMost], out{memory[16][0].x, 0, kBlock};
    for (size_t k = 0; k < i.in.size(); ++k) {
      const std::vector<float>& floats = at(i.in[k]).floats;
      for (size_t c = 0; c < floats.size(); ++c)
        for (float& x : memory[k][c].x) x = floats[c];
      in[k] = {memory[k][0].x, 0, floats.size() == 1 ? 0 : kBlock};
    }
    const Shape shape = at(i.out[0]).shape;
    const int width = floatsOf(shape);
    const bool each = info(i.op).componentwise();
    for (int c = 0; c < (each ? width : 1); ++c) {
      kernel(1, out, in);
      if (!each) break;
      out.data += kBlock;
      for (size_t k = 0; k < i.in.size(); ++k) in[k].data += in[k].component;
    }
    std::vector<float> result(static_cast<size_t>(width));
    for (int c = 0; c < width; ++c) result[static_cast<size_t>(c)] = memory[16][c].x[0];
    return constant(shape, std::move(result));
  }

  /// Removes operations that leave one operand as it is. x * 0 stays, since x may be infinite.
  void simplify(const Instruction& i) {
    const auto take = [&](size_t k) {
      if (isFixed(i.in[k]) && at(i.in[k]).shape == at(i.out[0]).shape) become(i, i.in[k]);
    };
    switch (i.op) {
      case Op::Add:
        if (isNumber(i.in[0], 0)) take(1);
        if (isNumber(i.in[1], 0)) take(0);
        return;
      case Op::Sub:
        if (isNumber(i.in[1], 0)) take(0);
        return;
      case Op::Mul:
        if (isNumber(i.in[0], 1)) take(1);
        if (isNumber(i.in[1], 1)) take(0);
        return;
      case Op::Div:
        if (isNumber(i.in[1], 1)) take(0);
        return;
      case Op::Select:
        if (isConstant(i.in[0])) take(at(i.in[0]).floats[0] != 0 ? 1 : 2);
        return;
      default:
        return;
    }
  }

  Code& code_;
  std::vector<int> writes_;
  std::vector<int32_t> by_;
  std::set<int32_t> straight_;
};

}  // namespace

int32_t foldConstants(Code& code, int32_t of) {
  Folding folding(code);
  folding.run(code.body);
  return of < 0 ? of : folding.now(of);
}

}  // namespace tomales::compiler
