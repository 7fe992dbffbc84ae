#include <cstring>

#include "reyes/shader.h"

namespace {
rsl::FloatParam intensity("intensity", 1, "scale", TM_ROLE_SCALE);
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "radiance of the sky, or what multiplies its map", TM_ROLE_TINT);
rsl::StringParam map("map", "", "latitude-longitude picture, +z at its top; none: uniform", TM_ROLE_SKY_MAP);
rsl::StringParam mapspace("mapspace", "world", "space whose +z is the top of the map: world or shader",
                          TM_ROLE_SKY_SPACE);
rsl::FloatParam samples("samples", 64, "directions for each shaded point", TM_ROLE_SAMPLES);
rsl::FloatParam visible("visible", 1, "0: specular rays do not see it", TM_ROLE_VISIBLE);
rsl::StringParam portals("portals", "", "CoordinateSystems whose unit squares are windows that the sky shines through",
                         TM_ROLE_SKY_PORTALS);

// Angle in radians over which the map is filtered: that of one of the 1024 columns of cells by which its brightness is
// known.
constexpr float kCell = 0.00614f;

/// environment() takes world directions. For a map in shader space, a direction is returned that has the coordinates in
/// world space which L has in shader space.
rsl::Vec3Array directions(const TmGrid* g) {
  rsl::Vec3Array out(g);
  for (int i : rsl::Batch(g)) out.set(i, rsl::get(g->L, i));
  if (std::strcmp(mapspace(g), "shader") != 0) return out;
  g->call->transform(g->host, g, TM_AS_VECTOR, "current", "shader", rsl::view(g->L), out);
  g->call->transform(g->host, g, TM_AS_VECTOR, "world", "current", rsl::view(TmVec3(out)), out);
  return out;
}

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  rsl::Vec3Array sky(g);
  rsl::Array width(g);
  for (int i : b) {
    sky.set(i, {1, 1, 1});
    width[i] = kCell;
  }
  TmTextureOptions options = tmTextureDefaults();
  options.angle = width.data();
  if (*map(g) != '\0') b.environment(map(g), directions(g), sky, options);
  for (int i : b) rsl::set(g->Cl, i, intensity(g, i) * lightcolor(g, i) * sky[i]);
}
}  // namespace

extern const rsl::Shader environmentlightShader;
const rsl::Shader environmentlightShader(TM_LIGHT, "environmentlight", "light from all around, at infinity: a sky",
                                         TM_LIGHT_SOLAR | TM_LIGHT_SHADOWED | TM_LIGHT_SKY, shade,
                                         {&intensity, &lightcolor, &map, &samples, &mapspace, &visible, &portals});
