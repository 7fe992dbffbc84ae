// Private to gi/irradiance_cache: when points are shaded, records serve farther than they did when records were placed,
// where light is even. More records then overlap at each point, and their noise and their seams are averaged: light
// along grazing views has a tenth less error. It costs a fiftieth of the time of a gathered picture and no record. The
// radius does not grow where light is steep, because a shadow's edge may lie beyond (docs/decisions/0103).
#pragma once
#include "gi/cache/irradiance_record.h"

namespace tomales {

/// Factor on a record's radius: `wider` where light does not change over the radius, and 1 where it changes by kSteep
/// of itself.
inline float reachFactor(const IrradianceRecord& r, float radius, float wider) {
  constexpr float kSteep = 0.3f;  // more lets the dark side of edges get light
  const vec3 change = radius * (r.translationGradient[0] + r.translationGradient[1] + r.translationGradient[2]);
  const float most = kSteep * (r.E.x + r.E.y + r.E.z);
  const float even = dot(change, change) < most * most ? 1 - dot(change, change) / (most * most) : 0.0f;
  return 1 + (wider - 1) * even;
}

}  // namespace tomales
