// Common subexpressions, by value numbers: a mutable register has a new version after each write.
#include <map>

#include "reyes/rsl/passes/passes.h"
#include "reyes/rsl/passes/walk.h"

namespace tomales::compiler {
namespace {

class Sharing {
 public:
  explicit Sharing(Code& code) : code_(code), versions_(code.registers.size(), 0) {
    by_.resize(code.registers.size());
    for (size_t k = 0; k < by_.size(); ++k) by_[k] = static_cast<int32_t>(k);
    numberConstants();
  }

  void run(Block& block) {
    known_.emplace_back();
    for (Instruction& i : block) {
      replaceReads(i, by_);
      if (i.blocks.empty()) {
        share(i);
        renew(i);
        continue;
      }
      // Registers that a loop changes have other values in its second iteration.
      const bool again = i.op != Op::If && i.op != Op::Scope;
      if (again) renewAll(i);
      for (Block& inner : i.blocks) run(inner);
      replaceReads(i, by_);
      renewAll(i);
    }
    known_.pop_back();
  }

 private:
  using Key = std::pair<std::pair<Op, Shape>, std::vector<int64_t>>;

  /// Gives constants of the same value one number.
  void numberConstants() {
    std::map<std::pair<Shape, std::pair<std::string, std::vector<std::string>>>, int32_t> first;
    for (size_t k = 0; k < code_.registers.size(); ++k) {
      const Register& r = code_.registers[k];
      if (r.origin != Origin::Constant) continue;
      const std::string bits(reinterpret_cast<const char*>(r.floats.data()), r.floats.size() * sizeof(float));
      by_[k] = first.try_emplace({r.shape, {bits, r.texts}}, static_cast<int32_t>(k)).first->second;
    }
  }
  void renew(const Instruction& i) {
    forEachWrite(i, [&](int32_t r) { ++versions_[static_cast<size_t>(r)]; });
  }
  void renewAll(const Instruction& i) {
    renew(i);
    for (const Block& inner : i.blocks) forEach(inner, [&](const Instruction& within) { renew(within); });
  }
  void share(const Instruction& i) {
    if (!info(i.op).pure() || i.out.size() != 1) return;
    const Register& out = code_.registers[static_cast<size_t>(i.out[0])];
    if (out.origin != Origin::Temporary) return;
    Key key{{i.op, out.shape}, {i.extra}};
    for (const int32_t r : i.in)
      key.second.push_back(r < 0 ? -1 : (static_cast<int64_t>(r) << 32) + versions_[static_cast<size_t>(r)]);
    for (const auto& scope : known_)
      if (const auto it = scope.find(key); it != scope.end()) {
        by_[static_cast<size_t>(i.out[0])] = it->second;
        return;
      }
    known_.back().emplace(std::move(key), i.out[0]);
  }

  Code& code_;
  std::vector<int64_t> versions_;
  std::vector<int32_t> by_;
  std::vector<std::map<Key, int32_t>> known_;
};

}  // namespace

void shareExpressions(Code& code) { Sharing(code).run(code.body); }

}  // namespace tomales::compiler
