#include "gi/photons/medium.h"

namespace tomales {
namespace {

vec3 colorOf(const ShaderCall& shader, const char* name) {
  const Param* p = findParam(shader.params, name);
  if (!p || p->floats.empty()) return vec3(0.0f);
  const vec3 c = p->floats.size() < 3 ? vec3(p->floats[0]) : vec3(p->floats[0], p->floats[1], p->floats[2]);
  return isFinite(c) ? glm::max(c, vec3(0.0f)) : vec3(0.0f);
}

}  // namespace

Medium mediumOf(const ShaderCall* volume, float worldUnit) {
  if (!volume || !(worldUnit > 0)) return {};
  const vec3 scattering = colorOf(*volume, "scattering"), absorption = colorOf(*volume, "absorption");
  return {scattering / worldUnit, (scattering + absorption) / worldUnit};
}

Collision collide(const Medium& medium, const vec3& power, float xi) {
  const float majorant = medium.majorant(power);
  const vec3 scattered = power * medium.scattering / majorant, passed = power * (1.0f - medium.extinction / majorant);
  const float before = maxComponent(power), s = maxComponent(scattered) / before, p = maxComponent(passed) / before;
  const float scale =
      // where colours differ much, the probabilities of the most likely events may add up to more than one
      std::max(1.0f, s + p);
  if (xi < s / scale) return {Collision::Scattered, scattered * (scale / s)};
  if (xi < (s + p) / scale) return {Collision::None, passed * (scale / p)};
  return {Collision::Absorbed, vec3(0.0f)};
}

}  // namespace tomales
