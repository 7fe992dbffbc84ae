#include "reyes/shader.h"

namespace {
rsl::FloatParam Kr("Kr", 1, "weight of what is mirrored");
rsl::ColorParam specularcolor("specularcolor", {1, 1, 1}, "tint of what is mirrored");
rsl::UniformFloatParam blur("blur", 0,
                            "half angle of the cone of reflected rays, radians; up to 0.17 they are specular rays");
rsl::UniformFloatParam samples("samples", 1, "reflected rays for each point");

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  rsl::Vec3Array R(g);
  TmRayOptions rays = tmRayDefaults();
  rays.coneAngle = blur(g);
  rays.samples = static_cast<int32_t>(samples(g));
  for (int i : b) R.set(i, rsl::reflect(rsl::normalize(b.I(i)), b.facingNormal(i)));
  const rsl::Vec3Array mirrored = b.trace(R, rays);
  for (int i : b) b.output(i, Kr(g, i) * specularcolor(g, i) * mirrored[i], b.Os(i));
}
}  // namespace

extern const rsl::Shader mirrorShader;
const rsl::Shader mirrorShader(TM_SURFACE, "mirror", "Os Kr specularcolor trace(P, R)", TM_KEEPS_OPACITY | TM_TRACES,
                               shade, {&Kr, &specularcolor, &blur, &samples});
