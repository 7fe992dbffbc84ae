// One shader of each of the other kinds, the least that it takes. docs/shader_writing.md explains them.
#include <reyes/shader.h>

namespace {

// A displacement moves P and renews N.
rsl::FloatParam height("height", 0.1f, "of the waves"), waves("waves", 10, "for each unit of s");
void shadeRipple(const TmGrid* g) {
  const rsl::Batch b(g);
  rsl::Array amount(g);
  for (int i : b) amount[i] = height(g, i) * std::sin(6.2831853f * waves(g, i) * g->s[i]);
  b.displace(amount);
}
const rsl::Shader ripple(TM_DISPLACEMENT, "ripple", "waves along s; bound: height", 0, shadeRipple, {&height, &waves});

// A light sends Cl along L, which goes to the light. Its outputs can be read by surfaces (RSL lightsource()).
rsl::FloatParam intensity("intensity", 1, "scale"), flicker("flicker", 0.5f, "depth of the flicker");
rsl::PointParam from("from", {0, 0, 0}, "position");
rsl::FloatOutput dimmed("dimmed", "how much the flicker takes away");
void shadeFlame(const TmGrid* g) {
  const rsl::Batch b(g);
  for (int i : b) {
    const rsl::Vec3 L = from(g, i) - b.P(i);
    const float lost = flicker(g, i) * rsl::noise(rsl::Vec3{10 * g->time, 0.5f, 0.5f});
    if (dimmed.wanted(g)) dimmed.set(g, i, lost);
    b.illuminate(i, L, intensity(g, i) * (1 - lost) / std::max(rsl::dot(L, L), 1e-20f) * rsl::Color{1, 0.7f, 0.3f});
  }
}
const rsl::Shader flame(TM_LIGHT, "flame", "a point light that flickers with time", 0, shadeFlame,
                        {&intensity, &flicker, &from, &dimmed});

// An area light writes the radiance that its geometry sends along L; the camera sees the same. Roles tell the renderer
// which parameter is the number of samples, and which hides the lamp.
rsl::FloatParam radiance("radiance", 1, "straight ahead"), focus("focus", 1, "power of the cosine to the side");
rsl::FloatParam points("points", 16, "on the lamp for each shaded point", TM_ROLE_SAMPLES),
    glows("glows", 1, "0: the camera and mirrors do not see the lamp", TM_ROLE_VISIBLE);
void shadePanel(const TmGrid* g) {
  for (int i : rsl::Batch(g)) {
    const float cosine = -rsl::dot(rsl::normalize(rsl::get(g->L, i)), rsl::get(g->Nl, i));
    const float share = std::pow(std::max(cosine, 0.0f), focus(g, i));
    rsl::set(g->Cl, i, radiance(g, i) * share * rsl::Color{1, 1, 1});
  }
}
const rsl::Shader panel(TM_LIGHT, "panel", "a lamp that is brighter from the front", TM_LIGHT_AREA | TM_LIGHT_SHADOWED,
                        shadePanel, {&radiance, &focus, &points, &glows});

// A volume changes Ci and Oi of what is seen along I.
rsl::FloatParam extinction("extinction", 0.1f, "share lost for each unit of length, at first");
void shadeMurk(const TmGrid* g) {
  const rsl::Batch b(g);
  for (int i : b) {
    const float clear = std::exp(-extinction(g, i) * rsl::length(b.I(i)));
    rsl::set(g->Ci, i, clear * rsl::get(g->Ci, i));
    rsl::set(g->Oi, i, rsl::mix(rsl::Color{1, 1, 1}, rsl::get(g->Oi, i), clear));
  }
}
const rsl::Shader murk(TM_VOLUME, "murk", "dark air", 0, shadeMurk, {&extinction});

// An imager changes Ci and alpha of pixels; P is the place in the picture.
rsl::FloatParam strength("strength", 0.5f, "how much darker the lines are");
void shadeScanlines(const TmGrid* g) {
  for (int i : rsl::Batch(g))
    if (static_cast<int>(g->P.y[i]) % 2) rsl::set(g->Ci, i, (1 - strength(g, i)) * rsl::get(g->Ci, i));
}
const rsl::Shader scanlines(TM_IMAGER, "scanlines", "every other row darker", 0, shadeScanlines, {&strength});

}  // namespace

TM_SHADER_LIBRARY(ripple, flame, panel, murk, scanlines)
