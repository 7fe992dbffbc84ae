#include "reyes/shader.h"

namespace {
rsl::FloatParam Ka("Ka", 1, "weight of ambient light");
rsl::FloatParam Ks("Ks", 1, "weight of highlights");
rsl::FloatParam roughness("roughness", 0.1f, "width of highlights");
rsl::ColorOutput ambientPart("ambient", "share of ambient light"), specularPart("specular", "share of highlights");

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  const rsl::Vec3Array ambient = b.ambient();
  const rsl::Vec3Array specular = b.specular(b.facingNormals(), b.towardsViewer(), roughness);
  for (int i : b) {
    const rsl::Color fromAmbient = b.Cs(i) * (Ka(g, i) * ambient[i]), shine = b.Cs(i) * (Ks(g, i) * specular[i]);
    b.output(i, fromAmbient + shine, b.Os(i));
    if (ambientPart.wanted(g)) ambientPart.set(g, i, b.Os(i) * fromAmbient);
    if (specularPart.wanted(g)) specularPart.set(g, i, b.Os(i) * shine);
  }
}
}  // namespace

extern const rsl::Shader metalShader;
const rsl::Shader metalShader(TM_SURFACE, "metal", "Os Cs (Ka ambient() + Ks specular(Nf, V, roughness))",
                              TM_KEEPS_OPACITY, shade, {&Ka, &Ks, &roughness, &ambientPart, &specularPart});
