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
  lanes = reinterpret_cast<Lanes*>(memory.floats(registers * sizeof(Lanes) / sizeof(float)));
  texts = memory.openTexts(static_cast<size_t>(p.texts()));
  const auto padding = static_cast<ptrdiff_t>(padded);
  for (const Program::Numbers& n : p.numbers()) {
    Lanes* const to = lanes + n.reg;
    if (n.where == Where::Constant)  // kernels do not write their inputs
      new (to) Lanes{const_cast<float*>(p.constants()) + n.at, 0, n.several ? kBlock : 0};
    else if (n.where == Where::Uniform)
      new (to) Lanes{uniform + static_cast<ptrdiff_t>(n.at) * kBlock, 0, n.several ? kBlock : 0};
    else
      new (to) Lanes{varying + n.at * padding, kBlock, n.several ? padded : 0};
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
