#include "reyes/shader.h"

namespace {
rsl::FloatParam intensity("intensity", 1, "scale");
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "radiance that the geometry emits from the side of its normal");
rsl::FloatParam samples("samples", 16, "points on the emitter for each shaded point", TM_ROLE_SAMPLES);
rsl::FloatParam visible("visible", 1, "0: camera and specular rays do not see it glow", TM_ROLE_VISIBLE);

void shade(const TmGrid* g) {
  for (int i : rsl::Batch(g)) rsl::set(g->Cl, i, intensity(g, i) * lightcolor(g, i));
}
}  // namespace

extern const rsl::Shader arealightShader;
const rsl::Shader arealightShader(TM_LIGHT, "arealight", "geometry that emits light; use with AreaLightSource",
                                  TM_LIGHT_AREA | TM_LIGHT_SHADOWED, shade,
                                  {&intensity, &lightcolor, &samples, &visible});
