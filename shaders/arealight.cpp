#include "reyes/shader.h"

namespace {
tm::FloatParam intensity("intensity", 1, "scale");
tm::ColorParam lightcolor("lightcolor", {1, 1, 1},
                          "radiance that the geometry emits from the side of its normal");
tm::FloatParam samples("samples", 16, "points on the emitter for each shaded point");
tm::FloatParam visible("visible", 1, "0: camera and specular rays do not see it glow");

void shade(const TmGrid* g) {
  for (int i : tm::Batch(g)) tm::set(g->Cl, i, intensity(g, i) * lightcolor(g, i));
}
}  // namespace

extern const tm::Shader arealightShader;
const tm::Shader arealightShader(TM_LIGHT, "arealight", "geometry that emits light; use with AreaLightSource",
                                 TM_LIGHT_AREA | TM_LIGHT_SHADOWED, shade,
                                 {&intensity, &lightcolor, &samples, &visible});
