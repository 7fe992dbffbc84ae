#include "reyes/rsl/machine/run.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "reyes/rsl/machine/machine.h"
#include "reyes/rsl/machine/masks.h"

namespace tomales::compiler {

Run::Run(const Program& p, const TmGrid& g)
    : program(p),
      given(g),
      grid(g),
      count(g.count),
      padded(g.padded),
      blocks(g.padded / kBlock),
      memory(Memory::ofThread()) {
  const size_t registers = p.code().registers.size(), points = static_cast<size_t>(padded);
  const size_t varyingSize = static_cast<size_t>(p.varyingFloats()) * points,
               uniformSize = static_cast<size_t>(p.uniformFloats()) * kBlock;
  float* const varying = memory.floats(varyingSize);
  float* const uniform = memory.floats(uniformSize);
  for (const Program::Cleared& c : p.cleared()) {
    const size_t one = c.varying ? points : kBlock;
    std::fill((c.varying ? varying : uniform) + static_cast<size_t>(c.from) * one,
              (c.varying ? varying : uniform) + static_cast<size_t>(c.to) * one, 0.0f);
  }
  lanes = new (memory.floats(registers * sizeof(Lanes) / sizeof(float))) Lanes[registers];
  texts = memory.openTexts(static_cast<size_t>(p.texts()));
  for (size_t k = 0; k < registers; ++k) {
    const Located& l = p.located(static_cast<int32_t>(k));
    const bool several = p.code().registers[k].shape != Shape::Number;
    switch (l.where) {
      case Where::Constant:  // kernels do not write their inputs
        lanes[k] = {const_cast<float*>(p.constants()) + l.at, 0, several ? kBlock : 0};
        break;
      case Where::Uniform:
        lanes[k] = {uniform + static_cast<ptrdiff_t>(l.at) * kBlock, 0, several ? kBlock : 0};
        break;
      case Where::Varying:
      case Where::Given:
        lanes[k] = {varying + static_cast<ptrdiff_t>(l.at) * padded, kBlock, several ? padded : 0};
        break;
      default:
        break;
    }
  }
  whole.on = memory.bytes(points);
  whole.any = begin(padded, count, g.active, whole.on);
  // Points become inactive only through inner masks, or all at once.
  everywhere = count == padded && std::memchr(whole.on, 0, points) == nullptr;
}

const std::string& Run::text(int32_t r, int32_t element) const {
  static const std::string none;
  const Register& one = reg(r);
  if (one.origin != Origin::Constant) return memory.text(texts + static_cast<size_t>(program.located(r).at + element));
  return static_cast<size_t>(element) < one.texts.size() ? one.texts[static_cast<size_t>(element)] : none;
}

int32_t Run::firstActive() const {
  int32_t i = 0;
  while (i + 1 < count && !mask->on[i]) ++i;
  return i;
}

void Run::warn(const std::string& message) { grid.call->report(grid.host, asking(), TM_WARNING, message.c_str()); }
void Run::missing(const std::string& message) { grid.call->report(grid.host, asking(), TM_MISSING, message.c_str()); }

void run(const Program& program, const TmGrid& grid) {
  Run run(program, grid);
  if (!run.whole.any) return;
  open(run);
  execute(run, program.body());
  store(run);
}

}  // namespace tomales::compiler
