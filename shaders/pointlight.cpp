#include "reyes/shader.h"

namespace {
rsl::FloatParam intensity("intensity", 1, "scale: the light at distance 1");
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "colour");
rsl::PointParam from("from", {0, 0, 0}, "position");

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  for (int i : b) {
    const rsl::Vec3 L = from(g, i) - b.P(i);
    b.illuminate(i, L, intensity(g, i) * lightcolor(g, i) / std::max(rsl::dot(L, L), 1e-20f));
  }
}
}  // namespace

extern const rsl::Shader pointlightShader, shadowpointShader;
const rsl::Shader pointlightShader(TM_LIGHT, "pointlight", "light from a point, inverse square", 0, shade,
                                   {&intensity, &lightcolor, &from});
// The same parameters in the same order: they may serve two shaders.
const rsl::Shader shadowpointShader(TM_LIGHT, "shadowpoint",
                                    "pointlight with shadows that `shadowname` asks for; always traced", 0,
                                    shade, {&intensity, &lightcolor, &from});
