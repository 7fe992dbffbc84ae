// Verb: final gathering. One irradiance record at one point: stratified cosine-weighted rays over the hemisphere, their
// hits shaded with direct diffuse light (approximate-gi 4.1, 4.2), and from the same rays the gradients, distances and
// dominant directions. Also the plain Monte Carlo estimate that the reference uses. Irradiance: results are E/pi.
#pragma once
#include "gi/bright_spots.h"
#include "gi/irradiance_cache.h"
#include "raytrace/trace.h"

namespace tomales {

struct GatherSettings {
  int samples = 600;
  float maxDistance = 1e30f;
  uint32_t seed = 0;
  Illumination light = Illumination::Lights;  ///< Of what the rays hit.
  bool curvature = false;                     ///< Fill smoothRadius and the second derivatives, which see occlusion;
  float maxError = 1;                         ///< smoothRadius is for light that may be so many times as far off.
  int depth = 1;                              ///< Diffuse bounces between the eye and what the rays hit,
  bool indirect = false;                      ///< whose shaders ask for indirect light in turn.
  bool mirrored = true;                       ///< As ShadeContext::mirrored.
  std::string subset{};  ///< Sets of objects that the rays see; none: as trace:subset of the object says.
  std::optional<OcclusionQuery>
      occlusion{};  ///< Instead of light: E/pi is what is not covered of the hemisphere, and no hit is shaded.
  bool operator==(const GatherSettings&) const = default;
};

/// A point to gather at.
struct GatherPoint {
  int group;              ///< The shade group that the rays leave.
  vec3 position, normal;  ///< normal: unit, on the side to gather from
  uint32_t key;           ///< Names the point for random numbers.
  float pixelSize;        ///< Root of the projected pixel area.
  float edgeLength;       ///< Of its micropolygon, for the origin offset.
  vec3 drift{0};          ///< As kDriftX.
  float time = -1;        ///< As kTime.
};
class HitRadiance;

/// What is known of the light before it is gathered. Null: nothing.
struct KnownLight {
  const BrightSpots* spots = nullptr;  ///< Some rays more are aimed at them.
  const HitRadiance* hits = nullptr;   ///< What they send back.
};
/// `find`: what is bright here, as the hemisphere alone sees it.
IrradianceRecord gather(const RayScene& rays, const ShadingSystem& shading, const GatherPoint& point,
                        const GatherSettings& settings, const KnownLight& known, Stats& stats,
                        BrightFind* find = nullptr);

/// The shade groups that rays from a group are to see.
const std::vector<uint8_t>* groupsSeenFrom(const RayScene& rays, int group, const GatherSettings& settings);
/// Radius of the footprint of one of the hemisphere's rays at its pole, for each unit of distance.
inline float spreadOfRays(int samples) { return 1 / std::sqrt(static_cast<float>(samples)); }

/// Hit-list distance of a ray at this cosine to the normal. Coarse and fine surface are up to `offset` apart along the
/// normal, so a slanted ray meets the coarse one later; the floor keeps grazing rays from reaching through other
/// objects.
inline float slantedOffset(float offset, float cosine) { return offset / std::max(cosine, 0.25f); }

/// Directions of a stratified cosine hemisphere of M x N cells (M rings of equal projected area, N sectors), as the
/// lecture notes' estimator has them: cell (j, k) is sample j * N + k. Around +z.
struct HemisphereCells {
  int rings, sectors;
};
HemisphereCells hemisphereCells(int samples);  ///< rings * sectors close to `samples`, sectors ~ pi * rings
vec3 hemisphereDirection(const HemisphereCells& cells, int ring, int sector, vec2 xi);
int cellOf(const HemisphereCells& cells, const vec3& direction);  ///< ring * sectors + sector

}  // namespace tomales
