#include "gi/photons/irradiance.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "gi/photons/tree.h"
#include "reyes/base/check.h"
#include "reyes/base/parallel.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

// Chance alone moves the centroid of 50 photons by 0.09 radii on average. Between these distances, in radii, the
// correction for a border sets in gradually.
constexpr float kChanceEnds = 0.18f, kBorderBegins = 0.34f;
/// Radius of a disk over that of a disk with the area that it stands for. With this factor, random disks leave few
/// gaps.
constexpr float kOverlap = 1.6f;
constexpr size_t kVeryFew = 16;  ///< An estimate of fewer is uncertain by a quarter.
constexpr size_t kFew = 8;       ///< Fewer photons do not show how far apart they are.
/// Chance alone brings the nearest eight of 50 this much closer once in a thousand times. Radii that follow chance make
/// bricks finer than the data.
constexpr float kMuchCloser = 0.5f;
constexpr float kMostOfMap = 0.05f;
/// One estimate in this many is looked up in the picture. So are all that have very few photons, because a dark room
/// has few estimates.
constexpr int kEstimatesPerShown = 16;

/// Returns a circular segment of half angle theta: its area over pi, and the distance of its centroid, in radii.
vec2 segment(float theta) {
  const float area = theta - std::sin(theta) * std::cos(theta), s = std::sin(theta);
  return {area / kPi, area > 0 ? 2 * s * s * s / (3 * area) : 1.0f};
}

constexpr float kNotByChance = 3;   ///< Standard deviations of the share of photons in a part of the disk.
constexpr float kMuchBent = 0.95f;  ///< Length of the mean normal: a hemisphere's within 60 degrees has 3/4.

struct Estimate {
  vec3 irradiance{0.0f};
  float radius = 0;                ///< 0 if no estimate was made.
  bool few = false, bent = false;  ///< The same facts as in EstimateFigures.
  bool veryFew = false;
  float clump = 1;
  bool acrossWalls = false;
};

PictureShare times(double factor, const PictureShare& s) { return {factor * s.pixels, factor * s.x, factor * s.y}; }

/// Returns the radius of the disk that stands for `every` of `count` photons on an area.
float diskRadius(float area, size_t count, int every) {
  return kOverlap *
         std::sqrt(area * static_cast<float>(every) / (kPi * static_cast<float>(std::max<size_t>(count, 1))));
}

/// Returns the radius by the nearest few alone: where photons are rare, the farther ones lie on other surfaces, and the
/// disk must not reach there. Pre: sorted.
float nearRadius(const std::vector<NearPhoton>& photons, int every) {
  const size_t few = std::min(photons.size(), std::max(kFew, 2 * static_cast<size_t>(every)));
  return diskRadius(kPi * photons[few - 1].distance2, few, every);
}

/// Returns the clumping of one estimate, EstimateFigures::clumps. The farthest of the few, the farthest of all
/// (`inside` excludes it) and the photon at the middle do not count. Pre: sorted.
float clumpOf(const std::vector<NearPhoton>& photons, float area, size_t inside) {
  if (photons.size() <= kFew || !(photons[kFew - 1].distance2 > 0)) return 1;
  return static_cast<float>(kFew - 2) / (kPi * photons[kFew - 1].distance2) * area / static_cast<float>(inside - 1);
}

/// Tells whether walls that stand on the surface separate more light from less: the share of light behind them then
/// differs from the share of area there.
bool isAcrossWalls(const PhotonTree& tree, int power, uint32_t at, std::span<const NearPhoton> photons, float radius,
                   const SightAlongSurface& sight) {
  const vec3 P = tree.position(at), N = tree.normal(at);
  const SightLines lines = sight(P, N, radius);
  SightLines ends;  // each sector ends with the shorter of its two lines
  float seen = 0;
  for (size_t k = 0; k < kSightLines; ++k) {
    ends[k] = std::min(lines[k], lines[(k + 1) % kSightLines]);
    seen += ends[k] * ends[k] / (kSightLines * radius * radius);
  }
  if (seen >= 1) return false;
  vec3 tangent, bitangent;
  orthonormalBasis(N, tangent, bitangent);
  float behind = 0, all = 0;
  for (const NearPhoton& photon : photons) {
    const vec3 off = tree.position(photon.photon) - P;
    const float turn = std::atan2(dot(off, bitangent), dot(off, tangent)) / (2 * kPi);
    const auto sector = static_cast<size_t>((turn < 0 ? turn + 1 : turn) * kSightLines) % kSightLines;
    const float* w = tree.photons().at(photon.photon) + power;
    const float light = luminance({w[0], w[1], w[2]});
    all += light;
    if (glm::length(off) > ends[sector]) behind += light;
  }
  const float chance = std::sqrt(seen * (1 - seen) / static_cast<float>(photons.size()));
  return std::abs(behind / all - (1 - seen)) > kNotByChance * chance;
}

/// Sums over the photons inside the disk or the ball of an estimate.
struct NearSums {
  /// The farthest photon gives the radius and does not count: a disk that just excludes the n-th has n - 1 inside.
  /// Where there are very few photons, two that happen to be close would shine, so the disk has the greatest radius.
  bool byFarthest = false;
  size_t inside = 0;                             ///< Number of photons.
  vec3 power{0.0f}, offset{0.0f}, normal{0.0f};  ///< offset: from the place of the estimate.
};

/// Finds the nearest photons, sorts them and sums those inside. N, surface: as in PhotonTree::nearest().
NearSums sumNear(const PhotonTree& tree, int power, uint32_t at, const vec3& N, int surface,
                 const PhotonIrradianceSettings& settings, std::vector<NearPhoton>& near) {
  const vec3 P = tree.position(at);
  const auto most = static_cast<size_t>(settings.nearest);
  tree.nearest(P, N, surface, most, settings.maxRadius, near);
  NearSums out;
  out.byFarthest = near.size() >= std::min(kFew, most);
  out.inside = near.size() - out.byFarthest;
  std::sort(near.begin(), near.end());  // sums are in the order of distance, which does not depend on threads
  for (size_t i = 0; i < out.inside; ++i) {
    const float* w = tree.photons().at(near[i].photon) + power;
    out.power += vec3(w[0], w[1], w[2]);
    out.offset += tree.position(near[i].photon) - P;
    out.normal += tree.normal(near[i].photon);
  }
  return out;
}

Estimate estimate(const PhotonTree& tree, int power, uint32_t at, const PhotonIrradianceSettings& settings,
                  const SightAlongSurface& sight, std::vector<NearPhoton>& near) {
  const vec3 N = tree.normal(at);
  const auto most = static_cast<size_t>(settings.nearest);
  const NearSums sums = sumNear(tree, power, at, N, tree.surface(at), settings, near);
  const float r2 = sums.byFarthest ? near.back().distance2 : settings.maxRadius * settings.maxRadius;
  if (!(r2 > 0)) return {vec3(0.0f), 0};
  const float count = static_cast<float>(std::max<size_t>(sums.inside, 1));
  const vec3 centroid = sums.offset / count;
  const float distance = glm::length(centroid - dot(centroid, N) * N) / std::sqrt(r2);
  const float belief = glm::smoothstep(kChanceEnds, kBorderBegins, distance);
  const float covered = glm::mix(1.0f, coveredShare(distance), belief), area = kPi * r2 * covered;
  const float wide = diskRadius(area, sums.inside, settings.every), close = nearRadius(near, settings.every);
  const float reach = std::sqrt(r2);
  const bool across = sight && isAcrossWalls(tree, power, at, std::span(near).first(sums.inside), reach, sight);
  // Photons behind a wall do not tell how far apart those before it are. So the disk of an estimate across a wall is as
  // wide as the search.
  return {sums.power / area,
          across                       ? reach
          : close < kMuchCloser * wide ? close
                                       : wide,
          near.size() < most,
          glm::length(sums.normal) < kMuchBent * count,
          near.size() < std::min(kVeryFew, most),
          clumpOf(near, area, sums.inside),
          across};
}

/// Does the same as estimate(), for a ball in a medium.
Estimate estimateInMedium(const PhotonTree& tree, int power, uint32_t at, const PhotonIrradianceSettings& settings,
                          std::vector<NearPhoton>& near) {
  const NearSums sums = sumNear(tree, power, at, vec3(0), 0, settings, near);
  const float r = sums.byFarthest ? std::sqrt(near.back().distance2) : settings.maxRadius;
  if (!(r > 0)) return {vec3(0.0f), 0};
  const float count = static_cast<float>(std::max<size_t>(sums.inside, 1)),
              distance = glm::length(sums.offset) / (count * r);
  const float covered =
      glm::mix(1.0f, coveredShareOfBall(distance), glm::smoothstep(kChanceEnds, kBorderBegins, distance));
  const float volume = 4.0f / 3 * kPi * r * r * r * covered;
  return {sums.power / volume, kOverlap * r * std::cbrt(covered * static_cast<float>(settings.every) / count)};
}

}  // namespace

void requirePhotons(const PointFile& file) {
  if (offsetOf(file.channels(), kPower, 3) < 0 && offsetOf(file.channels(), kIndirectPower, 3) < 0)
    throw FileError(fmt::format("\"{}\" is no photon map: it has no channel \"power\" of three floats", file.path()));
}

float coveredShareOfBall(float centroidDistance) {
  // a: height of the plane over the centre, in radii. The centroid moves outwards as less of the ball is left.
  float lo = -1, hi = 1, share = 1;
  for (int i = 0; i < 24; ++i) {
    const float a = 0.5f * (lo + hi), circle = 1 - a * a;
    share = 1 - 0.25f * (1 - a) * (1 - a) * (2 + a);
    (share > 0 && 0.1875f * circle * circle / share < centroidDistance ? hi : lo) = a;
  }
  return share;
}

float coveredShare(float centroidDistance) {
  float lo = 0, hi = kPi;  // the centroid moves inwards as the segment grows
  for (int i = 0; i < 24; ++i) {
    const float middle = 0.5f * (lo + hi);
    (segment(middle).y > centroidDistance ? lo : hi) = middle;
  }
  return segment(hi).x;
}

float reachOf(const PhotonIrradianceSettings& settings, const Bound3& map) {
  return settings.maxRadius > 0 || map.empty() ? settings.maxRadius : kMostOfMap * glm::length(map.size());
}

std::vector<CloudChannel> irradianceChannels(const std::vector<CloudChannel>& photons) {
  const auto has = [&](const char* power) { return offsetOf(photons, power, 3) >= 0; };
  std::vector<CloudChannel> out{{has(kPathPower)       ? "fluence"
                                 : has(kIndirectPower) ? kIndirectIrradiance
                                                       : kIrradiance,
                                 3}};
  if (tellsSurfaces(photons)) out.push_back(kSurfaceChannel);
  return out;
}

PointCloud estimateIrradiance(PointCloud photons, const PhotonIrradianceSettings& given,
                              const std::function<bool(const vec3& P)>& wanted, EstimateFigures* figures,
                              const SightAlongSurface& sight, const ShownDisk& shown) {
  PhotonIrradianceSettings settings = given;
  settings.maxRadius = reachOf(given, photons.bound());
  PointCloud out;
  out.channels = irradianceChannels(photons.channels);
  if (photons.count() == 0) return out;
  const bool inMedia = offsetOf(photons.channels, kPathPower, 3) >= 0;
  const int power = powerOffset(photons.channels);
  CHECK_GE(power, 0);
  const PhotonTree tree(std::move(photons));
  const auto every = static_cast<size_t>(std::max(1, settings.every));
  const size_t count = (tree.photons().count() + every - 1) / every;
  std::vector<Estimate> estimates(count);
  parallelFor(count, PhotonTree::kLookupsPerTask, [&](size_t begin, size_t end) {
    throwIfStopped();
    std::vector<NearPhoton> near;
    for (size_t i = begin; i < end; ++i) {
      const auto at = static_cast<uint32_t>(i * every);
      if (!wanted || wanted(tree.position(at)))
        estimates[i] = inMedia ? estimateInMedium(tree, power, at, settings, near)
                               : estimate(tree, power, at, settings, sight, near);
    }
  });
  out.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const auto at = static_cast<uint32_t>(i * every);
    const Estimate& e = estimates[i];
    if (!(e.radius > 0)) continue;
    const vec3& E = e.irradiance;
    const std::array values{E.x, E.y, E.z, static_cast<float>(e.acrossWalls ? kAcrossWalls : tree.surface(at))};
    out.add(tree.position(at), tree.normal(at), e.radius, values.data());
    if (!figures || inMedia) continue;
    PictureShare share;
    if (shown && (e.veryFew || i % size_t{kEstimatesPerShown} == 0))
      share = shown(tree.position(at), tree.normal(at), e.radius);
    if (!e.veryFew) share = times(kEstimatesPerShown, share);
    *figures += {1, e.few, e.bent, e.clump, share, e.veryFew ? share : PictureShare{}};
  }
  return out;
}

}  // namespace tomales
