#include "shaders/shadow.h"

namespace {
rsl::FloatParam intensity("intensity", 1, "scale: the light at distance 1", TM_ROLE_SCALE);
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "colour", TM_ROLE_TINT);
rsl::PointParam from("from", {0, 0, 0}, "position", TM_ROLE_POSITION);
ShadowParams shadow;
rsl::StringParam sfpx("sfpx", "", "shadow map towards +x", TM_ROLE_SHADOW_MAP),
    sfnx("sfnx", "", "shadow map towards -x", TM_ROLE_SHADOW_MAP),
    sfpy("sfpy", "", "shadow map towards +y", TM_ROLE_SHADOW_MAP),
    sfny("sfny", "", "shadow map towards -y", TM_ROLE_SHADOW_MAP),
    sfpz("sfpz", "", "shadow map towards +z", TM_ROLE_SHADOW_MAP),
    sfnz("sfnz", "", "shadow map towards -z", TM_ROLE_SHADOW_MAP);

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  for (int i : b) {
    const rsl::Vec3 L = from(g, i) - b.P(i);
    b.illuminate(i, L, intensity(g, i) * lightcolor(g, i) / std::max(rsl::dot(L, L), 1e-20f));
  }
}

// A map blocks nothing outside of its own pyramid, so each point is dimmed by the map that sees it.
void shadeShadowed(const TmGrid* g) {
  shade(g);
  for (const rsl::StringParam* map : {&shadow.shadowname, &sfpx, &sfnx, &sfpy, &sfny, &sfpz, &sfnz})
    shadow.dim(rsl::Batch(g), (*map)(g));
}
}  // namespace

extern const rsl::Shader pointlightShader, shadowpointShader;
const rsl::Shader pointlightShader(TM_LIGHT, "pointlight", "light from a point, inverse square", TM_LIGHT_BOUNDED,
                                   shade, {&intensity, &lightcolor, &from});
// The same parameters may serve two shaders at the same places.
const rsl::Shader shadowpointShader(TM_LIGHT, "shadowpoint",
                                    "pointlight with shadows: traced, or of a shadow map for each direction",
                                    TM_LIGHT_BOUNDED, shadeShadowed,
                                    {&intensity, &lightcolor, &from, &shadow.shadowname, &shadow.samples, &shadow.blur,
                                     &shadow.width, &shadow.shadowbias, &sfpx, &sfnx, &sfpy, &sfny, &sfpz, &sfnz});
