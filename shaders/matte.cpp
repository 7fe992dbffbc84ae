#include "shaders/parts.h"

namespace {
rsl::FloatParam Ka("Ka", 1, "weight of ambient light");
rsl::FloatParam Kd("Kd", 1, "weight of diffuse light");
DiffuseParts parts;

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  const rsl::Vec3Array Nf = b.facingNormals(), ambient = b.ambient(), diffuse = b.diffuse(Nf);
  for (int i : b) b.output(i, b.Cs(i) * (Ka(g, i) * ambient[i] + Kd(g, i) * diffuse[i]), b.Os(i));
  parts.store(
      b, Nf, ambient, [&](int i) { return Ka(g, i) * (b.Os(i) * b.Cs(i)); },
      [&](int i) { return Kd(g, i) * (b.Os(i) * b.Cs(i)); });
}
}  // namespace

extern const rsl::Shader matteShader;
const rsl::Shader matteShader(TM_SURFACE, "matte", "Os Cs (Ka ambient() + Kd diffuse(Nf))", TM_KEEPS_OPACITY | TM_EVEN,
                              shade, {&Ka, &Kd, &parts.ambient, &parts.diffuse, &parts.indirectdiffuse});
