// What does each instruction: a table from Op to function, of one row list for each family.
#pragma once
#include <span>

#include "reyes/rsl/machine/frame.h"

namespace tomales::compiler {

/// Of what no kernel does; never null then.
Execute executeOf(Op op);
/// Calls the kernel of a step.
Execute runnerOf(const Step& s);

/// Op::Component where it is known which.
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

}  // namespace tomales::compiler
