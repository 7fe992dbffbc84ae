// The mark that a shader declares in place of a default that it computes itself when it runs: `float b = 2 * a` of RSL.
// A scene cannot give the mark, so a parameter that still has it was not given. It stays in place when a value goes to
// another space.
#pragma once
#include <cmath>
#include <limits>
#include <string_view>

#include "reyes/shader_api.h"

namespace tomales {

inline constexpr float kComputedNumber = std::numeric_limits<float>::quiet_NaN();
inline constexpr const char* kComputedText =
    "\x1b"
    "computed";

/// Tells whether the shader computes the default of this parameter.
inline bool hasComputedDefault(const TmParamDecl& declared) {
  if (TM_TYPE_OF(declared.type) == TM_STRING)
    return declared.strings && declared.strings[0] && std::string_view(declared.strings[0]) == kComputedText;
  return declared.floats && std::isnan(declared.floats[0]);
}

}  // namespace tomales
