// Values that a shader computes when it runs: defaults of parameters, and a lamp's cone. Others may ask for such a
// value when this shader is not running, or for other points, so the part of the code that computes it can run alone.
#include <algorithm>
#include <set>

#include "reyes/rsl/passes/passes.h"
#include "reyes/rsl/passes/walk.h"

namespace tomales::compiler {
namespace {

/// Calls `visit` for each register that the instruction and those in its blocks write (or read, with `reads`).
template <class Visit>
void forEachWithin(const Instruction& i, bool reads, const Visit& visit) {
  const auto look = [&](const Instruction& inner) {
    if (reads)
      forEachRead(inner, visit);
    else
      forEachWrite(inner, visit);
  };
  look(i);
  for (const Block& inner : i.blocks) forEach(inner, look);
}

/// Drops instructions on which the registers do not depend. (removeUnused() does not drop them: each default tests
/// whether its own parameter is missing.)
void keepFor(Block& body, std::set<int32_t> needed) {
  Block kept;
  for (auto i = body.rbegin(); i != body.rend(); ++i) {
    bool writes = false;
    forEachWithin(*i, false, [&](int32_t r) { writes |= needed.contains(r); });
    if (!writes) continue;
    forEachWithin(*i, true, [&](int32_t r) { needed.insert(r); });
    kept.push_back(std::move(*i));
  }
  std::reverse(kept.begin(), kept.end());
  body = std::move(kept);
}

/// Drops what is written to the shader's globals, its results.
void dropResults(Block& body, const Code& code) {
  std::erase_if(body, [&](Instruction& i) {
    for (Block& inner : i.blocks) dropResults(inner, code);
    return !i.out.empty() && i.blocks.empty() && std::ranges::all_of(i.out, [&](int32_t r) {
      return code.registers[static_cast<size_t>(r)].origin == Origin::Global;
    });
  });
}

/// Puts what the branches of conditions do in the place of these conditions.
void takeAllBranches(Block& body) {
  Block out;
  for (Instruction& i : body) {
    for (Block& inner : i.blocks) takeAllBranches(inner);
    if (i.op != Op::If) {
      out.push_back(std::move(i));
      continue;
    }
    for (Block& inner : i.blocks) std::ranges::move(inner, std::back_inserter(out));
  }
  body = std::move(out);
}

}  // namespace

Code defaultOf(const Code& lowered, size_t parameter) {
  Code out = lowered;
  out.body.erase(out.body.begin() + static_cast<ptrdiff_t>(lowered.defaults), out.body.end());
  for (Parameter& p : out.parameters) p.output = false;  // nobody takes them
  out.parameters[parameter].told = true;
  std::set<int32_t> wanted;
  for (size_t r = 0; r < out.registers.size(); ++r)
    if (out.registers[r].origin == Origin::Parameter && out.registers[r].index == static_cast<int32_t>(parameter))
      wanted.insert(static_cast<int32_t>(r));
  keepFor(out.body, wanted);
  return out;
}

Code coneOf(const Code& lowered, bool ofAllBranches) {
  Code out = lowered;
  for (Parameter& p : out.parameters) p.output = false;  // nobody takes them
  Register& cone = out.registers[static_cast<size_t>(out.cone)];
  cone.origin = Origin::Parameter;
  cone.index = static_cast<int32_t>(out.parameters.size());
  Parameter& value = out.parameters.emplace_back();
  value.type = {Base::Float};
  value.told = true;
  dropResults(out.body, out);
  if (ofAllBranches) takeAllBranches(out.body);
  keepFor(out.body, {out.cone});
  return out;
}

}  // namespace tomales::compiler
