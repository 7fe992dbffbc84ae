#include "reyes/rsl/machine/program.h"

#include <algorithm>

#include "reyes/rsl/globals.h"
#include "reyes/rsl/machine/table.h"
#include "reyes/rsl/passes/walk.h"

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

/// Returns the component that a number means, held to 0..2 as kernels/triples.cpp does.
int32_t componentOf(float which) { return which >= 2 ? 2 : which >= 1 ? 1 : 0; }

/// Joins ranges that touch.
void join(std::vector<Program::Cleared>& ranges) {
  std::sort(ranges.begin(), ranges.end(), [](const Program::Cleared& a, const Program::Cleared& b) {
    return std::pair(a.varying, a.from) < std::pair(b.varying, b.from);
  });
  std::vector<Program::Cleared> out;
  for (const Program::Cleared& r : ranges)
    if (out.empty() || out.back().varying != r.varying || out.back().to < r.from)
      out.push_back(r);
    else
      out.back().to = std::max(out.back().to, r.to);
  ranges = std::move(out);
}

}  // namespace

Program::Program(Code code) : code_(std::move(code)) {
  located_.resize(code_.registers.size());
  used_.resize(code_.registers.size());
  left_.resize(static_cast<size_t>(std::max(code_.labels, lastLabel(code_.body) + 1)));
  find(code_.body);
  findOverwritten();
  locate();
  body_ = prepared(code_.body);
}

void Program::find(const Block& block) {
  const auto use = [&](int32_t r, bool assigned, bool partly = false) {
    if (r < 0) return;
    used_[static_cast<size_t>(r)] = true;
    Located& l = located_[static_cast<size_t>(r)];
    if (assigned) l.once = !l.assigned;
    l.assigned |= assigned;
    l.partly |= partly;
  };
  for (const Instruction& i : block) {
    for (const int32_t r : i.out) use(r, true, i.op == Op::Copy && i.masked);
    for (const int32_t r : i.in) use(r, false);
    for (const Setting& s : i.settings) {
      use(s.name, false);
      use(s.value, s.fills);
    }
    if (i.op == Op::Leave) left_[static_cast<size_t>(i.extra)] = true;
    for (const Block& inner : i.blocks) find(inner);
  }
}

/// Finds registers that are written at all points before anything reads them. Code after a loop does not count, because
/// it may never be reached: an endless loop ends the run (control.cpp).
void Program::findOverwritten() {
  std::vector<bool> touched(located_.size(), false);
  for (const Instruction& i : code_.body) {
    forEachRead(i, [&](int32_t r) { touched[static_cast<size_t>(r)] = true; });
    bool loops = i.op == Op::Loop || i.op == Op::Gather;
    for (const Block& inner : i.blocks)
      forEach(inner, [&](const Instruction& within) {
        const auto touch = [&](int32_t r) { touched[static_cast<size_t>(r)] = true; };
        forEachRead(within, touch);
        forEachWrite(within, touch);
        loops |= within.op == Op::Loop || within.op == Op::Gather;
      });
    if (loops) return;
    const bool whole = i.blocks.empty() && !i.masked && (info(i.op).kernel() || i.op == Op::Copy);
    forEachWrite(i, [&](int32_t r) {
      if (whole && !touched[static_cast<size_t>(r)] && reg(r).length == 0)
        located_[static_cast<size_t>(r)].opens = false;
      touched[static_cast<size_t>(r)] = true;
    });
  }
}

void Program::locate() {
  varying_ = code_.varyingFloats;
  uniform_ = code_.uniformFloats;
  std::vector<std::pair<size_t, float>> constants;
  for (size_t k = 0; k < located_.size(); ++k) {
    const Register& r = code_.registers[k];
    Located& l = located_[k];
    const bool output = r.origin == Origin::Parameter && code_.parameters[static_cast<size_t>(r.index)].output;
    if (!used_[k] && !output) continue;
    const int32_t size = floatsOf(r) * elementsOf(r);
    if (const GlobalInfo* global = r.origin == Origin::Global ? findGlobal(r.name) : nullptr)
      l.global = static_cast<int32_t>(global->global);
    if (l.global >= 0 || r.origin == Origin::Parameter) ofHost_.push_back(static_cast<int32_t>(k));
    if (r.shape == Shape::Text) {
      l.where = Where::Texts;
      l.at = texts_;
      if (r.origin != Origin::Constant) texts_ += elementsOf(r);
    } else if (r.origin == Origin::Constant) {
      l.where = Where::Constant;
      l.at = static_cast<int32_t>(constants_.size());
      for (size_t f = 0; f < static_cast<size_t>(size); ++f)
        constants_.insert(constants_.end(), kBlock, f < r.floats.size() ? r.floats[f] : 0.0f);
    } else {
      const bool inGrid = r.origin == Origin::Global || r.origin == Origin::Parameter;
      l.where = !r.varying ? Where::Uniform : inGrid && !l.assigned && !output ? Where::Given : Where::Varying;
      int32_t& next = r.varying ? varying_ : uniform_;
      l.at = r.slot >= 0 ? r.slot : next;
      if (r.slot < 0) next += size;
      if (r.origin == Origin::Variable || l.partly) cleared_.push_back({r.varying, l.at, l.at + size});
    }
    if (l.where != Where::Texts) numbers_.push_back({static_cast<int32_t>(k), l.at, l.where, r.shape != Shape::Number});
  }
  join(cleared_);
}

PreparedBlock Program::prepared(const Block& block) const {
  PreparedBlock out;
  out.reserve(block.size());
  for (const Instruction& i : block) {
    PreparedInstruction& s = out.emplace_back();
    s.of = &i;
    s.kernel = kernelOf(i.op);
    std::copy_n(i.in.begin(), std::min(std::size(s.in), i.in.size()), s.in);
    if (!i.out.empty() && i.out[0] >= 0) {
      s.out = i.out[0];
      s.uniform = !reg(s.out).varying;
      if (s.kernel && info(i.op).componentwise()) s.components = floatsOf(reg(s.out));
    }
    s.execute = s.kernel ? runnerOf(s) : executeOf(i.op);
    if (i.op == Op::Component && reg(i.in[1]).origin == Origin::Constant) {
      s.component = componentOf(reg(i.in[1]).floats[0]);
      s.execute = componentRunner();
    }
    if (i.op == Op::Scope || i.op == Op::Loop) s.left[0] = left_[static_cast<size_t>(i.extra)];
    if (i.op == Op::Loop) s.left[1] = left_[static_cast<size_t>(i.extra) + 1];
    for (const Block& inner : i.blocks) s.blocks.push_back(prepared(inner));
  }
  return out;
}

}  // namespace tomales::compiler
