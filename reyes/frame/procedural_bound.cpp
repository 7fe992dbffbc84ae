#include "reyes/frame/procedural_bound.h"

#include <fmt/format.h>

#include <cfloat>
#include <map>

namespace tomales {
namespace {

constexpr uint32_t kMostPatches = 64;  ///< Patches of an object that are looked at, evenly chosen.
constexpr float kTolerance = 0.01f;    ///< Share of the bound's size by which contents may pass it.
constexpr float kRoundings = 8;        ///< Roundings of a point on its way to the camera and back.

bool contains(const Bound3& outer, const Bound3& inner) {
  return glm::all(glm::greaterThanEqual(inner.lo, outer.lo)) && glm::all(glm::lessThanEqual(inner.hi, outer.hi));
}

/// Extends the box by some points of the surface, transformed by m.
void extendBySome(const Prim& prim, const mat4& m, Bound3& out) {
  constexpr int kSide = 5, kPoints = kSide * kSide;  // a quarter turn of a quadric between neighbours
  constexpr int kRoom = (kPoints + kLanes - 1) / kLanes * kLanes;
  float u[kRoom], v[kRoom], a[12][kRoom];
  for (int i = 0; i < kPoints; ++i) {
    u[i] = static_cast<float>(i % kSide) / (kSide - 1);
    v[i] = static_cast<float>(i / kSide) / (kSide - 1);
  }
  for (uint32_t patch = 0, step = 1 + prim.patchCount() / kMostPatches; patch < prim.patchCount(); patch += step) {
    prim.evaluate(patch, kPoints, u, v, {a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11]});
    for (int i = 0; i < kPoints; ++i)
      if (const vec3 p{a[0][i], a[1][i], a[2][i]}; isFinite(p) && prim.keeps(patch, u[i], v[i]))
        out.extend(transformPoint(m, p));
  }
}

}  // namespace

void checkProceduralBound(const Procedural& p, const Expansion& inside, Log& log) {
  const float time = p.keyTimes.front();
  const mat4 m = p.cameraFromObject.at(time), fromCamera = glm::inverse(m);
  // Contents may pass the bound by displacement, which the frame adds to it, and by the rounding of floats far from the
  // camera.
  const float coarse = kRoundings * FLT_EPSILON * glm::length(vec3(m[3]));
  const Bound3 allowed = p.bound.grown(kTolerance * glm::length(p.bound.size()) +
                                       (p.displacementBound + coarse) / std::max(lengthScale(m), FLT_MIN));
  std::map<const Prim*, Bound3> boxes;  // instances share shapes, and an instance whose box fits needs no other look
  Bound3 seen;
  for (const Object& o : inside.objects) {
    // Only buckets of the camera keep to the bound. Another part of a solid may cut off what passes it.
    if (o.solid >= 0 || !o.attributes->visibility.camera) continue;
    const auto [box, isNew] = boxes.try_emplace(&o.shape());
    if (isNew) extendBySome(o.shape(), mat4(1.0f), box->second);
    const mat4 fromObject = fromCamera * o.cameraFromObject.at(time);
    if (!box->second.empty() && !contains(allowed, transformBound(fromObject, box->second)))
      extendBySome(o.shape(), fromObject, seen);
  }
  if (seen.empty() || !isFinite(seen.lo) || !isFinite(seen.hi) || contains(allowed, seen)) return;
  Bound3 needed = p.bound;
  needed.extend(seen);
  log.report(Severity::Warning, "rib-bound", p.where,
             fmt::format("a procedural reaches beyond its bound, and parts of it may be cut off; it needs [{} {} "
                         "{} {} {} {}] or more",
                         needed.lo.x, needed.hi.x, needed.lo.y, needed.hi.y, needed.lo.z, needed.hi.z),
             p.where.text());
}

}  // namespace tomales
