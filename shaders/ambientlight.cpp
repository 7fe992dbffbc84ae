#include "reyes/shader.h"

namespace {
tm::FloatParam intensity("intensity", 1, "scale");
tm::ColorParam lightcolor("lightcolor", {1, 1, 1}, "colour");

void shade(const TmGrid* g) {
  for (int i : tm::Batch(g)) tm::set(g->Cl, i, intensity(g, i) * lightcolor(g, i));
}
}  // namespace

extern const tm::Shader ambientlightShader;
const tm::Shader ambientlightShader(TM_LIGHT, "ambientlight", "the same light everywhere, from nowhere",
                                    TM_LIGHT_AMBIENT, shade, {&intensity, &lightcolor});
