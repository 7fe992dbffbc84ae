// Microfacets of the GGX distribution (Trowbridge and Reitz 1975; Walter et al. 2007, "Microfacet Models for Refraction
// through Rough Surfaces") under Smith's masking, and sampling of those that a viewer sees (Heitz 2018, "Sampling the
// GGX Distribution of Visible Normals"). Plugins include this beside reyes/shader.h; `disney` is made of it.
//
// Spaces: all directions have unit length and point away from the surface, in any one space. N is the surface's normal,
// V leads to the viewer, L to the light, and H is a facet's normal. NV, NL, NH and VH are their cosines.
//
// Width: alpha > 0 is the median slope of the facets. `disney` uses roughness^2.
//
// Units: distributions and densities are 1/sr. reflection() is 1/sr too: it is a BRDF but for the Fresnel term. Light
// of this renderer's lights is E/pi, so that a sample of a light adds Cl * pi * NL * F * reflection().
//
// Norms: the integral over the hemisphere of distribution(NH) NH is 1, as is that of visibleDensity() over H. A surface
// that faces a furnace sends back the integral of reflection() NL, at most 1: light that meets facets twice is left
// out.
//
// Threads: plain values. No function looks at a batch.
#pragma once
#include "reyes/shader/shadeops.h"

namespace rsl {

class Ggx {
 public:
  explicit Ggx(float alpha) : alpha_(alpha), alpha2_(alpha * alpha) {}

  float alpha() const { return alpha_; }

  /// Returns the area of facets towards H, per area of the surface and solid angle (Walter et al., eq. 33).
  float distribution(float NH) const {
    const float t = 1 + (alpha2_ - 1) * NH * NH;
    return alpha2_ / (kPi * t * t);
  }
  /// Returns the share of the facets towards a viewer that others do not hide from it, 0..1 (Walter et al., eq. 34). NV
  /// >= 0.
  float masking(float NV) const { return 2 * NV * maskingOverTwiceCosine(NV); }
  /// Returns masking(NV) / (2 NV), which is finite where NV is 0.
  float maskingOverTwiceCosine(float NV) const { return 1 / (NV + std::sqrt(alpha2_ + (1 - alpha2_) * NV * NV)); }
  /// Returns D G / (4 NL NV), 1/sr, with masking from both sides independent of each other. NL, NV >= 0. NL and NV may
  /// be exchanged.
  float reflection(float NL, float NV, float NH) const {
    return distribution(NH) * (maskingOverTwiceCosine(NL) * maskingOverTwiceCosine(NV));
  }

  /// Returns the density over solid angle of the facets' normals that a viewer sees: G1(V) VH D(H) / NV (Heitz 2018,
  /// eq. 3). NV > 0.
  float visibleDensity(float NV, float NH, float VH) const {
    return NH > 0 && VH > 0 ? 2 * maskingOverTwiceCosine(NV) * VH * distribution(NH) : 0;
  }
  /// Returns the density over solid angle of L = reflect(-V, H), where H is drawn by visibleNormal() (Walter et al.,
  /// eq. 14). NV > 0.
  float reflectedDensity(float NV, float NH) const {
    return NH > 0 ? 0.5f * maskingOverTwiceCosine(NV) * distribution(NH) : 0;
  }
  /// Draws H by visibleDensity(); xi0, xi1 in [0, 1) (Heitz 2018, appendix A). N.V > 0.
  Vec3 visibleNormal(Vec3 N, Vec3 V, float xi0, float xi1) const {
    Vec3 tangent, bitangent;
    orthonormalBasis(N, tangent, bitangent);
    // Stretched, so that the facets are those of a hemisphere.
    const Vec3 view = normalize(Vec3{alpha_ * dot(V, tangent), alpha_ * dot(V, bitangent), dot(V, N)});
    const float flat2 = view.x * view.x + view.y * view.y;
    const Vec3 across = flat2 > 0 ? Vec3{-view.y, view.x, 0} / std::sqrt(flat2) : Vec3{1, 0, 0},
               up = cross(view, across);
    // A point of the hemisphere's outline as the viewer sees it: a half disk, and half an ellipse below.
    const float r = std::sqrt(xi0), phi = 2 * kPi * xi1, s = 0.5f * (1 + view.z), x = r * std::cos(phi);
    const float y = mix(std::sqrt(std::max(0.0f, 1 - x * x)), r * std::sin(phi), s);
    const Vec3 h = x * across + y * up + std::sqrt(std::max(0.0f, 1 - x * x - y * y)) * view;
    return normalize(alpha_ * h.x * tangent + alpha_ * h.y * bitangent + std::max(1e-6f, h.z) * N);
  }

 private:
  float alpha_, alpha2_;
};

}  // namespace rsl
