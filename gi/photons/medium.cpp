#include "gi/photons/medium.h"

namespace tomales {

Medium mediumOf(const MediumColors& colors, float worldUnit) {
  if (!(worldUnit > 0)) return {};
  return {colors.scattering / worldUnit, (colors.scattering + colors.absorption) / worldUnit};
}

Collision collide(const Medium& medium, const vec3& power, float xi) {
  const float majorant = medium.majorant(power);
  const vec3 scattered = power * medium.scattering / majorant, passed = power * (1.0f - medium.extinction / majorant);
  const float before = maxComponent(power), s = maxComponent(scattered) / before, p = maxComponent(passed) / before;
  // Where colours differ much, the probabilities of both events may add up to more than one.
  const float scale = std::max(1.0f, s + p);
  if (xi < s / scale) return {Collision::Scattered, scattered * (scale / s)};
  if (xi < (s + p) / scale) return {Collision::None, passed * (scale / p)};
  return {Collision::Absorbed, vec3(0.0f)};
}

}  // namespace tomales
