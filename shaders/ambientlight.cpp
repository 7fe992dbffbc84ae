#include "reyes/shader.h"

namespace {
rsl::FloatParam intensity("intensity", 1, "scale", TM_ROLE_SCALE);
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "colour", TM_ROLE_TINT);

void shade(const TmGrid* g) {
  for (int i : rsl::Batch(g)) rsl::set(g->Cl, i, intensity(g, i) * lightcolor(g, i));
}
}  // namespace

extern const rsl::Shader ambientlightShader;
const rsl::Shader ambientlightShader(TM_LIGHT, "ambientlight", "the same light everywhere, from nowhere",
                                     TM_LIGHT_AMBIENT, shade, {&intensity, &lightcolor});
