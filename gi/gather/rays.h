// Private to gi/gather: the rays of one record, and their answers. gi/gather/gather.cpp decides which rays are worth
// tracing. Space: current; local directions have the point's normal along z. Radiance is that along a ray. For
// occlusion, the uncovered share takes its place.
#pragma once
#include "gi/gather.h"
#include "gi/gather/polygon_start.h"
#include "gi/gather/ray_strata.h"
#include "gi/hit_radiance.h"

namespace tomales {

/// The hits of the rays of a hemisphere, one for each cell.
struct FirstHits {
  std::vector<float> distances;  ///< Infinite where they miss.
  std::vector<vec3> normals;     ///< Unit, on the side that the ray sees.
};

/// The radiance that rays bring.
struct SeenLight {
  std::vector<vec3> all;
  std::vector<std::vector<vec3>> shares;  ///< Indexed by the group of lights that is asked for.
};

class GatherRays {
 public:
  /// `count` is the number of rays of the hemisphere. `known` gives the radiance of hits; it may be null. The arguments
  /// must outlive this object.
  GatherRays(const RayScene& scene, const ShadingSystem& shading, const GatherPoint& point,
             const GatherSettings& settings, const HitRadiance* known, std::span<const std::string> groups,
             size_t count, uint32_t key);

  vec3 toLocal(const vec3& direction) const;
  const vec3& tangent() const { return tangent_; }
  const vec3& bitangent() const { return bitangent_; }
  uint32_t number() const { return number_; }  ///< Number of the next ray, unique within the record.

  /// Adds a ray for the next see(), which answers for it under `element`. `cell` decides the time of the ray. Its
  /// footprint is that of a hemisphere of `raysOfHemisphere` rays. Returns its direction.
  vec3 add(int element, int cell, const vec3& local, size_t raysOfHemisphere);

  /// Traces the added rays and fills seen.all[element] and seen.shares[group][element] for each of the `elements`.
  /// `first`, if not null, gets the hits; the rays must then have been added in the order of their elements.
  void see(Stats& stats, size_t elements, SeenLight& seen, FirstHits* first = nullptr);

 private:
  struct Scratch;
  static Scratch& emptyScratch();
  vec3 toWorld(const vec3& local) const;
  void uncover(Stats& stats, std::vector<vec3>& radiance, FirstHits* first);
  void shade(Stats& stats, SeenLight& seen, FirstHits* first);
  void shadeShares(const ShadeContext& context, SeenLight& seen);
  void meet(Stats& stats, FirstHits* first);
  void answer(const ShadeContext& context);

  const RayScene& scene_;
  const ShadingSystem& shading_;
  const GatherPoint& point_;
  const GatherSettings& settings_;
  const HitRadiance* known_;
  const std::span<const std::string> groups_;
  const uint32_t key_;
  const ShutterStrata times_;
  RayFilter filter_;
  Ray first_;
  PolygonStart start_;
  vec3 tangent_, bitangent_;
  uint32_t number_ = 0;
  Scratch& scratch_;
};

}  // namespace tomales
