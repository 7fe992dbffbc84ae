#include "reyes/shader.h"

namespace {
rsl::FloatParam Ka("Ka", 1, "weight of ambient light");
rsl::FloatParam Kd("Kd", 1, "weight of diffuse light");

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  const rsl::Vec3Array ambient = b.ambient(), diffuse = b.diffuse(b.facingNormals());
  for (int i : b) b.output(i, b.Cs(i) * (Ka(g, i) * ambient[i] + Kd(g, i) * diffuse[i]), b.Os(i));
}
}  // namespace

extern const rsl::Shader matteShader;
const rsl::Shader matteShader(TM_SURFACE, "matte", "Os Cs (Ka ambient() + Kd diffuse(Nf))", TM_KEEPS_OPACITY,
                              shade, {&Ka, &Kd});
