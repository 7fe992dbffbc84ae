// Private to gi: the switches of what this renderer adds to the published interpolation of irradiance records. Each
// amendment is a file, which says what it mends and what it costs. tests/bench/amendments.py measures that: it switches
// them off one at a time by the environment variable TOMALES_WITHOUT (names of the table, with commas between).
// docs/measured/irradiance_cache.md has the figures.
#pragma once
#include <array>

#include "gi/error_function.h"

namespace tomales {

/// The names, in the order of Amendment.
inline constexpr std::array kAmendments = {
    "second-order",   // gi/cache/amendments/second_order.h
    "disagreements",  // gi/cache/amendments/disagreements.h
    "reach",          // gi/cache/amendments/reach.h
    "behind",         // gi/cache/amendments/behind.h
    "occluders",      // gi/gather/occluders.h
    "slopes",         // gi/cache/amendments/slopes.h
};

/// Returns false where the bench has switched it off.
bool isOn(Amendment amendment);

/// Tells whether records of this error function have this amendment.
inline bool isOn(Amendment amendment, const ErrorFunctionInfo& info) {
  return isOn(amendment) && !(info.without & bitOf(amendment));
}

}  // namespace tomales
