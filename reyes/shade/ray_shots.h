// Sets up the rays of a shader's call: checks options, stratifies directions over a cone, and sets footprints.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

/// The limit of the samples that a shader asks for at one point.
inline constexpr int kMostSamples = 1 << 16;

/// Return the options of trace(), whose directions the caller may draw itself, and those of the other services.
TmRayOptions drawnRayOptions(const Batch& batch, const TmRayOptions* given);
TmRayOptions rayOptions(const Batch& batch, const TmRayOptions* given);

RayQuery rayQuery(const TmRayOptions&, RayKind);
/// Rays of narrow cones are specular, and rays of wide ones diffuse.
RayQuery rayQuery(const TmRayOptions&);

/// Tells whether this batch may trace. Reports a shader that does not declare TM_TRACES.
bool traces(const Batch& batch);

/// Ray number `ray` of all points: a direction in a cone around each axis, and its origin.
class Cone {
 public:
  Cone(Batch& batch, const TmGrid* g, const TmRayOptions& options);
  void aim(TmConstVec3 P, TmConstVec3 axis, int ray);
  TmConstVec3 origin() const { return view(origin_); }
  TmConstVec3 direction() const { return view(direction_); }

 private:
  vec2 random(int i, int ray, uint32_t stream) const;
  vec3 around(const vec3& axis, const vec2& xi) const;
  vec3 spread(int i, int ray) const;

  Batch& batch_;
  const TmGrid* g_;
  const TmRayOptions& options_;
  TmVec3 origin_, direction_;
};

/// Sets ray differentials: a ray starts as wide as its micropolygon, and widens by the turn of the axis over that
/// micropolygon and by the ray's share of the cone.
void setFootprints(Batch& batch, const TmGrid* g, TmConstVec3 axis, const TmRayOptions& options, RayQuery& query);

}  // namespace tomales
