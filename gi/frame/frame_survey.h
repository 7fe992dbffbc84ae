// Private to gi: the facts about a frame that a gather pass needs before its first phase. Space: current.
#pragma once
#include <vector>

#include "reyes/base/stop.h"
#include "reyes/deep.h"

namespace tomales {

struct FrameSurvey {
  Bound3 bound;  ///< Bound of all points.
  /// Sum of the hashes of the pixels that see each group first; it does not depend on buckets.
  std::vector<uint64_t> seenOfGroup;
};

FrameSurvey surveyOf(const DeepFrame& layout, const TileReader& tiles, size_t groups, StopToken stop);

}  // namespace tomales
