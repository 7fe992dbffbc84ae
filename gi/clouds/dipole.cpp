#include "gi/clouds/dipole.h"

#include <algorithm>

namespace tomales {
namespace {

/// Returns the inner reflection at the medium's border: A of the paper, with its rational approximation of Fdr.
float innerReflection(float ior) {
  const float Fdr = -1.440f / (ior * ior) + 0.710f / ior + 0.668f + 0.0636f * ior;
  return (1 + Fdr) / (1 - Fdr);
}

/// Diffuse reflectance of a half-space with this albedo of single scattering (Jensen and Buhler 2002).
float reflectanceOf(float albedo, float A) {
  const float s = std::sqrt(3 * (1 - albedo));
  return 0.5f * albedo * (1 + std::exp(-4.0f / 3.0f * A * s)) * std::exp(-s);
}

/// Returns the inverse of reflectanceOf(), by bisection: reflectance grows with the albedo.
float albedoOf(float reflectance, float A) {
  float low = 0, high = 1;
  for (int step = 0; step < 24; ++step) {
    const float middle = 0.5f * (low + high);
    (reflectanceOf(middle, A) < reflectance ? low : high) = middle;
  }
  return 0.5f * (low + high);
}

}  // namespace

std::optional<Translucency> translucencyOf(std::string_view material) {
  static constexpr struct {
    std::string_view name;
    float scattering[3], absorption[3], ior;
  } kMaterials[] = {
      {"apple", {2.29f, 2.39f, 1.97f}, {0.0030f, 0.0034f, 0.046f}, 1.3f},
      {"chicken1", {0.15f, 0.21f, 0.38f}, {0.015f, 0.077f, 0.19f}, 1.3f},
      {"chicken2", {0.19f, 0.25f, 0.32f}, {0.018f, 0.088f, 0.20f}, 1.3f},
      {"cream", {7.38f, 5.47f, 3.15f}, {0.0002f, 0.0028f, 0.0163f}, 1.3f},
      {"ketchup", {0.18f, 0.07f, 0.03f}, {0.061f, 0.97f, 1.45f}, 1.3f},
      {"marble", {2.19f, 2.62f, 3.00f}, {0.0021f, 0.0041f, 0.0071f}, 1.5f},
      {"potato", {0.68f, 0.70f, 0.55f}, {0.0024f, 0.0090f, 0.12f}, 1.3f},
      {"skimmilk", {0.70f, 1.22f, 1.90f}, {0.0014f, 0.0025f, 0.0142f}, 1.3f},
      {"skin1", {0.74f, 0.88f, 1.01f}, {0.032f, 0.17f, 0.48f}, 1.3f},
      {"skin2", {1.09f, 1.59f, 1.79f}, {0.013f, 0.070f, 0.145f}, 1.3f},
      {"spectralon", {11.6f, 20.4f, 14.9f}, {0.00f, 0.00f, 0.00f}, 1.3f},
      {"wholemilk", {2.55f, 3.21f, 3.77f}, {0.0011f, 0.0024f, 0.014f}, 1.3f},
  };
  for (const auto& m : kMaterials)
    if (m.name == material)
      return Translucency{{m.scattering[0], m.scattering[1], m.scattering[2]},
                          {m.absorption[0], m.absorption[1], m.absorption[2]},
                          m.ior};
  return {};
}

Translucency translucencyOf(const vec3& albedo, const vec3& meanFreePath, float ior) {
  Translucency out{{}, {}, ior};
  for (int k = 0; k < 3; ++k) {
    const float single = albedoOf(albedo[k], innerReflection(ior));
    const float extinction = 1 / (std::max(meanFreePath[k], 1e-6f) * std::sqrt(3 * std::max(1 - single, 1e-6f)));
    out.scattering[k] = single * extinction;
    out.absorption[k] = (1 - single) * extinction;
  }
  return out;
}

Dipole::Dipole(const Translucency& m) {
  const vec3 absorption = glm::max(m.absorption, vec3(0)), scattering = glm::max(m.scattering, vec3(0));
  const vec3 extinction = glm::max(absorption + scattering, vec3(1e-6f));
  albedo_ = scattering / extinction;
  decay_ = glm::sqrt(3.0f * absorption * extinction);
  real_ = 1.0f / extinction;
  virtual_ = real_ * (1 + 4.0f / 3.0f * innerReflection(m.ior));
}

vec3 Dipole::exitance(float distance2) const {
  const auto of = [&](const vec3& height) {
    const vec3 d = glm::sqrt(height * height + distance2);
    return height * (decay_ * d + 1.0f) * glm::exp(-decay_ * d) / (d * d * d);
  };
  return albedo_ / (4 * kPi) * (of(real_) + of(virtual_));
}

// The integral of 2 pi r z (decay d + 1) exp(-decay d) / d^3 over r is 2 pi exp(-decay z).
vec3 Dipole::reflectance() const { return 0.5f * albedo_ * (glm::exp(-decay_ * real_) + glm::exp(-decay_ * virtual_)); }

}  // namespace tomales
