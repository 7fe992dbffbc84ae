#include "reyes/shader.h"

namespace {
rsl::FloatParam intensity("intensity", 1, "scale", TM_ROLE_SCALE);
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "radiance of what is all around", TM_ROLE_TINT);
rsl::UniformFloatParam samples("samples", 64, "rays for each point");
rsl::UniformFloatParam coneangle("coneangle", 1.5707963f, "half angle around the normal that is looked at");
rsl::UniformFloatParam maxdist("maxdist", 1e30f, "what is farther covers nothing");
rsl::UniformFloatParam falloff("falloff", 0, "what is at distance d covers exp(-falloff d); 0: wholly");
rsl::UniformFloatParam maxvariation(
    "maxvariation", -1,
    "how far an interpolated share may be off; 0: traced at every point; negative: by irradiance:maxerror",
    TM_ROLE_MAX_VARIATION);
rsl::StringParam subset("subset", "", "sets of objects that cover; none: all");

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  TmRayOptions rays = tmRayDefaults();
  rays.samples = static_cast<int32_t>(samples(g));
  rays.coneAngle = coneangle(g);
  rays.maxDistance = maxdist(g);
  rays.subset = subset(g);
  TmOcclusion options = tmOcclusionDefaults();
  options.falloff = falloff(g);
  options.maxVariation = maxvariation(g);
  const rsl::Array covered = b.occlusion(b.facingNormals(), rays, options);
  for (int i : b) rsl::set(g->Cl, i, intensity(g, i) * (1 - covered[i]) * lightcolor(g, i));
}
}  // namespace

extern const rsl::Shader occlusionlightShader;
const rsl::Shader occlusionlightShader(TM_LIGHT, "occlusionlight", "ambient light, darker where objects cover the sky",
                                       TM_LIGHT_AMBIENT | TM_TRACES | TM_OCCLUDED, shade,
                                       {&intensity, &lightcolor, &samples, &coneangle, &maxdist, &falloff,
                                        &maxvariation, &subset});
