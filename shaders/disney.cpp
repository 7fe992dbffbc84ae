// A principled surface after Burley 2012, "Physically-based shading at Disney" (sections 5.3 to 5.6), without anisotropy and subsurface.
#include "reyes/shadeops.h"

namespace {

using rsl::Color;
using rsl::Vec3;

rsl::FloatParam metallic("metallic", 0, "0: dielectric, 1: metal"), specular("specular", 0.5f, "reflection at normal incidence; 0.5: index 1.5");
rsl::FloatParam speculartint("speculartint", 0, "tint of that towards the base colour"), roughness("roughness", 0.5f, "of both lobes");
rsl::FloatParam sheen("sheen", 0, "grazing reflection of cloth"), sheentint("sheentint", 0.5f, "its tint");
rsl::FloatParam clearcoat("clearcoat", 0, "a second lobe"), clearcoatgloss("clearcoatgloss", 1, "1: glossy, 0: satin");
rsl::FloatParam reflections("reflections", 0, "rays that mirror the scene, a point; 0: lights alone are mirrored");
rsl::ColorParam emission("emission", {0, 0, 0}, "radiance that it adds");
rsl::StringParam texturename("texturename", "", "picture that multiplies Cs, the base colour");
rsl::ColorOutput diffusePart("diffuse", "share of diffuse light and sheen"), specularPart("specular", "share of highlights"),
    reflectionPart("reflection", "share of the mirrored scene"), albedo("albedo", "base colour");

float luminance(Color c) { return rsl::dot(c, {0.2126f, 0.7152f, 0.0722f}); }
float fresnelWeight(float cosine) {
  const float m = rsl::clamp(1 - cosine, 0, 1);
  return m * m * m * m * m;
}
/// Generalised Trowbridge-Reitz, gamma 2 and 1.
float gtr2(float nh, float alpha) {
  const float a2 = alpha * alpha, t = 1 + (a2 - 1) * nh * nh;
  return a2 / (rsl::kPi * t * t);
}
float gtr1(float nh, float alpha) {
  if (alpha >= 1) return 1 / rsl::kPi;
  const float a2 = alpha * alpha, t = 1 + (a2 - 1) * nh * nh;
  return (a2 - 1) / (rsl::kPi * std::log(a2) * t);
}
float smithGgx(float nv, float alpha) {
  const float a = alpha * alpha, b = nv * nv;
  return 1 / (nv + std::sqrt(a + b - a * b));
}

/// What the parameters make of one point.
struct Material {
  Color base, specular0, sheen;
  float roughness, alpha, coat, coatAlpha, matte;

  Material(const TmGrid* g, int i, Color paint) : base(rsl::get(g->Cs, i) * paint), roughness(rsl::clamp(::roughness(g, i), 0, 1)) {
    const float bright = luminance(base), metal = rsl::clamp(metallic(g, i), 0, 1);
    const Color tint = bright > 0 ? base / bright : Color{1, 1, 1}, white{1, 1, 1};
    specular0 = rsl::mix(0.08f * ::specular(g, i) * rsl::mix(white, tint, speculartint(g, i)), base, metal);
    sheen = ::sheen(g, i) * rsl::mix(white, tint, sheentint(g, i));
    alpha = std::max(1e-3f, roughness * roughness);
    coat = 0.25f * clearcoat(g, i), coatAlpha = rsl::mix(0.1f, 0.001f, clearcoatgloss(g, i));
    matte = 1 - metal;
  }
  /// Both times pi, for light that is E/pi.
  Color diffuse(float nl, float nv, float lh) const {
    const float grazing = 0.5f + 2 * lh * lh * roughness;
    const float retro = rsl::mix(1, grazing, fresnelWeight(nl)) * rsl::mix(1, grazing, fresnelWeight(nv));
    return matte * (retro * base + rsl::kPi * fresnelWeight(lh) * sheen);
  }
  Color glossy(float nl, float nv, float nh, float lh) const {
    const float F = fresnelWeight(lh), G = smithGgx(nl, alpha) * smithGgx(nv, alpha);
    const Color lobe = gtr2(nh, alpha) * G * rsl::mix(specular0, Color{1, 1, 1}, F);
    const float coatLobe = coat * gtr1(nh, coatAlpha) * rsl::mix(0.04f, 1, F) * smithGgx(nl, 0.25f) * smithGgx(nv, 0.25f);
    return rsl::kPi * (lobe + Color{coatLobe, coatLobe, coatLobe});
  }
};

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  const rsl::Vec3Array N = b.facingNormals(), V = b.towardsViewer(), ambient = b.ambient();
  rsl::Vec3Array paint(g), diffuse(g), glossy(g), mirrored(g), R(g), type(g);
  for (int i : b) paint.set(i, {1, 1, 1});
  if (*texturename(g)) b.texture(texturename(g), paint);
  g->call->rayInfo(g->host, g, "type", type);
  TmLightSample sample;
  for (int k = 0; g->call->light(g->host, g, k, &sample); ++k)
    for (int i : b) {
      const Vec3 L = rsl::get(sample.L, i), H = rsl::normalize(L + V[i]);
      const float nl = rsl::dot(N[i], L), nv = std::max(1e-4f, rsl::dot(N[i], V[i])), nh = rsl::dot(N[i], H), lh = rsl::dot(L, H);
      if (nl <= 0) continue;
      const Material m(g, i, paint[i]);
      const Color light = nl * rsl::get(sample.Cl, i);
      if (!sample.nondiffuse) diffuse.set(i, diffuse[i] + light * m.diffuse(nl, nv, lh));
      // Indirect light is diffuse light: of its direction no more is known than the main one. Gather rays carry diffuse light alone.
      if (!sample.nonspecular && !sample.isIndirect && type[i].x != 1) glossy.set(i, glossy[i] + light * m.glossy(nl, nv, nh, lh));
    }
  int rays = 0;
  float cone = 0;
  for (int i : b) {
    R.set(i, rsl::reflect(-V[i], N[i]));
    rays = type[i].x == 0 || type[i].x == 2 ? static_cast<int>(reflections(g, i)) : 0;
    cone = rays > 1 ? std::atan(Material(g, i, paint[i]).alpha) : 0;
  }
  if (rays > 0) {
    TmRayOptions options = rsl::defaultRays();
    options.samples = rays, options.coneAngle = std::min(cone, 0.17f);  // wider cones would be diffuse rays
    mirrored = b.trace(R, options);
  }
  for (int i : b) {
    const Material m(g, i, paint[i]);
    const float F = fresnelWeight(std::max(0.0f, rsl::dot(N[i], V[i])));
    const float coat = m.coat * rsl::mix(0.04f, 1, F);
    // Rough lobes at grazing angles do not reach the mirror's value (Lagarde's fit).
    const Color least = rsl::max(m.specular0, Color{1 - m.roughness, 1 - m.roughness, 1 - m.roughness});
    const Color mirror = (rsl::mix(m.specular0, least, F) + Color{coat, coat, coat}) * mirrored[i];
    const Color matte = m.matte * m.base * ambient[i] + diffuse[i];
    b.output(i, matte + glossy[i] + mirror + emission(g, i), b.Os(i));
    if (diffusePart.wanted(g)) diffusePart.set(g, i, b.Os(i) * matte);
    if (specularPart.wanted(g)) specularPart.set(g, i, b.Os(i) * glossy[i]);
    if (reflectionPart.wanted(g)) reflectionPart.set(g, i, b.Os(i) * mirror);
    if (albedo.wanted(g)) albedo.set(g, i, b.Os(i) * m.base);
  }
}
}  // namespace

extern const rsl::Shader disneyShader;
const rsl::Shader disneyShader(TM_SURFACE, "disney", "principled surface of base colour Cs (Burley 2012)",
                               TM_KEEPS_OPACITY | TM_TRACES | TM_DERIVATIVES, shade,
                               {&metallic, &specular, &speculartint, &roughness, &sheen, &sheentint, &clearcoat, &clearcoatgloss, &reflections,
                                &emission, &texturename, &diffusePart, &specularPart, &reflectionPart, &albedo});
