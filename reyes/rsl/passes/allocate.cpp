// Assigns slots to registers in the order of the code, by first fit. A register that lives into or out of a loop lives
// through all of it, since the loop runs its code again.
#include <algorithm>

#include "reyes/rsl/passes/passes.h"
#include "reyes/rsl/passes/walk.h"

namespace tomales::compiler {
namespace {

struct Life {
  int32_t first = -1, last = -1;
};

class Lives {
 public:
  explicit Lives(const Code& code) : lives(code.registers.size()) {
    visit(code.body);
    end = at_;
  }
  std::vector<Life> lives;
  int32_t end = 0;

 private:
  void touch(int32_t r) {
    Life& life = lives[static_cast<size_t>(r)];
    if (life.first < 0) life.first = at_;
    life.last = at_;
  }
  void visit(const Block& block) {
    for (const Instruction& i : block) {
      ++at_;
      const auto touchThis = [&](int32_t r) { touch(r); };
      forEachRead(i, touchThis);
      forEachWrite(i, touchThis);
      if (i.blocks.empty()) continue;
      const int32_t from = at_;
      for (const Block& inner : i.blocks) visit(inner);
      ++at_;
      forEachRead(i, touchThis);
      forEachWrite(i, touchThis);  // a loop reads its condition again and again
      if (i.op == Op::If || i.op == Op::Scope) continue;
      for (Life& life : lives) {
        if (life.first < 0 || life.last < from) continue;
        // It is used in the loop, and its value comes from before the loop or from the round before.
        if (life.first < from) life.last = std::max(life.last, at_);
      }
    }
  }
  int32_t at_ = 0;
};

class Slots {
 public:
  static constexpr int32_t kMostSlots = 1 << 30;

  /// Takes the first place of `width` slots that is free from `first` to `last`.
  int32_t take(int32_t width, Life life) {
    std::erase_if(taken_, [&](const Taken& t) { return t.life.last < life.first; });
    std::sort(taken_.begin(), taken_.end(), [](const Taken& a, const Taken& b) { return a.slot < b.slot; });
    int32_t slot = 0;
    for (const Taken& t : taken_) {
      if (t.slot - slot >= width) break;
      slot = std::max(slot, t.slot + t.width);
    }
    if (width > kMostSlots - slot) {  // far beyond what is accepted: the shader is refused
      size = kMostSlots;
      return 0;
    }
    taken_.push_back({slot, width, life});
    size = std::max(size, slot + width);
    return slot;
  }
  int32_t size = 0;

 private:
  struct Taken {
    int32_t slot, width;
    Life life;
  };
  std::vector<Taken> taken_;
};

}  // namespace

void allocateSlots(Code& code) {
  const Lives all(code);
  std::vector<size_t> order;
  std::vector<Life> lives = all.lives;
  for (size_t k = 0; k < lives.size(); ++k) {
    const Origin origin = code.registers[k].origin;
    if (lives[k].first < 0 && origin != Origin::Parameter) continue;
    if (origin == Origin::Constant || code.registers[k].shape == Shape::Text) continue;
    if (origin != Origin::Temporary && origin != Origin::Variable) lives[k] = {0, all.end};
    order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return lives[a].first < lives[b].first; });
  Slots varying, uniform;
  for (const size_t k : order) {
    Register& r = code.registers[k];
    const int32_t width = floatsOf(r.shape) * std::max(1, r.length);
    r.slot = (r.varying ? varying : uniform).take(width, lives[k]);
  }
  code.varyingFloats = varying.size;
  code.uniformFloats = uniform.size;
}

}  // namespace tomales::compiler
