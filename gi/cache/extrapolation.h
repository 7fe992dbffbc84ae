// Private to gi/cache: extrapolates the E/pi of records to other places.
#pragma once
#include "gi/cache/irradiance_record.h"

namespace tomales {

/// Returns the change of E/pi that the gradients predict, for a step from the record's position and a turn, which is
/// the cross product of the record's normal and the new one.
inline vec3 changeBy(const IrradianceExpansion& light, const vec3& step, const vec3& turn) {
  vec3 change;
  for (int c = 0; c < 3; ++c)
    change[c] = dot(turn, light.rotationGradient[c]) + dot(step, light.translationGradient[c]);
  return change;
}

inline vec3 extrapolate(const IrradianceRecord& r, const vec3& x, const vec3& n) {
  return glm::max(vec3(0.0f), r.light.E + changeBy(r.light, x - r.position, cross(r.normal, n)));
}

}  // namespace tomales
