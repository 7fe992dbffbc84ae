// Many patches measured at once. Private to splitting.
#pragma once
#include "reyes/split.h"

namespace tomales {

/// measure() of each of some patches as a whole.
std::vector<PatchSize> measureWhole(const Object& object, const Camera& camera, std::span<const uint32_t> patches);

}  // namespace tomales
