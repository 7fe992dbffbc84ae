// A complete surface shader: matte, with dots of another colour. Build and use it as docs/shader_writing.md
// says.
#include <reyes/shader.h>

namespace {
rsl::FloatParam Kd("Kd", 0.8f, "weight of diffuse light");
rsl::FloatParam frequency("frequency", 8, "dots for each unit of s and t");
rsl::FloatParam radius("radius", 0.3f, "of a dot, as a fraction of its cell");
rsl::ColorParam dotcolor("dotcolor", {0.8f, 0.1f, 0.1f}, "colour of the dots");

float distanceToDot(float s, float t) { return std::hypot(s - std::floor(s) - 0.5f, t - std::floor(t) - 0.5f); }

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  const rsl::Vec3Array diffuse = b.diffuse(b.facingNormals());
  for (int i : b) {
    const float r = distanceToDot(g->s[i] * frequency(g, i), g->t[i] * frequency(g, i));
    const rsl::Color base = r < radius(g, i) ? dotcolor(g, i) : b.Cs(i);
    b.output(i, base * Kd(g, i) * diffuse[i], b.Os(i));
  }
}

const rsl::Shader dots(TM_SURFACE, "dots", "matte with dots", TM_KEEPS_OPACITY, shade,
                       {&Kd, &frequency, &radius, &dotcolor});
}  // namespace

TM_SHADER_LIBRARY(dots)
