// The surfaces plastic and paintedplastic are one shader, the second with a texture that multiplies Cs (RISpec 3.2,
// appendix A).
#include "shaders/parts.h"

namespace {
struct Params {
  rsl::FloatParam Ka{"Ka", 1, "weight of ambient light"};
  rsl::FloatParam Kd{"Kd", 0.5f, "weight of diffuse light"};
  rsl::FloatParam Ks{"Ks", 0.5f, "weight of highlights"};
  rsl::FloatParam roughness{"roughness", 0.1f, "width of highlights"};
  rsl::ColorParam specularcolor{"specularcolor", {1, 1, 1}, "colour of highlights"};
  DiffuseParts parts;
  rsl::ColorOutput specular{"specular", "share of highlights"};
  rsl::ColorOutput albedo{"albedo", "what diffuse light is multiplied by, without Kd"};
};
Params plain, painted;
rsl::StringParam texturename("texturename", "", "picture that multiplies Cs; none: plastic");

void shadeWith(const rsl::Batch& b, const Params& p, const rsl::Vec3Array* paint) {
  const TmGrid* g = b.g;
  const rsl::Vec3Array Nf = b.facingNormals(), ambient = b.ambient(), diffuse = b.diffuse(Nf);
  const rsl::Vec3Array specular = b.specular(Nf, b.towardsViewer(), p.roughness);
  const auto base = [&](int i) { return paint ? b.Cs(i) * (*paint)[i] : b.Cs(i); };
  for (int i : b) {
    const rsl::Color shine = p.Ks(g, i) * p.specularcolor(g, i) * specular[i];
    b.output(i, base(i) * (p.Ka(g, i) * ambient[i] + p.Kd(g, i) * diffuse[i]) + shine, b.Os(i));
    if (p.specular.wanted(g)) p.specular.set(g, i, b.Os(i) * shine);
    if (p.albedo.wanted(g)) p.albedo.set(g, i, b.Os(i) * base(i));
  }
  p.parts.store(
      b, Nf, ambient, [&](int i) { return p.Ka(g, i) * (b.Os(i) * base(i)); },
      [&](int i) { return p.Kd(g, i) * (b.Os(i) * base(i)); });
}

void shadePlastic(const TmGrid* g) { shadeWith(rsl::Batch(g), plain, nullptr); }

void shadePainted(const TmGrid* g) {
  const rsl::Batch b(g);
  rsl::Vec3Array paint(g);
  const bool named = *texturename(g) != '\0';
  if (named) b.texture(texturename(g), paint);
  shadeWith(b, painted, named ? &paint : nullptr);
}
}  // namespace

extern const rsl::Shader plasticShader, paintedplasticShader;
const rsl::Shader plasticShader(TM_SURFACE, "plastic",
                                "Os (Cs (Ka ambient() + Kd diffuse(Nf)) + specularcolor Ks specular(Nf, V, roughness))",
                                TM_KEEPS_OPACITY, shadePlastic,
                                {&plain.Ka, &plain.Kd, &plain.Ks, &plain.roughness, &plain.specularcolor,
                                 &plain.parts.ambient, &plain.parts.diffuse, &plain.parts.indirectdiffuse,
                                 &plain.specular, &plain.albedo});
const rsl::Shader paintedplasticShader(TM_SURFACE, "paintedplastic", "plastic with Cs multiplied by a texture",
                                       TM_KEEPS_OPACITY | TM_DERIVATIVES, shadePainted,
                                       {&painted.Ka, &painted.Kd, &painted.Ks, &painted.roughness,
                                        &painted.specularcolor, &texturename, &painted.parts.ambient,
                                        &painted.parts.diffuse, &painted.parts.indirectdiffuse, &painted.specular,
                                        &painted.albedo});
