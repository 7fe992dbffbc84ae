// Private to gi/cache: the cubes of an octree.
#pragma once
#include "reyes/base/math.h"

namespace tomales {

struct OctreeBox {
  vec3 center;
  float half;

  /// Returns a cube around a bound. A cube around an empty bound has no extent.
  static OctreeBox around(const Bound3& bound) {
    return bound.empty() ? OctreeBox{vec3(0.0f), 0.0f}
                         : OctreeBox{bound.center(), 0.5001f * maxComponent(bound.size())};
  }
  unsigned childIndex(const vec3& p) const {
    return (p.x >= center.x ? 1u : 0u) | (p.y >= center.y ? 2u : 0u) | (p.z >= center.z ? 4u : 0u);
  }
  OctreeBox child(unsigned i) const {
    const float h = half * 0.5f;
    return {center + vec3(i & 1 ? h : -h, i & 2 ? h : -h, i & 4 ? h : -h), h};
  }
  bool contains(const vec3& p) const { return maxComponent(glm::abs(p - center)) <= half; }
  Bound3 bound() const { return {center - vec3(half), center + vec3(half)}; }
};

}  // namespace tomales
