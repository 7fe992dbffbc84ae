// Uniform and varying: everything is uniform until something that varies reaches it (RISpec 3.2 section 11.1 leaves the
// detail of local variables to the compiler).
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "reyes/rsl/globals.h"
#include "reyes/rsl/passes/passes.h"
#include "reyes/rsl/passes/walk.h"
#include "reyes/shader_api.h"

namespace tomales::compiler {
namespace {

class Inference {
 public:
  Inference(Code& code, const std::vector<bool>& varying) : code_(code) {
    for (Register& r : code_.registers) {
      r.varying = false;
      if (r.origin == Origin::Global) r.varying = !info(static_cast<Global>(r.index)).uniform;
      if (r.origin == Origin::Parameter) {
        const auto k = static_cast<size_t>(r.index);
        r.varying = r.shape != Shape::Text && k < varying.size() && varying[k];
        if (code_.parameters[k].output) r.varying = true;
      }
    }
  }

  void run() {
    do {
      changed_ = false;
      visit(code_.body);
    } while (changed_);
    last_ = true;
    visit(code_.body);
  }

 private:
  bool varies(int32_t r) const { return r >= 0 && code_.registers[static_cast<size_t>(r)].varying; }
  void vary(int32_t reg) {
    Register& r = code_.registers[static_cast<size_t>(reg)];
    if (r.varying || r.shape == Shape::Text || r.origin == Origin::Constant) return;
    r.varying = changed_ = true;
  }
  /// Tells whether an enclosing structure varies, from the given depth on.
  bool around(size_t depth) const {
    for (size_t k = depth; k < structures_.size(); ++k)
      if (structures_[k].varies) return true;
    return false;
  }
  void varyStructure(const Instruction* i) {
    if (varying_.insert(i).second) changed_ = true;
  }

  /// Tells whether the results differ from point to point even for uniform arguments.
  static bool asksTheSurface(const Instruction& i) {
    switch (i.op) {
      case Op::RandomGrid:
      case Op::SpecularScale:
      case Op::SpaceMatrix:
      case Op::TransformSpace:
      case Op::TextureInfo:
      case Op::Ask:
      case Op::ShaderName:
      case Op::RayInfo:
      case Op::RayLabel:
      case Op::Copy:
      case Op::SetElement:
        return false;
      default:
        return !info(i.op).pure();
    }
  }
  static bool fillsVary(const Instruction& i) {
    if (i.op == Op::TextureInfo) return false;
    return i.op != Op::Ask || i.extra < TM_OF_ATTRIBUTES;
  }

  void visit(Block& block) {
    for (Instruction& i : block) {
      if (i.op == Op::Leave) {
        leave(i);
        continue;
      }
      bool reads = false;
      forEachRead(i, [&](int32_t r) { reads |= varies(r); });
      if (i.blocks.empty()) {
        const bool given = reads || asksTheSurface(i);
        for (const int32_t r : i.out) write(i, r, given);
        for (const Setting& s : i.settings)
          if (s.fills) write(i, s.value, reads || fillsVary(i));
        if (last_) i.masked = i.masked && around(0);
        continue;
      }
      for (const Setting& s : i.settings)
        if (s.fills) vary(s.value);
      const bool light = i.op == Op::Illuminance || i.op == Op::Gather;
      const bool narrows = light || ((i.op == Op::If || i.op == Op::Loop) && varies(i.in[0]));
      if (last_) i.masked = i.masked && around(0);
      if (narrows) varyStructure(&i);
      for (Block& inner : i.blocks) {
        structures_.push_back({&i, varying_.count(&i) > 0});
        visit(inner);
        structures_.pop_back();
      }
    }
  }

  void write(const Instruction& i, int32_t reg, bool given) {
    if (reg < 0) return;
    const bool inPart = (i.op == Op::Copy || i.op == Op::SetElement || !i.settings.empty()) && i.masked;
    const auto depth = static_cast<size_t>(code_.registers[static_cast<size_t>(reg)].depth);
    if (given || (inPart && around(depth))) vary(reg);
  }

  /// Where some points leave, notes that the code up to the label runs only for the other points.
  void leave(const Instruction& i) {
    size_t from = structures_.size();
    while (from > 0 && !owns(*structures_[from - 1].instruction, i.extra)) --from;
    if (from == 0 || !around(from - 1)) return;
    for (size_t k = from - 1; k < structures_.size(); ++k) varyStructure(structures_[k].instruction);
  }
  static bool owns(const Instruction& i, int32_t label) {
    return (i.op == Op::Scope && i.extra == label) || (i.op == Op::Loop && (i.extra == label || i.extra + 1 == label));
  }

  struct Structure {
    const Instruction* instruction;
    bool varies;
  };
  Code& code_;
  std::vector<Structure> structures_;
  std::set<const Instruction*> varying_;
  bool changed_ = false, last_ = false;
};

}  // namespace

void inferDetail(Code& code, const std::vector<bool>& varying) { Inference(code, varying).run(); }

void warnOfDetail(const Code& lowered, const std::vector<bool>& varying, Messages& messages) {
  const bool any = std::any_of(lowered.registers.begin(), lowered.registers.end(), [](const Register& r) {
    return r.origin == Origin::Variable && (r.declared == Detail::Uniform || r.shape == Shape::Text);
  });
  if (!any) return;
  Code code = lowered;
  inferDetail(code, varying);
  std::set<int32_t> told;
  forEach(code.body, [&](const Instruction& i) {
    if (i.op != Op::Copy) return;
    const Register& r = code.registers[static_cast<size_t>(i.out[0])];
    if (i.masked && r.shape == Shape::Text)
      messages.warning(i.place,
                       "a string is chosen by what differs from point to point; strings are the same for all "
                       "points, so the last choice that any point makes counts");
    // Values from lights and messages do not count, because they are mostly the same for all points.
    const bool given = code.registers[static_cast<size_t>(i.in[0])].varying;
    if (r.declared == Detail::Uniform && r.origin == Origin::Variable && given && told.insert(i.out[0]).second)
      messages.warning(r.place,
                       fmt::format("\"{}\" is declared uniform and is given values that vary; it varies", r.name),
                       static_cast<int32_t>(r.name.size()));
  });
}

}  // namespace tomales::compiler
