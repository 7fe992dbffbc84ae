#include "reyes/shader.h"

namespace {
rsl::FloatParam eta("eta", 1.5f, "index of refraction of the inside, over that of the outside");
rsl::FloatParam Kr("Kr", 1, "weight of what is mirrored");
rsl::FloatParam Kt("Kt", 1, "weight of what is seen through it");
rsl::ColorParam transmitcolor("transmitcolor", {1, 1, 1}, "tint at each surface that light passes");

/// Returns the index of the side that the ray comes from over that of the other side. Normals point outwards, so a ray
/// that goes against Ng enters.
float etaAt(const rsl::Batch& b, int i) {
  const bool enters = rsl::dot(b.I(i), b.Ng(i)) < 0;
  return enters ? 1 / eta(b.g, i) : eta(b.g, i);
}

// Reflections weaker than this are left out if they are seen through other glass or in mirrors, because rays would
// double at every surface. Their share goes to what is seen through the glass.
constexpr float kLeastMirroring = 0.2f;

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  const bool direct = b.rayDepth() == 0;
  rsl::Vec3Array R(g), T(g);
  rsl::Array mirroring(g);
  for (int i : b) {
    const rsl::Vec3 I = rsl::normalize(b.I(i)), N = b.facingNormal(i);
    mirroring[i] = rsl::fresnel(I, N, etaAt(b, i));
    if (!direct && mirroring[i] < kLeastMirroring) mirroring[i] = 0;
    if (mirroring[i] > 0) R.set(i, rsl::reflect(I, N));
    T.set(i, rsl::refract(I, N, etaAt(b, i)));
  }
  const rsl::Vec3Array mirrored = b.trace(R), through = b.trace(T);
  for (int i : b)
    b.output(i,
             Kr(g, i) * mirroring[i] * mirrored[i] + Kt(g, i) * (1 - mirroring[i]) * transmitcolor(g, i) * through[i],
             b.Os(i));
}
}  // namespace

extern const rsl::Shader glassShader;
const rsl::Shader glassShader(
    TM_SURFACE, "glass",
    "what Fresnel's equations reflect and refract, traced; give the object Attribute \"trace\" "
    "\"maxspeculardepth\" 4 or more",
    TM_KEEPS_OPACITY | TM_TRACES, shade, {&eta, &Kr, &Kt, &transmitcolor});
