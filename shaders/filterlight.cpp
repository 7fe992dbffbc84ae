// Art direction of indirect light: the light of another indirect light, with the falloffs of a spotlight, a preferred
// direction and a colour correction (Tabellion and Lamorlette 2004, section 5.3).
#include "shaders/indirect.h"

namespace {
rsl::StringParam source("source", "", "handle of the indirect light to filter", TM_ROLE_INDIRECT_SOURCE);
rsl::PointParam from("from", {0, 0, 0}, "position");
rsl::PointParam to("to", {0, 0, 1}, "a point on the axis");
rsl::FloatParam coneangle("coneangle", 3.14159265f, "half angle of the cone, radians; pi: everywhere");
rsl::FloatParam conedeltaangle("conedeltaangle", 0, "width of the soft edge inside the cone, radians");
rsl::FloatParam distance("distance", 1e30f, "no light beyond this distance from `from`");
rsl::FloatParam distancedelta("distancedelta", 0, "width of the soft edge inside that distance");
rsl::FloatParam directionality("directionality", 0, "d of eq. 9: favours surfaces that face the filter");
rsl::FloatParam brightness("brightness", 1, "scale");
rsl::FloatParam contrast("contrast", 1, "power of each channel around middle grey (0.18)");
rsl::FloatParam saturation("saturation", 1, "0: grey of the same luminance");
rsl::FloatParam hue("hue", 0, "turns colours around the grey axis; 1 is a full turn, red to green to blue");

constexpr float kPi = 3.14159265f, kMiddleGrey = 0.18f;

/// Is 1 inside, 0 outside, and smooth over `delta` before `end`.
float inside(float x, float end, float delta) { return 1 - rsl::smoothstep(end - delta, end, x); }

float falloff(const rsl::Batch& b, int i, rsl::Vec3 N) {
  const TmGrid* g = b.g;
  const rsl::Vec3 toFilter = from(g, i) - b.P(i), axis = to(g, i) - from(g, i);
  const rsl::Vec3 direction = rsl::normalize(toFilter);
  const float angle = std::acos(rsl::clamp(-rsl::dot(direction, rsl::normalize(axis)), -1, 1));
  const float cone = coneangle(g, i) >= kPi ? 1 : inside(angle, coneangle(g, i), conedeltaangle(g, i));
  // Eq. 9 by the half-angle formula: cos^2(theta / 2) = (1 + cos theta) / 2.
  const float cosine2 = std::max(0.0f, 0.5f * (1 + rsl::dot(N, direction)));
  return cone * inside(rsl::length(toFilter), distance(g, i), distancedelta(g, i)) *
         std::pow(cosine2, 0.5f * directionality(g, i));
}

/// Rodrigues' rotation around (1, 1, 1), which keeps r + g + b.
rsl::Color turnHue(rsl::Color c, float turns) {
  if (turns == 0) return c;
  const float angle = 2 * kPi * turns, cosine = std::cos(angle), sine = std::sin(angle) / std::sqrt(3.0f);
  const float mean = (c.x + c.y + c.z) / 3;
  const rsl::Vec3 grey{mean, mean, mean}, across{c.z - c.y, c.x - c.z, c.y - c.x};
  return grey + cosine * (c - grey) + sine * across;
}

rsl::Color corrected(const TmGrid* g, int i, rsl::Color E) {
  const auto bend = [&](float x) {
    return contrast(g, i) == 1 || x <= 0 ? x : kMiddleGrey * std::pow(x / kMiddleGrey, contrast(g, i));
  };
  const rsl::Color bent = turnHue({bend(E.x), bend(E.y), bend(E.z)}, hue(g, i));
  const float luminance = rsl::dot(bent, {0.2126f, 0.7152f, 0.0722f});
  const rsl::Color c = rsl::mix(rsl::Color{luminance, luminance, luminance}, bent, saturation(g, i));
  return brightness(g, i) * rsl::Color{std::max(0.0f, c.x), std::max(0.0f, c.y), std::max(0.0f, c.z)};
}

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  const Indirect indirect(b);
  for (int i : b) indirect.emit(b, i, falloff(b, i, indirect.Nf[i]) * corrected(g, i, indirect.E[i]));
}
}  // namespace

extern const rsl::Shader filterlightShader;
const rsl::Shader filterlightShader(TM_LIGHT, "filterlight",
                                    "another indirect light, with falloffs and colour correction", TM_LIGHT_INDIRECT,
                                    shade,
                                    {&source, &from, &to, &coneangle, &conedeltaangle, &distance, &distancedelta,
                                     &directionality, &brightness, &contrast, &saturation, &hue});
