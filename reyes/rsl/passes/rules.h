// Private to deriveSteps(): computes the change of a result from the changes of its operands.
#pragma once
#include <functional>

#include "reyes/rsl/code.h"

namespace tomales::compiler {

/// Returns the operands that an instruction's result changes with; empty if it never changes. (differentiated.cpp)
std::vector<size_t> differentiated(const Instruction& i);

struct RuleContext {
  Code& code;
  Block& out;
  const Instruction& i;
  int32_t zero;                            ///< A register of 0.
  Op side;                                 ///< StepU or StepV.
  std::function<int32_t(int32_t)> stepOf;  ///< Returns the register that holds the change of a register, or `zero`.
};

/// Appends instructions that write the change of the instruction's result to `to`.
void writeChange(RuleContext& context, int32_t to);

}  // namespace tomales::compiler
