#include "reyes/rsl/machine/program.h"

#include <algorithm>

#include "reyes/rsl/globals.h"
#include "reyes/rsl/machine/table.h"

namespace tomales::compiler {
namespace {

int32_t lastLabel(const Block& block) {
  int32_t last = -1;
  for (const Instruction& i : block) {
    if (i.op == Op::Scope || i.op == Op::Leave) last = std::max(last, i.extra);
    if (i.op == Op::Loop) last = std::max(last, i.extra + 1);
    for (const Block& inner : i.blocks) last = std::max(last, lastLabel(inner));
  }
  return last;
}

}  // namespace

Program::Program(Code code) : code_(std::move(code)) {
  located_.resize(code_.registers.size());
  used_.resize(code_.registers.size());
  left_.resize(static_cast<size_t>(std::max(code_.labels, lastLabel(code_.body) + 1)));
  find(code_.body, true);
  locate();
  body_ = prepared(code_.body);
}

void Program::find(const Block& block, bool writes) {
  const auto use = [&](int32_t r, bool assigned) {
    if (r < 0) return;
    used_[static_cast<size_t>(r)] = true;
    if (assigned) located_[static_cast<size_t>(r)].assigned = true;
  };
  for (const Instruction& i : block) {
    for (const int32_t r : i.out) use(r, writes);
    for (const int32_t r : i.in) use(r, false);
    for (const Setting& s : i.settings) use(s.name, false), use(s.value, s.fills);
    if (i.op == Op::Leave) left_[static_cast<size_t>(i.extra)] = true;
    for (const Block& inner : i.blocks) find(inner, writes);
  }
}

void Program::locate() {
  varying_ = code_.varyingFloats, uniform_ = code_.uniformFloats;
  std::vector<std::pair<size_t, float>> constants;
  for (size_t k = 0; k < located_.size(); ++k) {
    const Register& r = code_.registers[k];
    Located& l = located_[k];
    const bool output = r.origin == Origin::Parameter && code_.parameters[static_cast<size_t>(r.index)].output;
    if (!used_[k] && !output) continue;
    const int32_t size = floatsOf(r) * elementsOf(r);
    if (const GlobalInfo* global = r.origin == Origin::Global ? findGlobal(r.name) : nullptr)
      l.global = static_cast<int32_t>(global->global);
    if (r.shape == Shape::Text) {
      l.where = Where::Texts, l.at = texts_;
      if (r.origin != Origin::Constant) texts_ += elementsOf(r);
    } else if (r.origin == Origin::Constant) {
      l.where = Where::Constant, l.at = static_cast<int32_t>(constants_.size());
      for (size_t f = 0; f < static_cast<size_t>(size); ++f)
        constants_.insert(constants_.end(), kBlock, f < r.floats.size() ? r.floats[f] : 0.0f);
    } else {
      const bool inGrid = r.origin == Origin::Global || r.origin == Origin::Parameter;
      l.where = !r.varying ? Where::Uniform : inGrid && !l.assigned && !output ? Where::Given : Where::Varying;
      int32_t& next = r.varying ? varying_ : uniform_;
      l.at = r.slot >= 0 ? r.slot : next;
      if (r.slot < 0) next += size;
    }
  }
}

Steps Program::prepared(const Block& block) const {
  Steps out;
  out.reserve(block.size());
  for (const Instruction& i : block) {
    Step& s = out.emplace_back();
    s.of = &i;
    s.kernel = kernelOf(i.op);
    const bool componentwise = s.kernel && info(i.op).componentwise();
    s.execute = executeOf(i.op);
    if (!i.out.empty() && i.out[0] >= 0) {
      s.uniform = !reg(i.out[0]).varying;
      s.components = componentwise ? floatsOf(reg(i.out[0])) : 1;
    }
    if (i.op == Op::Scope || i.op == Op::Loop) s.left[0] = left_[static_cast<size_t>(i.extra)];
    if (i.op == Op::Loop) s.left[1] = left_[static_cast<size_t>(i.extra) + 1];
    for (const Block& inner : i.blocks) s.blocks.push_back(prepared(inner));
  }
  return out;
}

}  // namespace tomales::compiler
