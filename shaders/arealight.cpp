#include "reyes/shader.h"
#include "shaders/cone.h"

namespace {
rsl::FloatParam intensity("intensity", 1, "scale", TM_ROLE_SCALE);
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "radiance that the geometry emits from the side of its normal",
                           TM_ROLE_TINT);
rsl::FloatParam area(
    "area", 0,
    "0: intensity is a scale of radiance. Else the area of the geometry: a point at the distance d gets "
    "intensity / d^2, however large the geometry is (BMRT)",
    TM_ROLE_AREA);
rsl::FloatParam coneangle("coneangle", rsl::kPi, "half angle of the cone that it shines into, radians; pi: everywhere");
rsl::VectorParam axis("axis", {0, 0, 1}, "axis of the cone");
rsl::FloatParam conedeltaangle("conedeltaangle", 0, "width of the soft edge inside the cone, radians");
rsl::FloatParam beamdistribution("beamdistribution", 0, "exponent of the falloff from the axis of the cone");
rsl::FloatParam samples("samples", 16, "points on the emitter for each shaded point", TM_ROLE_SAMPLES);
rsl::FloatParam visible("visible", 1, "0: camera and specular rays do not see it glow", TM_ROLE_VISIBLE);

/// Returns the share of the light that leaves towards the point; 1 without a cone.
float share(const TmGrid* g, int i) {
  if (coneangle(g, i) >= rsl::kPi) return 1;
  const float cosine = -rsl::dot(rsl::normalize(rsl::get(g->L, i)), rsl::normalize(axis(g, i)));
  const ConeShare cone = ConeShare::at(cosine, coneangle(g, i), conedeltaangle(g, i), beamdistribution(g, i));
  return cone.edge * cone.beam;
}

void shade(const TmGrid* g) {
  for (int i : rsl::Batch(g)) {
    const float spread = area(g, i) > 0 ? rsl::kPi / area(g, i) : 1;
    rsl::set(g->Cl, i, share(g, i) * spread * intensity(g, i) * lightcolor(g, i));
  }
}
}  // namespace

extern const rsl::Shader arealightShader;
const rsl::Shader arealightShader(TM_LIGHT, "arealight", "geometry that emits light; use with AreaLightSource",
                                  TM_LIGHT_AREA | TM_LIGHT_SHADOWED | TM_LIGHT_BOUNDED, shade,
                                  {&intensity, &lightcolor, &area, &samples, &visible, &coneangle, &axis,
                                   &conedeltaangle, &beamdistribution});
