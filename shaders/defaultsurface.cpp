#include "reyes/shader.h"

namespace {
rsl::FloatParam Kd("Kd", 0.8f, "weight of the headlight");
rsl::FloatParam Ka("Ka", 0.2f, "constant part");

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  for (int i : b) {
    const float headlight = std::abs(rsl::dot(rsl::normalize(b.N(i)), rsl::normalize(b.I(i))));
    b.output(i, b.Cs(i) * (Ka(g, i) + Kd(g, i) * headlight), b.Os(i));
  }
}
}  // namespace

extern const rsl::Shader defaultsurfaceShader;
const rsl::Shader defaultsurfaceShader(TM_SURFACE, "defaultsurface", "Os Cs (Ka + Kd |N.I|): visible without lights",
                                       TM_KEEPS_OPACITY | TM_EMITS, shade, {&Kd, &Ka});
