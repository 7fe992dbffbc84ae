// Surfaces that assign P. RISpec lets only displacements move points, but renderers that shade before they hide let
// surfaces do it too, and shaders of that time rely on it. So the shader becomes two: a displacement, whose colours are
// dropped, and a surface whose points the displacement has moved.
#include <algorithm>

#include "reyes/rsl/globals.h"
#include "reyes/rsl/passes/passes.h"
#include "reyes/rsl/passes/walk.h"

namespace tomales::compiler {
namespace {

bool isP(const Register& r) { return r.origin == Origin::Global && r.index == static_cast<int32_t>(Global::P); }

/// Tells whether the instruction prints or bakes. Only the surface does so, because once is enough.
bool speaks(const Instruction& i) { return i.op == Op::Print || i.op == Op::Report || i.op == Op::Bake3d; }

void silence(Block& block) {
  std::erase_if(block, speaks);
  for (Instruction& i : block)
    for (Block& inner : i.blocks) silence(inner);
}

}  // namespace

bool movesPoints(const Code& lowered) {
  if (lowered.kind != ShaderKind::Surface) return false;
  bool moves = false;
  forEach(lowered.body, [&](const Instruction& i) {
    forEachWrite(i, [&](int32_t r) { moves |= isP(lowered.registers[static_cast<size_t>(r)]); });
  });
  return moves;
}

Code displacementOf(const Code& lowered) {
  Code out = lowered;
  out.kind = ShaderKind::Displacement;
  for (Parameter& p : out.parameters) p.output = false;  // the surface writes them
  const auto end = out.body.begin() + static_cast<ptrdiff_t>(out.defaults);
  out.defaults -= static_cast<size_t>(std::count_if(out.body.begin(), end, speaks));
  silence(out.body);
  return out;
}

void leavePoints(Code& lowered) {
  const auto P = std::find_if(lowered.registers.begin(), lowered.registers.end(), isP);
  const auto moved = static_cast<int32_t>(P - lowered.registers.begin());
  const auto unseen = static_cast<int32_t>(lowered.registers.size());
  lowered.registers.push_back({.shape = Shape::Triple, .origin = Origin::Variable, .name = "moved P"});
  forEach(lowered.body, [&](Instruction& i) {
    std::replace(i.out.begin(), i.out.end(), moved, unseen);
    for (Setting& s : i.settings)
      if (s.fills && s.value == moved) s.value = unseen;
  });
}

}  // namespace tomales::compiler
