#include "reyes/shader.h"

namespace {
tm::FloatParam Km("Km", 1, "height of a white texel");
tm::FloatParam amplitude("amplitude", 1, "older name of Km; the two multiply");
tm::StringParam texturename("texturename", "", "picture of heights; none: no displacement");

void shade(const TmGrid* g) {
  const tm::Batch b(g);
  tm::Vec3Array picture(g);
  if (*texturename(g) == '\0' || !b.texture(texturename(g), picture)) return;
  tm::Array amount(g);
  for (int i : b) amount[i] = Km(g, i) * amplitude(g, i) * picture[i].x;
  b.displace(amount);
}
}  // namespace

extern const tm::Shader bumpyShader;
const tm::Shader bumpyShader(TM_DISPLACEMENT, "bumpy", "P += Km texture(s, t) N", 0, shade,
                             {&Km, &amplitude, &texturename});
