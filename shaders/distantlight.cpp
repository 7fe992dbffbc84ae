#include "reyes/shader.h"

namespace {
tm::FloatParam intensity("intensity", 1, "scale");
tm::ColorParam lightcolor("lightcolor", {1, 1, 1}, "colour");
tm::PointParam from("from", {0, 0, 0}, "light travels from here");
tm::PointParam to("to", {0, 0, 1}, "to here");

void shade(const TmGrid* g) {
  const tm::Batch b(g);
  for (int i : b) b.illuminate(i, from(g, i) - to(g, i), intensity(g, i) * lightcolor(g, i));
}
}  // namespace

extern const tm::Shader distantlightShader;
const tm::Shader distantlightShader(TM_LIGHT, "distantlight", "parallel light from infinity", TM_LIGHT_SOLAR,
                                    shade, {&intensity, &lightcolor, &from, &to});
