#include "gi/photons/light_photons.h"

#include <numeric>

#include "gi/photons/sky.h"
#include "raytrace/emitters.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr int kProbes = 4;  ///< Number of probes in each cell of a cone.
constexpr int kGrid = 128;  ///< Cells along the side of a distant light's square.
/// Cells where no probe saw light get this share of the brightest cell, so that a beam between the probes is not lost.
constexpr double kFloor = 1e-3;
/// Bias of photons from a point light, which may lie on a surface. It is relative to the radius of the scene plus the
/// distance of its origin from the eye.
constexpr float kPointBias = 1e-5f;
/// Least cosine in the offset of photons that leave area lights. One in 256 leaves at a smaller cosine, and may still
/// meet the lamp's own polygons.
constexpr float kLeastCosine = 1.0f / 16;
constexpr uint32_t kFewSamples = 64;    ///< Number of samples that tell the extent of a light.
constexpr float kSampledMargin = 1.2f;  ///< Factor on that extent, since no sample is the outermost one.

/// Returns the place of a probe in its cell. The four places are the corners of a smaller square.
vec2 probePlace(int probe) { return {probe & 1 ? 0.75f : 0.25f, probe & 2 ? 0.75f : 0.25f}; }

Distribution withFloor(const std::vector<double>& weights) {
  const double floor = kFloor * *std::max_element(weights.begin(), weights.end());
  Distribution out;
  for (const double w : weights) out.add(std::max(w, floor));
  return out;
}

std::vector<vec2> fewSamples() {
  std::vector<vec2> xi;
  for (uint32_t i = 0; i < kFewSamples; ++i) xi.push_back(sobol2(i, randomStream("phot")));
  return xi;
}

}  // namespace

std::unique_ptr<const PhotonSource> photonsOf(int light, const ShadingSystem& shading, const RayScene& rays,
                                              const PhotonTarget& target) {
  switch (shading.light(light).kind()) {
    case LightKind::Point:
      return std::make_unique<PointPhotons>(light, shading, target);
    case LightKind::Distant:
      return std::make_unique<DistantPhotons>(light, shading, target);
    case LightKind::Area:
      return std::make_unique<AreaPhotons>(light, shading, rays, target);
    case LightKind::Sky:
      return std::make_unique<SkyPhotons>(light, shading, rays, target);
    case LightKind::None:
    case LightKind::Ambient:
    case LightKind::Indirect:
      break;
  }
  return nullptr;
}

LightPhotons::LightPhotons(int light, const ShadingSystem& shading, const PhotonTarget& target)
    : light_(light), shading_(shading), center_(target.center()), radius_(target.radius()) {}

void LightPhotons::emit(uint32_t first, uint32_t seed, std::vector<EmittedPhoton>& out) const {
  emitBy(startNumbers(first, hashCombine(seed, static_cast<uint32_t>(light_)), out.size()), out);
}

LightProbe LightPhotons::probeFromCenter(const std::vector<vec2>& xi) const {
  LightProbe probe;
  probe.P.assign(xi.size(), center_);
  probe.N.assign(xi.size(), vec3(0, 0, 1));
  probe.xi = xi;
  shading_.probe(light_, probe);
  return probe;
}

PointPhotons::PointPhotons(int light, const ShadingSystem& shading, const PhotonTarget& target)
    : LightPhotons(light, shading, target) {
  middle_ = probeFromCenter({vec2(0.5f)}).L[0];
  float spread = 0;
  for (const vec3& place : probeFromCenter(fewSamples()).L)
    spread = std::max(spread, kSampledMargin * glm::distance(place, middle_));
  hasExtent_ = spread > 0;
  cone_ = PhotonCone(center_, middle_, radius_ + spread);
  LightProbe probe;
  for (size_t c = 0; c < PhotonCone::kCells; ++c)
    for (int k = 0; k < kProbes; ++k) askAlong(cone_.local(c, probePlace(k)), vec3(0), probe);
  shading_.probe(light_, probe);
  std::vector<double> weights;
  for (size_t c = 0; c < PhotonCone::kCells; ++c) {
    double sum = 0;
    for (size_t k = 0; k < kProbes; ++k) sum += double{luminance(intensity(probe, c * kProbes + k))};
    weights.push_back(sum / kProbes);
    power_ += sum / kProbes * double{kPi} * cone_.cellSolidAngle();
  }
  if (power_ > 0) cells_ = withFloor(weights);
}

void PointPhotons::askAlong(const vec3& local, const vec3& offset, LightProbe& probe) const {
  probe.P.push_back(cone_.place(local, cone_.askingDistance()) + offset);
  probe.N.push_back(-cone_.direction(local));
}

/// Radiant intensity over pi: Cl r^2, where Cl is E/pi at the distance r.
vec3 PointPhotons::intensity(const LightProbe& probe, size_t i) const {
  return probe.Cl[i] * (cone_.askingDistance() * cone_.askingDistance());
}

void PointPhotons::emitBy(const StartNumbers& xi, std::vector<EmittedPhoton>& out) const {
  const auto& [a, b] = xi;
  const LightProbe place = hasExtent_ ? probeFromCenter(b) : LightProbe();
  LightProbe probe;
  probe.xi = b;
  std::vector<double> pdf;
  for (size_t i = 0; i < out.size(); ++i) {
    double x{a[i].x};
    const size_t cell = cells_.pick(x);
    const vec3 local = cone_.local(cell, {static_cast<float>(x), a[i].y}),
               offset = hasExtent_ ? place.L[i] - middle_ : vec3(0);
    Ray& ray = out[i].ray;
    ray = {cone_.place(local, cone_.start()) + offset, cone_.direction(local)};
    ray.bias = kPointBias * (radius_ + glm::length(ray.origin));
    pdf.push_back(cells_.weight(cell) / (cells_.total() * cone_.cellSolidAngle()));
    askAlong(local, offset, probe);
  }
  shading_.probe(light_, probe);
  for (size_t i = 0; i < out.size(); ++i) out[i].power = intensity(probe, i) * kPi / static_cast<float>(pdf[i]);
}

DistantPhotons::DistantPhotons(int light, const ShadingSystem& shading, const PhotonTarget& target)
    : LightPhotons(light, shading, target) {
  const LightProbe probe = directionsFromCenter(fewSamples());
  direction_ = normalizeOr(-std::accumulate(probe.L.begin(), probe.L.end(), vec3(0)), vec3(0, 0, 1));
  // The shadow of a box along any direction of the light lies within `spread` of its shadow along the middle direction
  // (emitBy).
  float spread = 0, brightness = 0;
  for (size_t i = 0; i < kFewSamples; ++i) {
    spread = std::max(spread, kSampledMargin * radius_ * glm::length(probe.L[i] + direction_));
    brightness += luminance(probe.Cl[i]) / kFewSamples;
    hasExtent_ |= probe.L[i] != probe.L[0];
  }
  vec3 tangent, bitangent;
  orthonormalBasis(direction_, tangent, bitangent);
  // Cells in the shadow of some object's box get photons. No photons are sent to where there is nothing.
  std::vector<double> weights(kGrid * kGrid, 0.0);
  const auto cellAt = [&](float along) {
    return std::clamp(static_cast<int>((along / radius_ + 1) * 0.5f * kGrid), 0, kGrid - 1);
  };
  for (const Bound3& b : target.patchBounds) {
    Bound2 shadow;
    for (int k = 0; k < 8; ++k) {
      const vec3 off = b.corner(k) - center_;
      shadow.extend(vec2(dot(off, tangent), dot(off, bitangent)));
    }
    const int left = cellAt(shadow.lo.x - spread), right = cellAt(shadow.hi.x + spread);
    for (int y = cellAt(shadow.lo.y - spread); y <= cellAt(shadow.hi.y + spread); ++y)
      std::fill_n(weights.begin() + y * kGrid + left, right - left + 1, 1.0);
  }
  for (const double w : weights) cells_.add(w);
  const double cellArea = std::pow(2 * double{radius_} / kGrid, 2);
  power_ = double{brightness} * double{kPi} * cellArea * cells_.total();
}

LightProbe DistantPhotons::directionsFromCenter(const std::vector<vec2>& xi) const {
  LightProbe probe = probeFromCenter(xi);
  for (vec3& L : probe.L) L = normalizeOr(L, vec3(0, 0, -1));
  return probe;
}

void DistantPhotons::emitBy(const StartNumbers& xi, std::vector<EmittedPhoton>& out) const {
  const auto& [a, b] = xi;
  vec3 tangent, bitangent;
  orthonormalBasis(direction_, tangent, bitangent);
  const LightProbe sun = hasExtent_ ? directionsFromCenter(b) : LightProbe();
  LightProbe probe;
  probe.xi = b;
  const float side = 2 * radius_ / kGrid;
  for (size_t i = 0; i < out.size(); ++i) {
    double x{a[i].x};
    const size_t cell = cells_.pick(x);
    const vec2 at = side * vec2(static_cast<float>(cell % kGrid) + static_cast<float>(x),
                                static_cast<float>(cell / kGrid) + a[i].y) -
                    vec2(radius_);
    // The square turns with the direction, by the least rotation, so that each shadow moves by less than the direction
    // does.
    const vec3 d = hasExtent_ ? -sun.L[i] : direction_, across = at.x * tangent + at.y * bitangent;
    const vec3 turned = across - dot(across, d) / std::max(1 + dot(direction_, d), 1e-6f) * (direction_ + d);
    out[i].ray = {center_ + turned - kOutside * radius_ * d, d};
    probe.P.push_back(out[i].ray.origin);
    probe.N.push_back(-d);
  }
  shading_.probe(light_, probe);
  const float area = side * side * static_cast<float>(cells_.total());
  for (size_t i = 0; i < out.size(); ++i) out[i].power = probe.Cl[i] * kPi * area;
}

AreaPhotons::AreaPhotons(int light, const ShadingSystem& shading, const RayScene& rays, const PhotonTarget& target)
    : LightPhotons(light, shading, target), rays_(rays) {
  std::vector<EmittedPhoton> photons(256);
  emit(0, 0, photons);
  for (const EmittedPhoton& p : photons) power_ += double{luminance(p.power)} / static_cast<double>(photons.size());
}

void AreaPhotons::emitBy(const StartNumbers& xi, std::vector<EmittedPhoton>& out) const {
  const auto& [a, b] = xi;
  const size_t n = out.size();
  std::vector<float> xi0(n), xi1(n), area(n), place[3], normal[3];
  for (auto* v : {place, normal})
    for (int k = 0; k < 3; ++k) v[k].resize(n);
  for (size_t i = 0; i < n; ++i) {
    xi0[i] = a[i].x;
    xi1[i] = a[i].y;
  }
  const TmVec3 P{place[0].data(), place[1].data(), place[2].data()},
      N{normal[0].data(), normal[1].data(), normal[2].data()};
  std::vector<int> group(n);
  if (!rays_.emitters().sample(light_, static_cast<int>(n), xi0.data(), xi1.data(), P, N, area.data(), group.data())) {
    std::fill(out.begin(), out.end(), EmittedPhoton{});
    return;
  }
  const bool allRound = shading_.light(light_).shinesAllRound();
  std::vector<vec3> directions(n);
  std::vector<vec2> onSide(b.begin(), b.end());
  for (size_t i = 0; allRound && i < n; ++i) onSide[i].x = b[i].x < 0.5f ? 2 * b[i].x : 2 * b[i].x - 1;
  cosineHemispheres(onSide, directions);
  LightProbe probe;
  for (auto* v : {&probe.P, &probe.N, &probe.Pl, &probe.Nl}) v->reserve(n);
  for (size_t i = 0; i < n; ++i) {
    const vec3 front(N.x[i], N.y[i], N.z[i]), &local = directions[i], Nl = allRound && b[i].x < 0.5f ? -front : front;
    vec3 tangent, bitangent;
    orthonormalBasis(Nl, tangent, bitangent);
    Ray& ray = out[i].ray;
    ray.origin = vec3(P.x[i], P.y[i], P.z[i]);
    ray.direction = local.x * tangent + local.y * bitangent + local.z * Nl;
    // The polygons that rays see may lie before the surface that shines.
    rays_.prepareOrigin(group[i], ray.origin, 0, ray);
    ray.offset /= std::max(local.z, kLeastCosine);
    out[i].normal = Nl;
    out[i].passesLamp = allRound;
    probe.Pl.push_back(ray.origin);
    probe.Nl.push_back(front);
    probe.P.push_back(ray.origin + ray.direction);
    probe.N.push_back(-ray.direction);
  }
  shading_.probe(light_, probe);
  // A Lambertian emitter of radiance L sends pi L from each unit of area, and from each side that shines.
  const float sides = allRound ? 2.0f : 1.0f;
  for (size_t i = 0; i < n; ++i) out[i].power = probe.Cl[i] * kPi * (sides * area[i]);
}

}  // namespace tomales
