// Private to gi/gather: the rays of one record, and what they see. Which rays are worth tracing is gi/gather.cpp's.
// Space: current; local directions have the point's normal along z. Radiance is what comes along a ray, or for
// occlusion the share of it that is not covered.
#pragma once
#include "gi/gather.h"
#include "gi/hit_radiance.h"
#include "gi/ray_strata.h"

namespace tomales {

/// Where the rays of a hemisphere, one a cell, end.
struct FirstHits {
  std::vector<float> distances;  ///< Infinite where they miss.
  std::vector<vec3> normals;     ///< On the side that they see.
};

class GatherRays {
 public:
  /// `count`: rays of the hemisphere. `known`: radiance of hits, or null. The arguments must outlive this.
  GatherRays(const RayScene& scene, const ShadingSystem& shading, const GatherPoint& point,
             const GatherSettings& settings, const HitRadiance* known, size_t count, uint32_t key);

  vec3 toWorld(const vec3& local) const;
  vec3 toLocal(const vec3& direction) const;
  const vec3& tangent() const { return tangent_; }
  const vec3& bitangent() const { return bitangent_; }
  uint32_t number() const { return number_; }  ///< Of the next ray: a name that no other has.

  /// One more ray for the next see(), named `element` in its answers; `cell` says when it leaves. As thin as if
  /// `raysOfHemisphere` covered the hemisphere. Returns its direction.
  vec3 add(int element, int cell, const vec3& local, size_t raysOfHemisphere);

  /// What the added rays see, by their elements, of which there are `elements`. `first`: also where they end; they
  /// must have been added in the order of their elements.
  void see(Stats& stats, size_t elements, std::vector<vec3>& radiance, FirstHits* first = nullptr);

 private:
  struct Scratch;
  static Scratch& emptyScratch();
  void uncover(Stats& stats, std::vector<vec3>& radiance, FirstHits* first);
  void shade(Stats& stats, std::vector<vec3>& radiance, FirstHits* first);
  void meet(Stats& stats, FirstHits* first);
  void answer(const ShadeContext& context);

  const RayScene& scene_;
  const ShadingSystem& shading_;
  const GatherPoint& point_;
  const GatherSettings& settings_;
  const HitRadiance* known_;
  const uint32_t key_;
  const RayTimes times_;
  RayFilter filter_;
  Ray first_;
  vec3 tangent_, bitangent_;
  uint32_t number_ = 0;
  Scratch& scratch_;
};

}  // namespace tomales
