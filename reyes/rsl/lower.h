// The fourth stage: a checked shader becomes straight code over registers (code.h). Functions are inlined, `illuminate`
// and `solar` become conditions, parameters whose default is no constant get it when the shader runs.
#pragma once
#include "reyes/rsl/check.h"
#include "reyes/rsl/code.h"

namespace tomales::compiler {

/// Pre: check() found no errors. Errors that only show here (a variable that this kind of shader does not have) go to
/// `messages`.
Code lower(const Checked& checked, const Shader& shader, Messages& messages);

/// Instructions that one shader may become, functions inlined; more is an error.
constexpr int kMostInstructions = 200'000;

}  // namespace tomales::compiler
