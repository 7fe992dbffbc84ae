#include "reyes/shader.h"

namespace {
tm::FloatParam intensity("intensity", 1, "scale: the light at distance 1");
tm::ColorParam lightcolor("lightcolor", {1, 1, 1}, "colour");
tm::PointParam from("from", {0, 0, 0}, "position");

void shade(const TmGrid* g) {
  const tm::Batch b(g);
  for (int i : b) {
    const tm::Vec3 L = from(g, i) - b.P(i);
    b.illuminate(i, L, intensity(g, i) * lightcolor(g, i) / std::max(tm::dot(L, L), 1e-20f));
  }
}
}  // namespace

extern const tm::Shader pointlightShader;
const tm::Shader pointlightShader(TM_LIGHT, "pointlight", "light from a point, inverse square", 0, shade,
                                  {&intensity, &lightcolor, &from});
