// Indirect light as a light shader, so that existing surface shaders receive it unchanged (approximate-gi
// sections 4.6 and 5): three light samples, one a colour channel, each from its own dominant direction.
#include "reyes/shader.h"

namespace {
rsl::FloatParam intensity("intensity", 1, "scale");
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "tint");
rsl::FloatParam samples("samples", 600, "rays for each irradiance sample");
rsl::FloatParam maxerror("maxerror", 1, "kappa of the error function; 0 computes every point");
rsl::StringParam errorfunction("errorfunction", "screen", "screen, ward or hessian");
rsl::StringParam radiance("radiance", "shader", "what a gather ray sees: shader, radiosity, atlas or points");
rsl::StringParam atlas("atlas", "", "directory of brick maps");
rsl::FloatParam bounces("bounces", 1, "diffuse bounces accounted for");
rsl::FloatParam maxdist("maxdist", 1e30f, "length of gather rays");
rsl::StringParam subset("subset", "", "objects that gather rays see");

float channel(rsl::Vec3 v, int c) { return c == 0 ? v.x : c == 1 ? v.y : v.z; }

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  const rsl::Vec3Array Nf = b.facingNormals(), E(g), red(g), green(g), blue(g);
  TmVec3 dominant[3] = {red, green, blue};
  g->call->indirectDiffuse(g->host, g, Nf, E, dominant);
  for (int i : b) {
    const rsl::Vec3 N = Nf[i], w = rsl::get(dominant[g->sample], i),
                    tint = intensity(g, i) * lightcolor(g, i);
    // A direction at the horizon or below (extrapolated from another point's hemisphere) is lifted just above
    // it.
    const rsl::Vec3 L = rsl::normalize(w + std::max(0.0f, 0.01f - rsl::dot(N, w)) * N);
    // Eq. 6: all of E comes from L, so that diffuse(N) gives E back.
    const float Cl = channel(E[i], g->sample) * channel(tint, g->sample) / std::max(1e-6f, rsl::dot(N, L));
    b.illuminate(i, L, {g->sample == 0 ? Cl : 0, g->sample == 1 ? Cl : 0, g->sample == 2 ? Cl : 0});
  }
}
}  // namespace

extern const rsl::Shader indirectlightShader;
const rsl::Shader indirectlightShader(TM_LIGHT, "indirectlight",
                                      "diffuse light from other surfaces (docs/gi.md)", TM_LIGHT_INDIRECT,
                                      shade,
                                      {&intensity, &lightcolor, &samples, &maxerror, &errorfunction,
                                       &radiance, &atlas, &bounces, &maxdist, &subset});
