#include "reyes/shader.h"

namespace {
rsl::FloatParam Km("Km", 0.1f, "largest displacement to either side");
rsl::FloatParam frequency("frequency", 1, "lumps for each unit of `space`");
rsl::FloatParam octaves("octaves", 4, "layers, each twice as fine and half as high");
rsl::StringParam space("space", "shader", "the noise stands still in this space");

// Octaves weigh 1/2, 1/4, ... of their sum, so Km bounds the displacement.
float fractalNoise(rsl::Vec3 p, int count) {
  float sum = 0, weights = 0;
  for (int k = 0; k < count; ++k) {
    const float weight = std::ldexp(1.0f, -k);
    sum += weight * rsl::signedNoise(p * std::ldexp(1.0f, k));
    weights += weight;
  }
  return weights > 0 ? sum / weights : 0;
}

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  const rsl::Vec3Array p = b.positionsIn(space(g));
  rsl::Array amount(g);
  for (int i : b) {
    const int count = static_cast<int>(rsl::clamp(octaves(g, i), 0, 16));
    amount[i] = Km(g, i) * fractalNoise(p[i] * frequency(g, i), count);
  }
  b.displace(amount);
}
}  // namespace

extern const rsl::Shader noisybumpShader;
const rsl::Shader noisybumpShader(TM_DISPLACEMENT, "noisybump", "P += Km fractal noise N", 0, shade,
                                  {&Km, &frequency, &octaves, &space});
