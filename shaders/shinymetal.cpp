#include "reyes/shader.h"

namespace {
rsl::FloatParam Ka("Ka", 1, "weight of ambient light");
rsl::FloatParam Ks("Ks", 1, "weight of highlights");
rsl::FloatParam Kr("Kr", 1, "weight of the mirrored surroundings");
rsl::FloatParam roughness("roughness", 0.1f, "width of highlights");
rsl::StringParam texturename(
    "texturename", "", "latitude-longitude picture of the surroundings; \"raytrace\": the scene itself; none: metal");
rsl::ColorOutput ambientPart("ambient", "share of ambient light"), specularPart("specular", "share of highlights"),
    reflectionPart("reflection", "share of the mirrored surroundings");

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  const rsl::Vec3Array Nf = b.facingNormals(), ambient = b.ambient();
  const rsl::Vec3Array specular = b.specular(Nf, b.towardsViewer(), roughness);
  rsl::Vec3Array R(g), mirrored(g);
  for (int i : b) R.set(i, rsl::reflect(rsl::normalize(b.I(i)), Nf[i]));
  if (std::string(texturename(g)) == "raytrace")
    mirrored = b.trace(R);
  else if (*texturename(g) != '\0')
    g->call->environmentWith(g->host, g, texturename(g), nullptr, R, mirrored);
  for (int i : b) {
    const rsl::Color fromAmbient = b.Cs(i) * (Ka(g, i) * ambient[i]), shine = b.Cs(i) * (Ks(g, i) * specular[i]);
    const rsl::Color mirror = b.Cs(i) * (Kr(g, i) * mirrored[i]);
    b.output(i, fromAmbient + shine + mirror, b.Os(i));
    if (ambientPart.wanted(g)) ambientPart.set(g, i, b.Os(i) * fromAmbient);
    if (specularPart.wanted(g)) specularPart.set(g, i, b.Os(i) * shine);
    if (reflectionPart.wanted(g)) reflectionPart.set(g, i, b.Os(i) * mirror);
  }
}
}  // namespace

extern const rsl::Shader shinymetalShader;
const rsl::Shader shinymetalShader(
    TM_SURFACE, "shinymetal", "Os Cs (Ka ambient() + Ks specular(Nf, V, roughness) + Kr environment(texturename, R))",
    TM_KEEPS_OPACITY | TM_TRACES, shade,
    {&Ka, &Ks, &Kr, &roughness, &texturename, &ambientPart, &specularPart, &reflectionPart});
