// The function that runs each instruction. Each family of instructions has a list of rows.
#pragma once
#include <span>

#include "reyes/rsl/machine/run.h"

namespace tomales::compiler {

/// Returns the function for an instruction that has no kernel. Never null for those.
Execute executeOf(Op op);
/// Returns the function that calls the kernel of an instruction.
Execute runnerOf(const PreparedInstruction& s);

/// Runs Op::Component where the component is constant.
Execute componentRunner();

struct Row {
  Op op;
  Execute execute;
};
std::span<const Row> controlRows();
std::span<const Row> copyRows();
std::span<const Row> valueRows();
std::span<const Row> textRows();
std::span<const Row> surfaceRows();
std::span<const Row> lightRows();
std::span<const Row> rayRows();
std::span<const Row> pictureRows();
std::span<const Row> cloudRows();
std::span<const Row> messageRows();
std::span<const Row> pluginRows();

}  // namespace tomales::compiler
