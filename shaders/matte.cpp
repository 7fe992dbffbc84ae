#include "reyes/shader.h"

namespace {
tm::FloatParam Ka("Ka", 1, "weight of ambient light");
tm::FloatParam Kd("Kd", 1, "weight of diffuse light");

void shade(const TmGrid* g) {
  const tm::Batch b(g);
  const tm::Vec3Array ambient = b.ambient(), diffuse = b.diffuse(b.facingNormals());
  for (int i : b) b.output(i, b.Cs(i) * (Ka(g, i) * ambient[i] + Kd(g, i) * diffuse[i]), b.Os(i));
}
}  // namespace

extern const tm::Shader matteShader;
const tm::Shader matteShader(TM_SURFACE, "matte", "Os Cs (Ka ambient() + Kd diffuse(Nf))", TM_KEEPS_OPACITY,
                             shade, {&Ka, &Kd});
