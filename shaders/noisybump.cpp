#include "reyes/shader.h"

namespace {
rsl::FloatParam Km("Km", 0.1f, "largest displacement to either side");
rsl::FloatParam frequency("frequency", 1, "lumps for each unit of `space`");
rsl::FloatParam octaves("octaves", 4, "layers, each twice as fine and half as high");
rsl::StringParam space("space", "shader", "the noise stands still in this space");
rsl::UniformFloatParam moves("moves", 1, "0: normals turn as if points had moved, which stay");

struct Octave {
  float scale, weight;  ///< 2^k, 2^-k
  float number;         ///< k
};

/// Adds one octave to all points, also inactive ones: sum += weight * noise where the point has that octave. `octave`
/// is a copy, because each store might change a reference.
RSL_HOT void addOctave(const Octave octave, int n, TmConstVec3 p, const float* counts, float* sum, float* weights) {
  for (int i = 0; i < n; ++i) {
    const float weight = octave.number < counts[i] ? octave.weight : 0.0f;
    sum[i] += weight * rsl::signedNoise(rsl::Vec3{p.x[i], p.y[i], p.z[i]} * octave.scale);
    weights[i] += weight;
  }
}

// The weights of octaves are 1/2, 1/4, ... of their sum, so Km bounds the displacement.
void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  rsl::Vec3Array p = b.positionsIn(space(g));
  rsl::Array amount(g), counts(g), sum(g), weights(g);
  int most = 0;
  for (int i : b) {
    p.set(i, p[i] * frequency(g, i));
    counts[i] = std::trunc(rsl::clamp(octaves(g, i), 0, 16));
    most = std::max(most, static_cast<int>(counts[i]));
  }
  for (int octave = 0; octave < most; ++octave) {
    const auto k = static_cast<float>(octave);
    addOctave({std::exp2(k), std::exp2(-k), k}, g->count, p, counts.data(), sum.data(), weights.data());
  }
  for (int i : b) amount[i] = weights[i] > 0 ? Km(g, i) * (sum[i] / weights[i]) : 0.0f;
  moves(g) != 0 ? b.displace(amount) : b.bump(amount);
}
}  // namespace

extern const rsl::Shader noisybumpShader;
const rsl::Shader noisybumpShader(TM_DISPLACEMENT, "noisybump", "P += Km fractal noise N", 0, shade,
                                  {&Km, &frequency, &octaves, &space, &moves});
