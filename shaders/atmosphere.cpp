// The volume shaders fog and depthcue (RISpec 3.2, appendix A). Both end in full opacity, so that a surface that fades
// does not show those behind it.
#include "reyes/shader.h"

namespace {
rsl::FloatParam distance("distance", 1, "where 1 - 1/e of the colour is lost");
rsl::ColorParam fogColor("background", {0, 0, 0}, "colour of the fog");
rsl::FloatParam mindistance("mindistance", 0, "depth at which fading begins, 0 at the near clipping plane");
rsl::FloatParam maxdistance("maxdistance", 1, "depth at which it is complete, 1 at the far clipping plane");
rsl::ColorParam cueColor("background", {0, 0, 0}, "colour that distance fades to");

void fade(const TmGrid* g, int i, rsl::Color background, float amount) {
  rsl::set(g->Ci, i, rsl::mix(rsl::get(g->Ci, i), background, amount));
  rsl::set(g->Oi, i, rsl::mix(rsl::get(g->Oi, i), {1, 1, 1}, amount));
}

void shadeFog(const TmGrid* g) {
  const rsl::Batch b(g);
  for (int i : b) fade(g, i, fogColor(g, i), 1 - std::exp(-rsl::length(b.I(i)) / distance(g, i)));
}

void shadeDepthcue(const TmGrid* g) {
  const rsl::Batch b(g);
  const float range = g->clip[1] - g->clip[0];
  if (!(range < 1e20f))
    g->call->report(g->host, g, TM_WARNING, "fades between clipping planes: the scene has no Clipping");
  for (int i : b) {
    const float depth = (b.P(i).z - g->clip[0]) / range;
    const float amount = (depth - mindistance(g, i)) / (maxdistance(g, i) - mindistance(g, i));
    fade(g, i, cueColor(g, i), rsl::clamp(amount, 0, 1));
  }
}
}  // namespace

extern const rsl::Shader fogShader, depthcueShader;
const rsl::Shader fogShader(TM_VOLUME, "fog", "fades to background by 1 - exp(-distance to the eye / distance)", 0,
                            shadeFog, {&distance, &fogColor});
const rsl::Shader depthcueShader(TM_VOLUME, "depthcue", "fades to background linearly in depth", 0, shadeDepthcue,
                                 {&mindistance, &maxdistance, &cueColor});
