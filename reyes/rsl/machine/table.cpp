#include "reyes/rsl/machine/table.h"

#include <array>

#include "reyes/base/check.h"

namespace tomales::compiler {
namespace {

/// A kernel that takes whole registers.
void runKernel(Run& run, const Step& s) {
  constexpr size_t kMostInputs = 16;
  const std::vector<int32_t>& from = s.of->in;
  Lanes in[kMostInputs];
  for (size_t k = 0; k < from.size(); ++k) in[k] = run.lanes[from[k]];
  s.kernel(s.uniform ? 1 : run.blocks, run.lanes[s.of->out[0]], in);
}

/// One that does a component at a time. Numbers count for all components.
void runByComponent(Run& run, const Step& s) {
  constexpr size_t kMostInputs = 4;
  const std::vector<int32_t>& from = s.of->in;
  Lanes in[kMostInputs], out = run.lanes[s.of->out[0]];
  for (size_t k = 0; k < from.size(); ++k) in[k] = run.lanes[from[k]];
  const int blocks = s.uniform ? 1 : run.blocks;
  for (int32_t c = 0; c < s.components; ++c) {
    s.kernel(blocks, out, in);
    out.data += out.component;
    for (size_t k = 0; k < from.size(); ++k) in[k].data += in[k].component;
  }
}

std::array<Execute, kOps> made() {
  std::array<Execute, kOps> table{};
  for (int k = 0; k < kOps; ++k) {
    const OpInfo& op = info(static_cast<Op>(k));
    if (op.kernel()) table[static_cast<size_t>(k)] = op.componentwise() ? runByComponent : runKernel;
  }
  for (const auto rows : {controlRows(), copyRows(), valueRows(), textRows(), surfaceRows(), lightRows(), rayRows(),
                          pictureRows(), cloudRows(), messageRows()})
    for (const Row& row : rows) table[static_cast<size_t>(row.op)] = row.execute;
  for (int k = 0; k < kOps; ++k)
    if (!table[static_cast<size_t>(k)])
      checkFailed(__FILE__, __LINE__, "every instruction has a function", info(static_cast<Op>(k)).name, k);
  return table;
}

}  // namespace

Execute executeOf(Op op) {
  static const std::array<Execute, kOps> table = made();
  return table[static_cast<size_t>(op)];
}

}  // namespace tomales::compiler
