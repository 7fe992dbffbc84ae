// A medium that absorbs and scatters light, the same everywhere or as dense as a Volume says. What counts along a ray
// is the amount of medium that it has crossed: density times length. The radiance that a ray brings is the integral of
// M. Pharr, W. Jakob and G. Humphreys, "Physically Based Rendering", 4th edition, section 14.1. Phase function: L.
// Henyey and J. Greenstein, "Diffuse radiation in the galaxy", 1941.
#include <vector>

#include "reyes/shader/shadeops.h"

namespace {
rsl::ColorParam scattering("scattering", {0.1f, 0.1f, 0.1f}, "for each unit of the world (in a Volume: and of density)",
                           TM_ROLE_SCATTERING);
rsl::ColorParam absorption("absorption", {0, 0, 0}, "for each unit of the world (in a Volume: and of density)",
                           TM_ROLE_ABSORPTION);
rsl::FloatParam anisotropy("anisotropy", 0, "mean cosine of the scattering angle: above 0 forwards, below 0 back");
rsl::UniformFloatParam steps("steps", 32, "places of each ray that are lit; powers of two are the least noisy");
rsl::FloatParam lightway("lightway", 0,
                         "greatest length of the way from a lamp over which its light is dimmed; 0: not dimmed");
rsl::StringParam map(
    "map", "",
    "brick map of the fluence, as FOLDER/scene.volume.bkm of --gi atlas --atlas FOLDER: light that was "
    "scattered any number of times, evenly; none: light of lamps that is scattered once");

rsl::Color extinction(const TmGrid* g, int i) { return scattering(g, i) + absorption(g, i); }

rsl::Color passing(rsl::Color extinction, float amount) {
  return {std::exp(-extinction.x * amount), std::exp(-extinction.y * amount), std::exp(-extinction.z * amount)};
}

/// Returns the phase function times pi, as the Cl of a lamp is E/pi.
float phase(float g, float cosine) {
  const float bend = std::max(1 + g * g - 2 * g * cosine, 1e-6f);
  return (1 - g * g) / (4 * bend * std::sqrt(bend));
}

/// Draws amounts along a ray, in proportion to the light that passes in the channel that is dimmed least.
struct ByPassing {
  float whole, rate;  ///< The amount along the whole ray, and the extinction of that channel.

  ByPassing(rsl::Color extinction, float amount)
      : whole(amount), rate(std::min({extinction.x, extinction.y, extinction.z})) {}
  bool isThin() const { return rate * whole < 1e-4f; }
  float at(float share) const {
    return isThin() ? share * whole : -std::log1p(share * std::expm1(-rate * whole)) / rate;
  }
  float density(float amount) const {
    return isThin() ? 1 / whole : rate * std::exp(-rate * amount) / -std::expm1(-rate * whole);
  }
};

/// Draws places along a ray, in proportion to the inverse square of their distance to a lamp. The lamp is `beside` away
/// from the ray, and nearest to it at the distance `nearest` from the eye: C. Kulla and M. Fajardo, "Importance
/// Sampling Techniques for Path Tracing in Participating Media", 2012. Lengths: units of the world.
struct ByLight {
  float beside = 0, nearest = 0, from = 0, to = 0;

  ByLight() = default;
  ByLight(float besideRay, float nearestAt, float rayLength)
      : beside(std::max(besideRay, 1e-5f * rayLength)),
        nearest(nearestAt),
        from(std::atan(-nearest / beside)),
        to(std::atan((rayLength - nearest) / beside)) {}
  float at(float share) const { return nearest + beside * std::tan(from + share * (to - from)); }
  float density(float distance) const {
    const float past = distance - nearest;
    return beside / ((to - from) * (beside * beside + past * past));
  }
};

/// The light that a place of each ray scatters to the eye, for each unit of scattering.
class LightAround {
 public:
  /// `units`: units of the world in one of current space, along each ray.
  LightAround(const rsl::Batch& b, const rsl::Array& units) : b_(b), units_(units), ambient_(b.ambient()) {}

  rsl::Vec3Array at(const rsl::Vec3Array& Q) const { return *map(b_.g) ? ofPhotons(Q) : ofLights(Q); }

 private:
  rsl::Vec3Array ofPhotons(const rsl::Vec3Array& Q) const {
    rsl::Vec3Array out(b_.g);
    const rsl::Vec3Array everywhere(b_.g);
    rsl::Array found(b_.g);
    const TmCloudOptions options = tmCloudDefaults();
    const TmChannel fluence{"fluence", out};
    b_.g->call->texture3d(b_.g->host, b_.g, map(b_.g), &options, Q, everywhere, &fluence, 1, found.data());
    for (int i : b_) out.set(i, found[i] > 0 ? out[i] / (4 * rsl::kPi) : rsl::Color{});
    return out;
  }
  rsl::Vec3Array ofLights(const rsl::Vec3Array& Q) const {
    rsl::Vec3Array out(b_.g);
    for (int i : b_) out.set(i, ambient_[i]);
    TmIlluminance sample = tmIlluminanceDefaults();
    for (sample.P = Q; b_.illuminance(sample);) add(sample, out);
    return out;
  }
  void add(const TmIlluminance& sample, rsl::Vec3Array& out) const {
    const bool isAtInfinity = sample.L.x == sample.direction.x;
    for (int i : b_) {
      if (!sample.lit[i]) continue;
      const float distance = rsl::length(rsl::get(sample.L, i)) * units_[i];
      const float dimmed = isAtInfinity ? lightway(b_.g, i) : std::min(distance, lightway(b_.g, i));
      const float onwards = rsl::dot(rsl::get(sample.direction, i), rsl::normalize(b_.I(i)));
      const rsl::Color arrives = passing(extinction(b_.g, i), dimmed) * rsl::get(sample.Cl, i);
      out.set(i, out[i] + phase(anisotropy(b_.g, i), onwards) * arrives);
    }
  }

  const rsl::Batch& b_;
  const rsl::Array& units_;
  const rsl::Vec3Array ambient_;
};

rsl::Array unitsAlongRays(const rsl::Batch& b) {
  rsl::Vec3Array world(b.g);
  b.g->call->transform(b.g->host, b.g, TM_AS_VECTOR, "current", "world", b.g->I, world);
  rsl::Array out(b.g);
  for (int i : b) out[i] = rsl::length(world[i]) / std::max(rsl::length(b.I(i)), 1e-30f);
  return out;
}

/// One place on the ray of each point (TmServices::crossed).
struct Place {
  rsl::Array distance, amount, density;

  explicit Place(const rsl::Batch& b) : distance(b.g), amount(b.g), density(b.g) {}
  void find(const rsl::Batch& b, bool byAmount) {
    b.g->call->crossed(b.g->host, b.g, byAmount, distance.data(), amount.data(), density.data());
  }
};

/// Chooses places along each ray in several ways, which are weighted by the balance heuristic (Veach and Guibas 1995).
class Places {
 public:
  /// `whole`: the ends of the rays.
  Places(const rsl::Batch& b, const rsl::Array& units, const Place& whole) : b_(b), units_(units), whole_(whole) {
    rsl::Vec3Array middle(b.g);
    for (int i : b) middle.set(i, b.P(i) - 0.5f * b.I(i));
    TmIlluminance sample = tmIlluminanceDefaults();
    int last = -1;
    for (sample.P = middle; lights_.size() < kMostLights && b.illuminance(sample); last = sample.light)
      if (sample.light != last && sample.L.x != sample.direction.x) addLight(sample);
  }

  int kinds() const { return 1 + static_cast<int>(lights_.size()); }
  float rayLength(int i) const { return whole_.distance[i]; }
  /// Finds the places of one kind at these shares.
  void at(int kind, const rsl::Array& share, Place& out) const {
    for (int i : b_)
      if (kind == 0)
        out.amount[i] = std::min(std::max(passing(i).at(share[i]), 0.0f), whole_.amount[i]);
      else
        out.distance[i] = std::min(std::max(light(kind, i).at(share[i]), 0.0f), rayLength(i));
    out.find(b_, kind == 0);
  }
  /// Returns the sum of the densities of all kinds over the distance, for each unit of the medium's density there.
  float density(int i, const Place& at) const {
    float sum = 0;
    for (int kind = 1; kind < kinds(); ++kind) sum += light(kind, i).density(at.distance[i]);
    return passing(i).density(at.amount[i]) + sum / at.density[i];
  }

 private:
  static constexpr size_t kMostLights = 7;

  void addLight(const TmIlluminance& sample) {
    std::vector<ByLight>& of = lights_.emplace_back(static_cast<size_t>(b_.g->count));
    for (int i : b_) {
      const rsl::Vec3 along = rsl::normalize(b_.I(i)), L = rsl::get(sample.L, i);
      const float past = rsl::dot(L, along);
      of[static_cast<size_t>(i)] = {rsl::length(L - past * along) * units_[i], 0.5f * rayLength(i) + past * units_[i],
                                    rayLength(i)};
    }
  }
  ByPassing passing(int i) const { return {extinction(b_.g, i), whole_.amount[i]}; }
  const ByLight& light(int kind, int i) const { return lights_[static_cast<size_t>(kind - 1)][static_cast<size_t>(i)]; }

  const rsl::Batch& b_;
  const rsl::Array& units_;
  const Place& whole_;
  std::vector<std::vector<ByLight>> lights_;  ///< Indexed by kind - 1 and by point.
};

/// Returns the number of lit places of each ray: one for diffuse rays, which come in hundreds and need little each.
int stepsFor(const rsl::Batch& b) {
  rsl::Vec3Array type(b.g);
  constexpr float kDiffuse = 1;
  const bool diffuse = b.g->call->rayInfo(b.g->host, b.g, "type", type) && type[0].x == kDiffuse;
  return diffuse ? 1 : static_cast<int>(steps(b.g));
}

/// Returns the light that each whole ray scatters to the eye.
rsl::Vec3Array scattered(const rsl::Batch& b, const rsl::Array& units, const Place& whole) {
  const LightAround light(b, units);
  const Places places(b, units, whole);
  const int kinds = places.kinds(), each = std::max(1, stepsFor(b) / kinds);
  rsl::Vec3Array sum(b.g), Q(b.g);
  rsl::Array forPassing(b.g), forLights(b.g);
  Place at(b);
  for (int k = 0; k < each * kinds; ++k) {
    const int kind = k % kinds;
    b.g->call->stratified(b.g->host, b.g, k / kinds, each, forPassing.data(), forLights.data());
    places.at(kind, kind == 0 ? forPassing : forLights, at);
    for (int i : b) Q.set(i, b.P(i) - (1 - at.distance[i] / std::max(places.rayLength(i), 1e-30f)) * b.I(i));
    const rsl::Vec3Array here = light.at(Q);
    for (int i : b) {
      if (!(at.density[i] > 0)) continue;
      const float weight = 1 / (static_cast<float>(each) * places.density(i, at));
      sum.set(i, sum[i] + weight * passing(extinction(b.g, i), at.amount[i]) * scattering(b.g, i) * here[i]);
    }
  }
  return sum;
}

void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  const rsl::Array units = unitsAlongRays(b);
  Place whole(b);
  for (int i : b) whole.distance[i] = rsl::length(b.I(i)) * units[i];
  whole.find(b, false);
  const rsl::Vec3Array sum = scattered(b, units, whole);
  for (int i : b) {
    const rsl::Color passed = passing(extinction(g, i), whole.amount[i]);
    rsl::set(g->Ci, i, rsl::get(g->Ci, i) * passed + sum[i]);
    rsl::set(g->Oi, i, rsl::Color{1, 1, 1} - (rsl::Color{1, 1, 1} - rsl::get(g->Oi, i)) * passed);
  }
}
}  // namespace

extern const rsl::Shader mediumShader;
const rsl::Shader mediumShader(TM_VOLUME, "medium", "absorbs and scatters light: air, or what fills a Volume", 0, shade,
                               {&scattering, &absorption, &anisotropy, &steps, &lightway, &map});
