#include "shaders/cone.h"
#include "shaders/shadow.h"

namespace {
rsl::FloatParam intensity("intensity", 1, "scale: the light at distance 1 on the axis", TM_ROLE_SCALE);
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "colour", TM_ROLE_TINT);
rsl::PointParam from("from", {0, 0, 0}, "position", TM_ROLE_POSITION);
rsl::PointParam to("to", {0, 0, 1}, "a point on the axis");
rsl::FloatParam coneangle("coneangle", 0.523598776f, "half angle of the cone, radians");
rsl::FloatParam conedeltaangle("conedeltaangle", 0.0872664626f, "width of the soft edge inside the cone, radians");
rsl::FloatParam beamdistribution("beamdistribution", 2, "exponent of the falloff from the axis");
ShadowParams shadow;

// This is RISpec 3.2 appendix A: illuminate(from, axis, coneangle) with a soft edge.
void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  for (int i : b) {
    const rsl::Vec3 L = from(g, i) - b.P(i), axis = rsl::normalize(to(g, i) - from(g, i));
    const float cosine = -rsl::dot(rsl::normalize(L), axis);
    const ConeShare cone = ConeShare::at(cosine, coneangle(g, i), conedeltaangle(g, i), beamdistribution(g, i));
    if (cone.edge <= 0 || cosine <= 0) {
      b.illuminate(i, L, {});
      continue;
    }
    const float beam = cone.beam / std::max(rsl::dot(L, L), 1e-20f);
    b.illuminate(i, L, intensity(g, i) * cone.edge * beam * lightcolor(g, i));
  }
}

void shadeShadowed(const TmGrid* g) {
  shade(g);
  shadow.dim(rsl::Batch(g), shadow.shadowname(g));
}
}  // namespace

extern const rsl::Shader spotlightShader, shadowspotShader;
const rsl::Shader spotlightShader(TM_LIGHT, "spotlight", "light from a point into a soft-edged cone", TM_LIGHT_BOUNDED,
                                  shade,
                                  {&intensity, &lightcolor, &from, &to, &coneangle, &conedeltaangle,
                                   &beamdistribution});
// The same parameters may serve two shaders at the same places.
const rsl::Shader shadowspotShader(TM_LIGHT, "shadowspot", "spotlight with shadows: traced, or of a shadow map",
                                   TM_LIGHT_BOUNDED, shadeShadowed,
                                   {&intensity, &lightcolor, &from, &to, &coneangle, &conedeltaangle, &beamdistribution,
                                    &shadow.shadowname, &shadow.samples, &shadow.blur, &shadow.width,
                                    &shadow.shadowbias});
