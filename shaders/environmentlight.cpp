#include "reyes/shader.h"

namespace {
rsl::FloatParam intensity("intensity", 1, "scale");
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "radiance of the sky, or what multiplies its map");
rsl::StringParam map("map", "", "latitude-longitude picture, +z of the world at its top; none: uniform");
rsl::FloatParam samples("samples", 64, "directions for each shaded point");

// The map is seen through a filter of this angle, radians: less noise from small bright spots, while
// irradiance changes by less than a thousandth.
constexpr float kBlur = 0.1f;
// Below this cosine a direction is lifted, so that Cl stays finite.
constexpr float kLeastCosine = 1e-3f;

/// Direction around the unit vector N with density cos / pi; `cosine` is L.N.
rsl::Vec3 cosineDirection(rsl::Vec3 N, float xi0, float xi1, float& cosine) {
  // Orthonormal basis of Duff et al. 2017, "Building an orthonormal basis, revisited".
  const float sign = std::copysign(1.0f, N.z), a = -1 / (sign + N.z), b = N.x * N.y * a;
  const rsl::Vec3 T{1 + sign * N.x * N.x * a, sign * b, -sign * N.x}, B{b, sign + N.y * N.y * a, -N.y};
  const float r = std::sqrt(xi0), phi = 6.28318531f * xi1;
  cosine = std::max(kLeastCosine, std::sqrt(1 - xi0));
  return r * std::cos(phi) * T + r * std::sin(phi) * B + cosine * N;
}

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  const float n = static_cast<float>(g->samples);
  rsl::Vec3Array L(g), sky(g);
  rsl::Array cosine(g), width(g);
  for (int i : b) {
    L.set(i, cosineDirection(b.facingNormal(i), g->xi0[i], g->xi1[i], cosine[i]));
    sky.set(i, {1, 1, 1});
    width[i] = kBlur;
  }
  if (*map(g) != '\0') b.environment(map(g), L, width.data(), sky);
  // Density cos / pi and E/pi: diffuse(N) is the mean of the radiance that the samples meet.
  for (int i : b) b.illuminate(i, L[i], intensity(g, i) * lightcolor(g, i) * sky[i] / (n * cosine[i]));
}
}  // namespace

extern const rsl::Shader environmentlightShader;
const rsl::Shader environmentlightShader(TM_LIGHT, "environmentlight",
                                         "light from all around, at infinity: a sky",
                                         TM_LIGHT_SOLAR | TM_LIGHT_SHADOWED | TM_LIGHT_SAMPLED, shade,
                                         {&intensity, &lightcolor, &map, &samples});
