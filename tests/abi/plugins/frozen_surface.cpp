// A surface of ABI 1: parameters, an output, a texture, rays, light. It is compiled against the headers of ABI 1 for
// ever.
#include <reyes/shader.h>

namespace {
rsl::FloatParam textureweight("textureweight", 1, "weight of the picture"),
    coverweight("coverweight", 1, "weight of what covers the axis");
rsl::UniformFloatParam samples("samples", 4, "rays a point");
rsl::StringParam texturename("texturename", "", "picture");
rsl::VectorParam axis("axis", {0, 0, 1}, "where rays go");
rsl::FloatArrayParam scales("scales", {0.5f, 1, 2}, "red, green and blue");
rsl::ColorOutput traced("traced", "what rays bring");

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  rsl::Vec3Array picture(g), direction(g), light(g), Nf = b.facingNormals();
  TmTextureOptions lookup = tmTextureDefaults();
  lookup.swidth = lookup.twidth = 2;
  if (*texturename(g)) b.texture(texturename(g), picture, lookup);
  TmRayOptions rays = tmRayDefaults();
  rays.samples = static_cast<int32_t>(samples(g)), rays.coneAngle = 0.02f, rays.label = "frozen";
  for (int i : b) direction.set(i, axis(g, i));
  const rsl::Vec3Array seen = b.trace(direction, rays);
  const rsl::Array covered = b.occlusion(direction, rays);
  for (TmIlluminance sample = tmIlluminanceDefaults(); b.illuminance(sample);)
    for (int i : b)
      if (sample.lit[i])
        light.set(i,
                  light[i] + std::max(0.0f, rsl::dot(Nf[i], rsl::get(sample.direction, i))) * rsl::get(sample.Cl, i));
  for (int i : b) {
    const rsl::Color c{textureweight(g, i) * picture[i].x, seen[i].y + coverweight(g, i) * covered[i], light[i].z};
    b.output(i, {scales(g, 0) * c.x, scales(g, 1) * c.y, scales(g, 2) * c.z}, b.Os(i));
    if (traced.wanted(g)) traced.set(g, i, b.Os(i) * seen[i]);
  }
}

const rsl::Shader frozen(TM_SURFACE, "frozen_surface", "of ABI 1", TM_KEEPS_OPACITY | TM_TRACES | TM_DERIVATIVES, shade,
                         {&textureweight, &coverweight, &samples, &texturename, &axis, &scales, &traced});
}  // namespace

TM_SHADER_LIBRARY(frozen)
