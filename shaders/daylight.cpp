// Sun and sky: A. J. Preetham, P. Shirley and B. Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999.
// Equations have the paper's numbers, and coefficients are from its appendix. Differences: sunlight is computed at one
// wavelength each for red, green and blue; ozone, gases and water vapour, which absorb some per cent, are left out.
#include "reyes/shader.h"

namespace {
rsl::FloatParam intensity("intensity", 1, "scale; at 1 white paper in the sun has a radiance near 1", TM_ROLE_SCALE);
rsl::ColorParam lightcolor("lightcolor", {1, 1, 1}, "tint", TM_ROLE_TINT);
rsl::VectorParam sundirection("sundirection", {0, 1, 0}, "towards the sun");
rsl::VectorParam zenith("zenith", {0, 1, 0}, "up");
rsl::FloatParam turbidity("turbidity", 2, "haziness, 1.7 to 10");
rsl::FloatParam skySamples("samples", 64, "directions for each shaded point", TM_ROLE_SAMPLES);
rsl::FloatParam visible("visible", 1, "0: specular rays do not see it", TM_ROLE_VISIBLE);
rsl::StringParam portals("portals", "", "CoordinateSystems whose unit squares are windows that the sky shines through",
                         TM_ROLE_SKY_PORTALS);
rsl::FloatParam sunSamples("samples", 8, "directions for each shaded point", TM_ROLE_SAMPLES);
rsl::FloatParam sunsize("sunsize", 1, "scale of the sun's diameter of 0.53 degrees; its light stays");

constexpr float kUnit_kcd_m2 = 30;      // a radiance of 1
constexpr float kSolar_klx = 127.5f;    // above the atmosphere (IES Lighting Handbook)
constexpr float kSunRadius = 0.00465f;  // radians
constexpr float kDegrees = 57.29578f;

struct Heaven {
  rsl::Vec3 up, sun;
  float T, sunAngle;  // turbidity; the sun's angle from the zenith in radians

  Heaven(const TmGrid* g, int i)
      : up(rsl::normalize(zenith(g, i))),
        sun(rsl::normalize(sundirection(g, i))),
        T(rsl::clamp(turbidity(g, i), 1.7f, 10.0f)),
        sunAngle(std::acos(rsl::clamp(dot(up, sun), -1.0f, 1.0f))) {}
  bool isDay() const { return dot(up, sun) > 0; }
};

/// The distribution of Perez, Seals and Michalsky (1993), eq. 3.
struct Perez {
  float A, B, C, D, E;
  float operator()(float cosTheta, float gamma) const {
    const float c = std::cos(gamma);
    return (1 + A * std::exp(B / std::max(cosTheta, 1e-3f))) * (1 + C * std::exp(D * gamma) + E * c * c);
  }
};

struct SkyColor {
  Perez perez[3];   // of Y, x and y
  float zenith[3];  // divided by perez(1, sunAngle)

  explicit SkyColor(const Heaven& h) {
    const float T = h.T, t = h.sunAngle, t2 = t * t, t3 = t2 * t;
    perez[0] = {0.1787f * T - 1.4630f, -0.3554f * T + 0.4275f, -0.0227f * T + 5.3251f, 0.1206f * T - 2.5771f,
                -0.0670f * T + 0.3703f};
    perez[1] = {-0.0193f * T - 0.2592f, -0.0665f * T + 0.0008f, -0.0004f * T + 0.2125f, -0.0641f * T - 0.8989f,
                -0.0033f * T + 0.0452f};
    perez[2] = {-0.0167f * T - 0.2608f, -0.0950f * T + 0.0092f, -0.0079f * T + 0.2102f, -0.0441f * T - 1.6537f,
                -0.0109f * T + 0.0529f};
    const float chi = (4 / 9.0f - T / 120) * (3.14159265f - 2 * t);
    zenith[0] = std::max(0.0f, (4.0453f * T - 4.9710f) * std::tan(chi) - 0.2155f * T + 2.4192f);  // kcd/m2
    zenith[1] = T * T * (0.00166f * t3 - 0.00375f * t2 + 0.00209f * t) +
                T * (-0.02903f * t3 + 0.06377f * t2 - 0.03202f * t + 0.00394f) +
                (0.11693f * t3 - 0.21196f * t2 + 0.06052f * t + 0.25886f);
    zenith[2] = T * T * (0.00275f * t3 - 0.00610f * t2 + 0.00317f * t) +
                T * (-0.04214f * t3 + 0.08970f * t2 - 0.04153f * t + 0.00516f) +
                (0.15346f * t3 - 0.26756f * t2 + 0.06670f * t + 0.26688f);
    for (int k = 0; k < 3; ++k) zenith[k] /= perez[k](1, t);
  }

  /// Returns linear Rec. 709 in kcd/m2 (eq. 4).
  rsl::Color operator()(float cosTheta, float gamma) const {
    const float Y = zenith[0] * perez[0](cosTheta, gamma), x = zenith[1] * perez[1](cosTheta, gamma),
                y = zenith[2] * perez[2](cosTheta, gamma);
    const float X = x / y * Y, Z = (1 - x - y) / y * Y;
    return {std::max(0.0f, 3.2406f * X - 1.5372f * Y - 0.4986f * Z),
            std::max(0.0f, -0.9689f * X + 1.8758f * Y + 0.0415f * Z),
            std::max(0.0f, 0.0557f * X - 0.2040f * Y + 1.0570f * Z)};
  }
};

void shadeSky(const TmGrid* g) {
  const rsl::Batch b(g);
  const Heaven h(g, 0);
  const SkyColor color(h);
  for (int i : b) {
    const rsl::Vec3 L = rsl::normalize(rsl::get(g->L, i));
    const float cosTheta = dot(L, h.up), gamma = std::acos(rsl::clamp(dot(L, h.sun), -1.0f, 1.0f));
    const bool seen = h.isDay() && cosTheta > 0;
    rsl::set(g->Cl, i,
             seen ? intensity(g, i) / kUnit_kcd_m2 * lightcolor(g, i) * color(cosTheta, gamma) : rsl::Color{});
  }
}

/// Returns the share of the sun's light that passes the atmosphere (appendix 1: air mass, Rayleigh scattering,
/// aerosols).
rsl::Color passing(const Heaven& h) {
  const float mass = 1 / (std::cos(h.sunAngle) + 0.15f * std::pow(93.885f - h.sunAngle * kDegrees, -1.253f));
  const float beta = 0.04608f * h.T - 0.04586f;
  const auto at = [&](float wavelength_um) {
    return std::exp(-0.008735f * std::pow(wavelength_um, -4.08f) * mass) *
           std::exp(-beta * std::pow(wavelength_um, -1.3f) * mass);
  };
  return {at(0.610f), at(0.550f), at(0.465f)};
}

void shadeSun(const TmGrid* g) {
  const rsl::Batch b(g);
  const Heaven h(g, 0);
  const rsl::Color light = h.isDay() ? kSolar_klx / (3.14159265f * kUnit_kcd_m2) * passing(h) : rsl::Color{};
  const rsl::Vec3 side =
                      rsl::normalize(cross(std::abs(h.sun.x) < 0.9f ? rsl::Vec3{1, 0, 0} : rsl::Vec3{0, 1, 0}, h.sun)),
                  other = cross(h.sun, side);
  for (int i : b) {
    const float r = std::tan(std::min(kSunRadius * sunsize(g, i), 1.5f)) * std::sqrt(g->xi0[i]),
                phi = 6.2831853f * g->xi1[i];
    rsl::set(g->L, i, rsl::normalize(h.sun + r * (std::cos(phi) * side + std::sin(phi) * other)));
    rsl::set(g->Cl, i, intensity(g, i) / static_cast<float>(g->samples) * lightcolor(g, i) * light);
  }
}
}  // namespace

extern const rsl::Shader daylightShader, sunlightShader;
const rsl::Shader daylightShader(TM_LIGHT, "daylight", "a clear sky by the place of the sun, without the sun itself",
                                 TM_LIGHT_SOLAR | TM_LIGHT_SHADOWED | TM_LIGHT_SKY, shadeSky,
                                 {&intensity, &lightcolor, &sundirection, &zenith, &turbidity, &skySamples, &visible,
                                  &portals});
const rsl::Shader sunlightShader(TM_LIGHT, "sunlight", "the sun behind its atmosphere: red when it is low",
                                 TM_LIGHT_SOLAR | TM_LIGHT_SHADOWED | TM_LIGHT_SAMPLED, shadeSun,
                                 {&intensity, &lightcolor, &sundirection, &zenith, &turbidity, &sunSamples, &sunsize});
