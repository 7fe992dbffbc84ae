#include "raytrace/moving_bounds.h"

namespace tomales {
namespace {

/// Greatest number of boxes. Each ray is tested against all of them, which costs less than the rays that it saves while
/// boxes are few.
constexpr size_t kMostBoxes = 64;
constexpr float kBoxRounding = 1e-5f;  ///< Share of a box's distance and size.

bool meets(const Ray& ray, const Bound3& box) {
  float from = 0, to = ray.tMax;
  for (int axis = 0; axis < 3; ++axis) {
    const float o = ray.origin[axis], d = ray.direction[axis];
    if (d == 0) {
      if (o < box.lo[axis] || o > box.hi[axis]) return false;
      continue;
    }
    const float a = (box.lo[axis] - o) / d, b = (box.hi[axis] - o) / d;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from <= to;
}

}  // namespace

void MovingBounds::add(const CoarseGroup& group) {
  Bound3 box;
  for (const vec3& p : group.P) box.extend(p);
  for (const std::vector<vec3>& key : group.laterP)
    for (const vec3& p : key) box.extend(p);
  if (box.empty()) return;
  boxes_.push_back(box.grown(kBoxRounding * (glm::length(box.size()) + glm::length(box.center()))));
  if (boxes_.size() <= kMostBoxes) return;
  for (const Bound3& b : boxes_) boxes_.front().extend(b);
  boxes_.resize(1);
}

bool MovingBounds::mayMeet(const Ray& ray) const {
  return std::any_of(boxes_.begin(), boxes_.end(), [&](const Bound3& box) { return meets(ray, box); });
}

}  // namespace tomales
