// The reflection of a principled surface at one point, after Burley 2012, "Physically-based shading at Disney"
// (sections 5.3 to 5.6), without anisotropy and subsurface.
#pragma once
#include "reyes/shader/ggx.h"

namespace burley {

using rsl::Color;
using rsl::Vec3;

inline float luminance(Color c) { return rsl::dot(c, {0.2126f, 0.7152f, 0.0722f}); }
inline float fresnelWeight(float cosine) {
  const float m = rsl::clamp(1 - cosine, 0, 1);
  return m * m * m * m * m;
}
/// Returns the coat's distribution: generalised Trowbridge-Reitz with gamma 1 (GTR1). With gamma 2 it would be GGX.
inline float gtr1(float nh, float alpha) {
  if (alpha >= 1) return 1 / rsl::kPi;
  const float a2 = alpha * alpha, t = 1 + (a2 - 1) * nh * nh;
  return (a2 - 1) / (rsl::kPi * std::log(a2) * t);
}
/// Burley masks the coat as if it were of this width.
inline const rsl::Ggx kMaskOfCoat(0.25f);

/// The parameters at a point, by the paper's names; `base` is the base colour.
struct Inputs {
  Color base;
  float metallic, specular, speculartint, roughness, sheen, sheentint, clearcoat, clearcoatgloss;
};

/// The material that they make.
struct Material {
  Color base, specular0, sheen;
  float roughness, coat, coatAlpha, matte;
  rsl::Ggx facets;

  explicit Material(const Inputs& in)
      : base(in.base), roughness(rsl::clamp(in.roughness, 0, 1)), facets(std::max(1e-3f, roughness * roughness)) {
    const float bright = luminance(base), metal = rsl::clamp(in.metallic, 0, 1);
    const Color tint = bright > 0 ? base / bright : Color{1, 1, 1}, white{1, 1, 1};
    specular0 = rsl::mix(0.08f * in.specular * rsl::mix(white, tint, in.speculartint), base, metal);
    sheen = in.sheen * rsl::mix(white, tint, in.sheentint);
    coat = 0.25f * in.clearcoat;
    coatAlpha = rsl::mix(0.1f, 0.001f, in.clearcoatgloss);
    matte = 1 - metal;
  }
  /// diffuse() and glossy() are BRDFs times pi, for light that is E/pi. diffuse() includes the sheen.
  Color diffuse(float nl, float nv, float lh) const {
    const float grazing = 0.5f + 2 * lh * lh * roughness;
    const float retro = rsl::mix(1, grazing, fresnelWeight(nl)) * rsl::mix(1, grazing, fresnelWeight(nv));
    return matte * (retro * base + rsl::kPi * fresnelWeight(lh) * sheen);
  }
  Color glossy(float nl, float nv, float nh, float lh) const {
    const float F = fresnelWeight(lh);
    const Color lobe = facets.reflection(nl, nv, nh) * rsl::mix(specular0, Color{1, 1, 1}, F);
    const float coatLobe = coat * gtr1(nh, coatAlpha) * rsl::mix(0.04f, 1, F) * kMaskOfCoat.maskingOverTwiceCosine(nl) *
                           kMaskOfCoat.maskingOverTwiceCosine(nv);
    return rsl::kPi * (lobe + Color{coatLobe, coatLobe, coatLobe});
  }
};

/// Returns V, or a direction just above the surface if V lies below it, as where a normal map has turned N.
inline Vec3 aboveSurface(Vec3 N, Vec3 V) {
  constexpr float kLeast = 1e-4f;
  const float nv = rsl::dot(N, V);
  return nv >= kLeast ? V : rsl::normalize(V + (kLeast - nv) * N);
}

/// The two lobes of one point, from which directions are drawn. The half vector H of the base is drawn by what the
/// viewer sees of its facets (visible normals), that of the coat by its distribution times N.H.
struct Lobes {
  Vec3 N, V;
  Material material;
  float nv, coatShare;  ///< coatShare is the share of the directions that are drawn from the coat.

  Lobes(Vec3 n, Vec3 v, const Material& m)
      : N(n), V(aboveSurface(n, v)), material(m), nv(std::max(1e-4f, rsl::dot(n, V))) {
    const float F = fresnelWeight(nv), coat = m.coat * rsl::mix(0.04f, 1, F),
                base = luminance(rsl::mix(m.specular0, Color{1, 1, 1}, F));
    coatShare = coat > 0 ? coat / (coat + base) : 0;
  }
  /// Returns roughly the share of the lobes in what the viewer sees in even light. The matte part counts as white,
  /// because highlights on dark paint have dark noise.
  float shareOfLobes() const {
    const float F = fresnelWeight(nv), glossy = luminance(rsl::mix(material.specular0, Color{1, 1, 1}, F)) +
                                                material.coat * rsl::mix(0.04f, 1, F);
    const float all = glossy + material.matte;
    return all > 0 ? std::min(1.0f, std::max(0.0f, glossy / all)) : 0;  // NaN becomes 0
  }
  /// BRDF times cosine times pi, for light that is E/pi; 0 below the surface.
  Color value(Vec3 L) const {
    const float nl = rsl::dot(N, L);
    if (nl <= 0) return {};
    const Vec3 H = rsl::normalize(L + V);
    return nl * material.glossy(nl, nv, rsl::dot(N, H), rsl::dot(L, H));
  }
  /// Returns the probability density of draw() over solid angle.
  float pdf(Vec3 L) const {
    const Vec3 H = rsl::normalize(L + V);
    const float nh = rsl::dot(N, H), vh = rsl::dot(V, H);
    if (nh <= 0 || vh <= 0 || rsl::dot(N, L) <= 0) return 0;
    const float ofBase = material.facets.reflectedDensity(nv, nh);
    return coatShare > 0 ? rsl::mix(ofBase, gtr1(nh, material.coatAlpha) * nh / (4 * vh), coatShare) : ofBase;
  }
  Vec3 draw(float xi0, float xi1) const {
    const Vec3 H = xi0 < coatShare ? normalOfCoat(xi0 / coatShare, xi1)
                                   : material.facets.visibleNormal(N, V, (xi0 - coatShare) / (1 - coatShare), xi1);
    return 2 * rsl::dot(V, H) * H - V;
  }

 private:
  Vec3 normalOfCoat(float xi0, float xi1) const {
    const float a2 = material.coatAlpha * material.coatAlpha, c2 = (1 - std::pow(a2, 1 - xi0)) / (1 - a2),
                c = std::sqrt(rsl::clamp(c2, 0, 1)), s = std::sqrt(1 - c * c), angle = 2 * rsl::kPi * xi1;
    Vec3 tangent, bitangent;
    rsl::orthonormalBasis(N, tangent, bitangent);
    return (s * std::cos(angle)) * tangent + (s * std::sin(angle)) * bitangent + c * N;
  }
};

}  // namespace burley
