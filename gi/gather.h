// Verb: final gathering. It makes one irradiance record at one point: stratified cosine-weighted rays over the
// hemisphere, whose hits are shaded with direct diffuse light (Tabellion and Lamorlette 2004, sections 4.1 and 4.2).
// The same rays give the gradients, distances and dominant directions. Irradiance: results are E/pi. Space: current.
// Threads: gather() may be called concurrently.
#pragma once
#include "gi/cache/bright_spots.h"
#include "gi/irradiance_cache.h"
#include "raytrace/trace.h"

namespace tomales {

struct GatherSettings {
  int samples = 600;
  float maxDistance = kRiInfinity;
  uint32_t seed = 0;
  Illumination light = Illumination::Lights;  ///< The light that shades the hits.
  bool curvature = false;                     ///< Fill smoothRadius and hessian of the record (gi/gather/hessian.h).
  float maxError = 1;                         ///< Factor on the error that smoothRadius allows.
  int depth = 1;                              ///< Diffuse bounces between the eye and the hits.
  bool indirect = false;                      ///< The shaders of the hits ask for indirect light in turn.
  bool specularRaysSeeLights = true;          ///< The same as in ShadeContext.
  std::string subset{};                       ///< The sets that the rays see; empty: the object's grouping:tracesubset.
  std::optional<HemisphereQuery> asked{};     ///< The question of a shader; empty for an indirect light.
  bool operator==(const GatherSettings&) const = default;

  /// True for occlusion instead of light: E/pi is the uncovered share of the hemisphere, and no hit is shaded.
  bool isOcclusion() const { return asked && !asked->radiance; }
};

/// A point to gather at.
struct GatherPoint {
  int group;              ///< The shade group that the rays leave.
  vec3 position, normal;  ///< normal: unit vector on the side to gather from.
  uint32_t key;           ///< Names the point for random numbers.
  float pixelSize;        ///< Root of the projected pixel area.
  float edgeLength;       ///< Edge of its micropolygon, for the origin offset.
  vec3 drift{0};          ///< Motion over the shutter, as the channel kDriftX.
  float time = -1;        ///< Time in [0, 1), or -1 for the whole shutter, as the channel kTime.
};
class HitRadiance;

/// Light that is known before it is gathered. Null pointers where none is.
struct KnownLight {
  const BrightSpots* spots = nullptr;  ///< Some further rays are aimed at these.
  const HitRadiance* hits = nullptr;   ///< The radiance at the hits of rays.
};

/// Returns the highlights that diffuse rays bring. Where photons bring the light of lamps by mirrors and glass,
/// highlights of these would bring it again.
inline HitHighlights highlightsOfHits(bool specularRaysSeeLights) {
  return specularRaysSeeLights ? HitHighlights::OfSpecular : HitHighlights::None;
}

/// Gathers one record. `find`, if not null, gets the bright light that the rays of the hemisphere alone have met.
/// `groups`: the groups of lights whose shares the record gets. The first has no lights: its share is the light of
/// surfaces that glow by themselves, and no other group gets that.
IrradianceRecord gather(const RayScene& rays, const ShadingSystem& shading, const GatherPoint& point,
                        const GatherSettings& settings, const KnownLight& known, Stats& stats,
                        BrightFind* find = nullptr, std::span<const std::string> groups = {});

/// Returns the shade groups that rays from a group may hit; null if they may hit all.
const std::vector<uint8_t>* groupsSeenFrom(const RayScene& rays, int group, const GatherSettings& settings);
/// Returns the radius of the footprint of one of the hemisphere's rays at its pole, for each unit of distance.
inline float spreadOfRays(int samples) { return 1 / std::sqrt(static_cast<float>(samples)); }

/// Cells of a stratified cosine-weighted hemisphere around +z: M rings of equal projected area by N sectors. Cell (j,
/// k) is sample j * N + k.
struct HemisphereCells {
  int rings, sectors;
};
HemisphereCells hemisphereCells(int samples);  ///< rings * sectors is close to `samples`, and sectors about pi * rings.
vec3 hemisphereDirection(const HemisphereCells& cells, int ring, int sector, vec2 xi);
int cellOf(const HemisphereCells& cells, const vec3& direction);  ///< Returns ring * sectors + sector.

}  // namespace tomales
