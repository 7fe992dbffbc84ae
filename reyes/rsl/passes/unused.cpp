// Removes computations whose results nobody reads.
#include <algorithm>

#include "reyes/rsl/globals.h"
#include "reyes/rsl/passes/passes.h"
#include "reyes/rsl/passes/walk.h"

namespace tomales::compiler {
namespace {

/// Tells whether the instruction does more than write its results.
bool hasEffect(const Instruction& i) {
  switch (i.op) {
    case Op::Print:
    case Op::Report:
    case Op::Plugin:
    case Op::Bake3d:
    case Op::Leave:
    case Op::RandomF:  // later random numbers depend on how many calls were before
    case Op::RandomT:
    case Op::RandomGrid:
      return true;
    default:
      return false;
  }
}

/// Tells whether the host or the caller reads the register after the shader.
bool isSeen(const Code& code, const Register& r) {
  if (r.origin == Origin::Parameter) {
    const Parameter& p = code.parameters[static_cast<size_t>(r.index)];
    return p.output || p.told;
  }
  return r.origin == Origin::Global && info(static_cast<Global>(r.index)).writableIn(code.kind);
}

class Removal {
 public:
  explicit Removal(Code& code) : code_(code) {}

  void run() {
    do {
      removed_ = false;
      reads_.assign(code_.registers.size(), 0);
      forEach(code_.body, [&](const Instruction& i) {
        forEachRead(i, [&](int32_t r) { ++reads_[static_cast<size_t>(r)]; });
        // A store into part of a variable does not count as a read: it matters only if something else reads the
        // variable.
      });
      sweep(code_.body);
    } while (removed_);
    writes_ = writeCounts(code_);
    for (size_t r = 0; r < code_.registers.size(); ++r) by_.push_back(static_cast<int32_t>(r));
    join(code_.body);
    forEach(code_.body, [&](Instruction& i) { replaceReads(i, by_); });
  }

 private:
  bool isRead(int32_t r) const {
    const Register& reg = code_.registers[static_cast<size_t>(r)];
    return reads_[static_cast<size_t>(r)] > 0 || isSeen(code_, reg);
  }

  bool isUseless(const Instruction& i) const {
    if (hasEffect(i)) return false;
    bool useful = false;
    forEachWrite(i, [&](int32_t r) { useful |= isRead(r); });
    if (useful) return false;
    if (i.op == Op::Loop) return false;  // it may be endless, which must be reported
    return std::all_of(i.blocks.begin(), i.blocks.end(), [](const Block& b) { return b.empty(); });
  }

  void sweep(Block& block) {
    for (Instruction& i : block)
      for (Block& inner : i.blocks) sweep(inner);
    // An If whose blocks have lost all their instructions goes with them.
    removed_ |= std::erase_if(block, [&](const Instruction& i) { return isUseless(i); }) > 0;
  }

  /// `t = a + b; x = t` becomes `x = a + b`, where t has no other reader, or its readers find the same in x because
  /// nothing else is ever assigned to it.
  void join(Block& block) {
    for (Instruction& i : block)
      for (Block& inner : i.blocks) join(inner);
    for (size_t k = 0; k + 1 < block.size(); ++k) {
      Instruction &first = block[k], &second = block[k + 1];
      if (second.op != Op::Copy || second.masked || first.out.size() != 1 || second.in[0] != first.out[0]) continue;
      if (!info(first.op).kernel() || first.op == Op::Copy) continue;
      const int32_t t = first.out[0], x = second.out[0];
      const Register &from = code_.registers[static_cast<size_t>(t)], &to = code_.registers[static_cast<size_t>(x)];
      const bool lasts = writes_[static_cast<size_t>(x)] == 1 && writes_[static_cast<size_t>(t)] == 1;
      if (from.origin != Origin::Temporary || (reads_[static_cast<size_t>(t)] != 1 && !lasts)) continue;
      if (from.shape != to.shape || from.varying != to.varying || to.length != 0) continue;
      // Only componentwise kernels may write over what they read.
      const bool overlaps = std::find(first.in.begin(), first.in.end(), x) != first.in.end();
      if (overlaps && (!info(first.op).componentwise() || from.shape != Shape::Number)) continue;
      first.out[0] = by_[static_cast<size_t>(t)] = x;
      block.erase(block.begin() + static_cast<long>(k) + 1);
    }
  }

  Code& code_;
  std::vector<int> reads_, writes_;
  std::vector<int32_t> by_;  ///< What stands for each register in the end.
  bool removed_ = false;
};

}  // namespace

void removeUnused(Code& code) { Removal(code).run(); }

}  // namespace tomales::compiler
