#include "gi/gather/occluders.h"

#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr float kOccluderPixels = 2;  // Length of the rays in pixels. Records have met occluders that are farther away.
constexpr float kUnmet = 0.9f;        // Share of a record's closest distance below which it has met nothing.
constexpr float kSlant = kCosine45;

}  // namespace

float radiusUnderOccluder(const HemisphereSamples& samples, float pixelSize, std::vector<float>& upright) {
  constexpr float kUpright = 0.8f;  // Cosine of the angle.
  constexpr size_t kTenth = 10;
  constexpr float kFinestPixels = 0.25f;
  upright.clear();
  for (size_t i = 0; i < samples.directions.size(); ++i)
    if (dot(samples.directions[i], samples.normal) > kUpright) upright.push_back(samples.distances[i]);
  if (upright.empty()) return kInfinity;
  const auto height = upright.begin() + static_cast<ptrdiff_t>(upright.size() / kTenth);
  std::nth_element(upright.begin(), height, upright.end());
  return std::max(*height, kFinestPixels * pixelSize);
}

// A record in front of a slot that is narrower than the record's radius sees the occluder over the slot edge-on, if at
// all. From a point in the slot, one of two rays that leave upwards and aside meets the occluder, even below its very
// edge. A record beside that edge has met it, and the edge may be as near as it is high; then a ray straight up tells
// the points under the occluder from the others.
bool OccluderSearch::isUnderOccluder(const GatherPoint& p, float closest, float occluderHeight) {
  const float farthest = std::min(kOccluderPixels * p.pixelSize, gather_.maxDistance),
              met = std::min(farthest, kUnmet * closest);
  Ray ray{p.position, p.normal};
  ray.tMax = std::min(farthest, kUnmet * occluderHeight);
  ray.spread = spreadOfRays(gather_.samples);
  rays_.prepareOrigin(p.group, p.position, p.edgeLength, ray);
  const float slanted = slantedOffset(ray.offset, kSlant);
  if (slanted >= ray.tMax) return false;  // Rays cannot tell a surface so near from the one that they leave.
  if (p.group != group_) filter_.groups = groupsSeenFrom(rays_, group_ = p.group, gather_);
  if (!filter_.passesAll()) ray.filter = &filter_;
  if (ray.tMax > met && meetsOccluder(p, ray)) return true;
  ray.offset = slanted;
  ray.tMax = met;
  if (slanted >= met) return false;
  vec3 tangent, bitangent;
  orthonormalBasis(p.normal, tangent, bitangent);
  const float azimuth = 2 * kPi * unitFloat(hash32(p.key ^ randomStream("shee")));
  const vec3 aside = std::cos(azimuth) * tangent + std::sin(azimuth) * bitangent;
  for (const float side : {-kSlant, kSlant}) {
    ray.direction = kSlant * p.normal + side * aside;
    if (meetsOccluder(p, ray)) return true;
  }
  return false;
}

bool OccluderSearch::meetsOccluder(const GatherPoint& p, const Ray& ray) {
  ++traced_;
  const Hit hit = rays_.closest(ray, kMaskDiffuse);
  return hit.object >= 0 && std::abs(dot(hit.geometricNormal, p.normal)) > kSlant;
}

}  // namespace tomales
