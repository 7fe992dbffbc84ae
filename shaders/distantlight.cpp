#include "reyes/shader.h"

namespace {
rsl::FloatParam intensity("intensity", 1, "scale");
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "colour");
rsl::PointParam from("from", {0, 0, 0}, "light travels from here");
rsl::PointParam to("to", {0, 0, 1}, "to here");

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  for (int i : b) b.illuminate(i, from(g, i) - to(g, i), intensity(g, i) * lightcolor(g, i));
}
}  // namespace

extern const rsl::Shader distantlightShader, shadowdistantShader;
const rsl::Shader distantlightShader(TM_LIGHT, "distantlight", "parallel light from infinity", TM_LIGHT_SOLAR,
                                     shade, {&intensity, &lightcolor, &from, &to});
// The same parameters in the same order: they may serve two shaders.
const rsl::Shader shadowdistantShader(TM_LIGHT, "shadowdistant",
                                      "distantlight with shadows that `shadowname` asks for; always traced",
                                      TM_LIGHT_SOLAR, shade, {&intensity, &lightcolor, &from, &to});
