// The mark that a shader declares in place of a default that it computes itself when it runs: `float b = 2 * a` of RSL.
// A scene cannot give the mark, so a parameter that still has it was not given. It stays in place when a value goes to
// another space.
#pragma once
#include <limits>

namespace tomales {

inline constexpr float kComputedNumber = std::numeric_limits<float>::quiet_NaN();
inline constexpr const char* kComputedText =
    "\x1b"
    "computed";

}  // namespace tomales
