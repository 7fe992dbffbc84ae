#include "shaders/shadow.h"

namespace {
rsl::FloatParam intensity("intensity", 1, "scale", TM_ROLE_SCALE);
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "colour", TM_ROLE_TINT);
rsl::PointParam from("from", {0, 0, 0}, "light travels from here");
rsl::PointParam to("to", {0, 0, 1}, "to here");
ShadowParams shadow;

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  for (int i : b) b.illuminate(i, from(g, i) - to(g, i), intensity(g, i) * lightcolor(g, i));
}

void shadeShadowed(const TmGrid* g) {
  shade(g);
  shadow.dim(rsl::Batch(g), shadow.shadowname(g));
}
}  // namespace

extern const rsl::Shader distantlightShader, shadowdistantShader;
const rsl::Shader distantlightShader(TM_LIGHT, "distantlight", "parallel light from infinity", TM_LIGHT_SOLAR, shade,
                                     {&intensity, &lightcolor, &from, &to});
// The same parameters may serve two shaders at the same places.
const rsl::Shader shadowdistantShader(TM_LIGHT, "shadowdistant",
                                      "distantlight with shadows: traced, or of a shadow map", TM_LIGHT_SOLAR,
                                      shadeShadowed,
                                      {&intensity, &lightcolor, &from, &to, &shadow.shadowname, &shadow.samples,
                                       &shadow.blur, &shadow.width, &shadow.shadowbias});
