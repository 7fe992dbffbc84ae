#include "reyes/shader.h"

namespace {
rsl::FloatParam Km("Km", 1, "height of a white texel");
rsl::FloatParam amplitude("amplitude", 1, "older name of Km; the two multiply");
rsl::StringParam texturename("texturename", "", "picture of heights; none: no displacement");
rsl::UniformFloatParam moves("moves", 1, "0: normals turn as if points had moved, which stay");

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  rsl::Vec3Array picture(g);
  if (*texturename(g) == '\0' || !b.texture(texturename(g), picture)) return;
  rsl::Array amount(g);
  for (int i : b) amount[i] = Km(g, i) * amplitude(g, i) * picture[i].x;
  moves(g) != 0 ? b.displace(amount) : b.bump(amount);
}
}  // namespace

extern const rsl::Shader bumpyShader;
const rsl::Shader bumpyShader(TM_DISPLACEMENT, "bumpy", "P += Km texture(s, t) N", 0, shade,
                              {&Km, &amplitude, &texturename, &moves});
