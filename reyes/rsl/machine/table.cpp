#include "reyes/rsl/machine/table.h"

#include <array>

#include "reyes/base/check.h"

namespace tomales::compiler {
namespace {

/// Runs a kernel that takes `inputs` whole registers.
template <size_t inputs>
void runKernel(Run& run, const PreparedInstruction& s) {
  Lanes in[inputs];
  for (size_t k = 0; k < inputs; ++k) in[k] = run.lanes[s.in[k]];
  s.kernel(s.uniform ? 1 : run.blocks, run.lanes[s.out], in);
}

/// Does the same for a kernel with more inputs than a PreparedInstruction holds.
void runLongKernel(Run& run, const PreparedInstruction& s) {
  constexpr size_t kMostInputs = 16;
  const std::vector<int32_t>& from = s.of->in;
  Lanes in[kMostInputs];
  for (size_t k = 0; k < std::min(kMostInputs, from.size()); ++k) in[k] = run.lanes[from[k]];
  s.kernel(s.uniform ? 1 : run.blocks, run.lanes[s.out], in);
}

/// Runs a kernel once for each component. Numbers count for all components.
template <size_t inputs>
void runByComponent(Run& run, const PreparedInstruction& s) {
  Lanes in[inputs], out = run.lanes[s.out];
  for (size_t k = 0; k < inputs; ++k) in[k] = run.lanes[s.in[k]];
  const int blocks = s.uniform ? 1 : run.blocks;
  for (int32_t c = 0; c < s.components; ++c) {
    s.kernel(blocks, out, in);
    out.data += out.component;
    for (size_t k = 0; k < inputs; ++k) in[k].data += in[k].component;
  }
}

std::array<Execute, kOps> made() {
  std::array<Execute, kOps> table{};
  for (const auto rows : {controlRows(), copyRows(), valueRows(), textRows(), surfaceRows(), lightRows(), rayRows(),
                          pictureRows(), cloudRows(), messageRows(), pluginRows()})
    for (const Row& row : rows) table[static_cast<size_t>(row.op)] = row.execute;
  for (int k = 0; k < kOps; ++k)
    if (!table[static_cast<size_t>(k)] && !info(static_cast<Op>(k)).kernel())
      checkFailed(__FILE__, __LINE__, "every instruction has a function", info(static_cast<Op>(k)).name, k);
  return table;
}

}  // namespace

Execute runnerOf(const PreparedInstruction& s) {
  static constexpr Execute kWhole[] = {runKernel<1>, runKernel<2>, runKernel<3>, runKernel<4>},
                           kByComponent[] = {runByComponent<1>, runByComponent<2>, runByComponent<3>,
                                             runByComponent<4>};
  const size_t inputs = s.of->in.size();
  if (inputs > std::size(kWhole)) return runLongKernel;
  return s.components == 1 ? kWhole[inputs - 1] : kByComponent[inputs - 1];
}

Execute executeOf(Op op) {
  static const std::array<Execute, kOps> table = made();
  return table[static_cast<size_t>(op)];
}

}  // namespace tomales::compiler
