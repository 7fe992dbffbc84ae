// The fourth stage: a checked shader becomes code over registers (code.h). Functions are inlined, `illuminate` and
// `solar` become conditions, and a parameter whose default is not constant gets it when the shader runs.
#pragma once
#include "reyes/rsl/check.h"
#include "reyes/rsl/code.h"

namespace tomales::compiler {

/// check() must have found no errors. Errors that only show here go to `messages`, for instance a variable that this
/// kind of shader does not have. P and N of a light are the origin and the z axis of its space; with `onGeometry` they
/// are a point of the geometry of AreaLightSource and its normal, which the host gives.
Code lower(const Checked& checked, const Shader& shader, Messages& messages, bool onGeometry = false);

/// The greatest number of instructions of one shader, functions inlined; more is an error.
constexpr int kMostInstructions = 200'000;

}  // namespace tomales::compiler
