#include "gi/frame/sheet_search.h"

#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr float kSheetPixels = 2;  // length of the rays: farther, records know of it
constexpr float kUnmet = 0.9f;     // of the closest distance of a record: what is nearer it has not met
constexpr float kSlant = 0.70710678f;

}  // namespace

// Records in front of a slot that is narrower than they reach see the sheet over it edge-on, if at all. Of
// two rays that leave upwards and aside one meets it, even below its very edge. Records beside that edge have
// met it, and it may be as near as the sheet is high: a ray upwards tells the points that lie under it from
// those that do not.
bool SheetSearch::isUnderSheet(const GatherPoint& p, float closest, float headroom) {
  const float farthest = std::min(kSheetPixels * p.pixelSize, gather_.maxDistance),
              met = std::min(farthest, kUnmet * closest);
  Ray ray{p.position, p.normal};
  ray.tMax = std::min(farthest, kUnmet * headroom);
  ray.spread = spreadOfRays(gather_.samples);
  rays_.prepareOrigin(p.group, p.position, p.edgeLength, ray);
  const float slanted = slantedOffset(ray.offset, kSlant);
  if (slanted >= ray.tMax) return false;  // of surfaces so near rays do not know which they leave
  if (p.group != group_) filter_.groups = groupsSeenFrom(rays_, group_ = p.group, gather_);
  if (!filter_.passesAll()) ray.filter = &filter_;
  if (ray.tMax > met && meetsSheet(p, ray)) return true;
  ray.offset = slanted, ray.tMax = met;
  if (slanted >= met) return false;
  vec3 tangent, bitangent;
  orthonormalBasis(p.normal, tangent, bitangent);
  const float azimuth = 2 * kPi * unitFloat(hash32(p.key ^ 0x73686565U));
  const vec3 aside = std::cos(azimuth) * tangent + std::sin(azimuth) * bitangent;
  for (const float side : {-kSlant, kSlant}) {
    ray.direction = kSlant * p.normal + side * aside;
    if (meetsSheet(p, ray)) return true;
  }
  return false;
}

bool SheetSearch::meetsSheet(const GatherPoint& p, const Ray& ray) {
  ++traced_;
  const Hit hit = rays_.closest(ray, kMaskDiffuse);
  return hit.object >= 0 && std::abs(dot(hit.geometricNormal, p.normal)) > kSlant;
}

}  // namespace tomales
