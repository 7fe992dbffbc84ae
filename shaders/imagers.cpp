// The imagers background and clamptoalpha (RISpec 3.2, appendix A; PRMan).
#include "reyes/shader.h"

namespace {
rsl::ColorParam background("background", {1, 1, 1}, "colour behind everything");
rsl::ColorParam bgcolor("bgcolor", {1, 1, 1}, "other name of background; all multiply");
rsl::ColorParam color("color", {1, 1, 1}, "other name of background; all multiply");
rsl::FloatParam opacity("alpha", 1, "alpha behind everything; the colour is the same");

void shadeBackground(const TmGrid* g) {
  for (int i : rsl::Batch(g)) {
    const rsl::Color behind = background(g, i) * bgcolor(g, i) * color(g, i);
    const float alpha = opacity(g, i);
    const rsl::Color Oi = rsl::get(g->Oi, i);
    rsl::set(g->Ci, i, rsl::get(g->Ci, i) + (1 - g->alpha[i]) * behind);
    rsl::set(g->Oi, i, alpha == 1 ? rsl::Color{1, 1, 1} : Oi + alpha * (rsl::Color{1, 1, 1} - Oi));
    g->alpha[i] = alpha == 1 ? 1 : g->alpha[i] + alpha * (1 - g->alpha[i]);
  }
}

void shadeClamp(const TmGrid* g) {
  for (int i : rsl::Batch(g)) {
    const rsl::Color c = rsl::get(g->Ci, i);
    const float alpha = g->alpha[i];
    rsl::set(g->Ci, i, {std::min(c.x, alpha), std::min(c.y, alpha), std::min(c.z, alpha)});
  }
}
}  // namespace

extern const rsl::Shader backgroundShader, clamptoalphaShader;
const rsl::Shader backgroundShader(TM_IMAGER, "background", "a colour behind everything, alpha 1", 0, shadeBackground,
                                   {&background, &bgcolor, &color, &opacity});
const rsl::Shader clamptoalphaShader(TM_IMAGER, "clamptoalpha", "no colour above alpha", 0, shadeClamp, {});
