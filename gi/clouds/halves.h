// Private to gi/clouds: halves a range of things that have positions, to build a tree of them.
#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

/// Orders the things from begin to end, in a box of this size, so that those before the returned place lie to one side
/// of those after it, along the widest axis. Returns nothing if they are so few that they stay together.
template <class Thing>
std::optional<uint32_t> halve(std::vector<Thing>& things, uint32_t begin, uint32_t end, const vec3& size) {
  constexpr uint32_t kTogether = 8;
  if (end - begin <= kTogether) return std::nullopt;
  const int axis = longestAxis(size);
  const uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(things.begin() + begin, things.begin() + middle, things.begin() + end,
                   [axis](const Thing& a, const Thing& b) { return a.P[axis] < b.P[axis]; });
  return middle;
}

}  // namespace tomales
