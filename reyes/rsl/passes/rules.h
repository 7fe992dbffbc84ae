// Private to the derivation: how the change of a result follows from the changes of what it is computed from.
#pragma once
#include <functional>

#include "reyes/rsl/code.h"

namespace tomales::compiler {

/// Which of an instruction's operands its result changes with; none: it does not change.
std::vector<size_t> differentiated(const Instruction& i);

struct RuleContext {
  Code& code;
  Block& out;
  const Instruction& i;
  int32_t zero;                            ///< A register of 0.
  Op side;                                 ///< StepU or StepV.
  std::function<int32_t(int32_t)> stepOf;  ///< The register that holds the change of a register; `zero`: none.
};

/// Appends what writes the change of the instruction's result to `to`.
void writeChange(RuleContext& context, int32_t to);

}  // namespace tomales::compiler
