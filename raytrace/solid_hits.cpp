#include "raytrace/solid_hits.h"

#include <algorithm>
#include <tuple>

namespace tomales {
namespace {

constexpr float kRounding = 1e-5f;  ///< Relative to the hit's position: surfaces no farther apart may be one, or flush.

}  // namespace

SolidHits::SolidHits(const Scene& scene, const std::vector<CoarseGroup>& groups, const std::vector<uint32_t>& masks,
                     Log& log)
    : scene_(scene), groups_(groups), masks_(masks) {
  const std::vector<uint32_t> seenByAll(groups.size(), ~0U);
  const std::vector<bool> opaque(groups.size(), false);
  if (!scene.solids.empty()) embree_.emplace(RayGroups{groups, seenByAll, opaque}, log);
}

void SolidHits::surfaces(const Ray& ray, float window, uint32_t mask, HitList& out) const {
  out.clear();
  thread_local HitList hits;
  embree_->all(ray, window, hits);
  const auto key = [this](const PolygonHit& h) { return std::make_tuple(objectOf(h).solid, h.t, h.group, h.quad); };
  std::sort(hits.begin(), hits.end(), [&](const PolygonHit& a, const PolygonHit& b) { return key(a) < key(b); });
  for (size_t first = 0, last = 0; first < hits.size(); first = last) {
    while (last < hits.size() && objectOf(hits[last]).solid == objectOf(hits[first]).solid) ++last;
    resolve({hits.data() + first, last - first}, ray, mask, out);
  }
  sortAlongRay(out);
}

void SolidHits::resolve(std::span<const PolygonHit> hits, const Ray& ray, uint32_t mask, HitList& out) const {
  thread_local std::vector<SolidCrossing> crossings;
  thread_local std::vector<SolidBoundary> boundaries;
  crossings.clear();
  for (const PolygonHit& h : hits) {
    const float rounding = kRounding * (std::abs(h.t) + glm::length(ray.origin));
    const Object& o = objectOf(h);
    crossings.push_back({o.solidBlock, h.leaving != o.turnedInSolid, h.t, rounding, rounding});
  }
  SolidWalk(scene_.solids[static_cast<size_t>(objectOf(hits.front()).solid)]).boundaries(crossings, boundaries);
  for (const SolidBoundary& b : boundaries) {
    PolygonHit hit = hits[b.crossing];
    hit.leaving = !b.entering;
    const bool passes = !ray.filter || ray.filter->passes(hit.group, hit.leaving);
    if (passes && hit.t < ray.tMax && (masks_[hit.group] & mask)) out.push_back(hit);
  }
}

}  // namespace tomales
