#include "reyes/shader.h"

namespace {
tm::FloatParam Kd("Kd", 0.8f, "weight of the headlight");
tm::FloatParam Ka("Ka", 0.2f, "constant part");

void shade(const TmGrid* g) {
  const tm::Batch b(g);
  for (int i : b) {
    const float headlight = std::abs(tm::dot(tm::normalize(b.N(i)), tm::normalize(b.I(i))));
    b.output(i, b.Cs(i) * (Ka(g, i) + Kd(g, i) * headlight), b.Os(i));
  }
}
}  // namespace

extern const tm::Shader defaultsurfaceShader;
const tm::Shader defaultsurfaceShader(TM_SURFACE, "defaultsurface",
                                      "Os Cs (Ka + Kd |N.I|): visible without lights", TM_KEEPS_OPACITY,
                                      shade, {&Kd, &Ka});
