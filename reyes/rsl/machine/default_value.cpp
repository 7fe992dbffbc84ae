// Runs code whose one result is the value of a parameter.
#include "reyes/rsl/machine/machine.h"
#include "reyes/rsl/machine/run.h"

namespace tomales::compiler {
namespace {

/// Returns the register that holds the parameter; -1 if the code has none.
int32_t registerOf(const Program& program, int32_t parameter) {
  const std::vector<int32_t>& all = program.ofHost();
  const auto it = std::find_if(all.begin(), all.end(), [&](int32_t r) {
    return program.reg(r).origin == Origin::Parameter && program.reg(r).index == parameter;
  });
  return it == all.end() ? -1 : *it;
}

std::vector<float> numbersIn(const Run& run, int32_t r, bool varies) {
  const Register& reg = run.reg(r);
  const Lanes& l = run.lane(r);
  std::vector<float> out;
  for (int32_t k = 0; k < elementsOf(reg) * floatsOf(reg); ++k) {
    const float* const from = l.data + k * static_cast<ptrdiff_t>(run.stride(r));
    if (varies)
      out.insert(out.end(), from, from + run.padded);
    else
      out.push_back(from[l.block == 0 ? 0 : run.firstActive()]);
  }
  return out;
}

}  // namespace

RslValue valueOf(const Program& program, const TmGrid& grid, int32_t parameter) {
  RslValue out;
  Run run(program, grid);
  const int32_t r = registerOf(program, parameter);
  if (!run.whole.any || r < 0) return out;
  open(run);
  execute(run, program.body());
  const Register& reg = run.reg(r);
  for (int32_t e = 0; reg.shape == Shape::Text && e < elementsOf(reg); ++e) out.texts.push_back(run.text(r, e));
  if (reg.shape == Shape::Text) return out;
  out.varies = run.varies(r);
  out.floats = numbersIn(run, r, out.varies);
  return out;
}

}  // namespace tomales::compiler
