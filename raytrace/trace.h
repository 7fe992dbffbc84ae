// Composer: rays against a coarse tessellation of the scene (Embree), with the hit-list origin offset of Tabellion and
// Lamorlette 2004, section 4.3:
//   1 record the hits within the offset distance, before and after the origin
//   2 stop at the first hit beyond it
//   3 the recorded hit closest to the origin, if any, is the new origin
//   4 the next hit after that is the answer
// One traversal: an Embree filter function records and rejects hits inside the offset and accepts the first beyond.
// Motion: rays see objects move, but not the camera, and area lights stand where they are when the shutter opens. Rays
// from objects with Attribute "trace" "samplemotion" 0 see the scene at shutter open.
// Space: current (camera space at shutter open). Threads: const members may be called concurrently.
#pragma once
#include <map>
#include <optional>

#include "raytrace/level.h"
#include "raytrace/surroundings.h"
#include "reyes/shade.h"

namespace tomales {

/// Restricts the hits of a ray beyond its mask.
struct RayFilter {
  const std::vector<uint8_t>* groups = nullptr;  ///< Indexed by shade group: 1 if the ray sees it; null: it sees all.
  HitSides sides = HitSides::Both;
  const std::vector<uint8_t>* also = nullptr;  ///< As `groups`: the ray sees what is 1 in both.
  bool passesAll() const { return !groups && !also && sides == HitSides::Both; }
  bool passes(uint32_t group, bool leaving) const {
    return (!groups || (*groups)[group]) && (!also || (*also)[group]) &&
           (sides == HitSides::Both || leaving == (sides == HitSides::Back));
  }
};

struct Ray {
  vec3 origin, direction;  ///< direction: unit length
  float tMax = kInfinity;  ///< Hits at t >= tMax do not count.
  float offset = 0;        ///< Hit-list distance; 0 switches the hit list off, and `bias` is used alone.
  float bias = 0;          ///< Hits at t <= bias do not count for a ray without a hit list.
  float spread = 0;        ///< Radius of the ray's footprint for each unit of t (half the width of its differential).
  float radius = 0;        ///< The same radius at its origin.
  /// Shade group that the ray leaves; -1: unknown. It decides which of two walls that meet the ray leaves.
  int group = -1;
  float time = 0;  ///< The share of the shutter that has passed, 0..1.
  /// The level that it sees of surfaces that have several. It is one level, so that the ray does not slip between two.
  TessellationLevel level = TessellationLevel::Fine;
  const RayFilter* filter = nullptr;           ///< Null: all hits pass.
  const Surroundings* surroundings = nullptr;  ///< The surroundings of its origin (RayScene::lookAround), or null.
};

struct Hit {
  float t = kInfinity;  ///< Distance from the ray's own origin; may be negative, down to -offset, with the hit list.
  int object = -1;      ///< -1: nothing was hit.
  uint32_t patch = 0;
  float u = 0, v = 0;       ///< Patch parameters.
  vec3 normal{0};           ///< Interpolated unit normal of the coarse surface, RISpec side.
  vec3 geometricNormal{0};  ///< Unit normal of the coarse polygon, RISpec side.
  bool adjusted = false;    ///< The origin was moved to a recorded hit.
  /// The other side of a wall lay within the offset as well: which side the ray leaves is a guess.
  bool crowded = false;
  vec3 atOpen{0};  ///< Position of the hit point when the shutter opens; the normals are those of that time too.
};

/// Returns the hit of a ray that meets a point P of a surface, for one that has met nothing but is to be shaded. The
/// caller sets its t.
inline Hit hitOn(int object, uint32_t patch, const vec2& uv, const vec3& P, const vec3& normal,
                 const vec3& geometricNormal) {
  Hit out;
  out.object = object;
  out.patch = patch;
  out.u = uv.x;
  out.v = uv.y;
  out.normal = normal;
  out.geometricNormal = geometricNormal;
  out.atOpen = P;
  return out;
}

/// What is asked about a list of hits.
struct HitQuestion {
  std::optional<HitMode> mode;  ///< Empty: the object's attributes decide for this kind of ray.
  bool wantsColor = true;       ///< False: hits are not shaded.
  std::vector<RayOutput>
      outputs;  ///< Further values of the hits, which are written to their arrays. Elements of misses are left alone.
  std::vector<int> elements;  ///< The element of the outputs that belongs to each hit.
};

/// The light of a list of hits.
struct HitAnswers {
  std::vector<vec3> color, opacity;  ///< Zero for misses.
};

/// The rays that see an object, as bits of Attributes::visibility.
enum RayMask : uint32_t {
  kMaskDiffuse = 1,
  kMaskSpecular = 2,
  kMaskTransmission = 4,
  kMaskPhoton = 8,
  kMaskCamera = 16  ///< For Volumes alone: in Embree's masks this bit belongs to the next level.
};

inline uint32_t maskOf(const Visibility& v) {
  return (v.diffuse ? kMaskDiffuse : 0u) | (v.specular ? kMaskSpecular : 0u) |
         (v.transmission ? kMaskTransmission : 0u) | (v.photon ? kMaskPhoton : 0u);
}

class Emitters;

struct RaySettings {
  bool hitList = true;
  /// Budget for surfaces of several levels (docs/decisions/0036-geometry-cache.md).
  size_t geometryCacheBytes = kDefaultGeometryCache;
  size_t coarseBytes = 0;  ///< Memory for coarse polygons, which are larger if they need more; 0: no limit.

  static constexpr size_t kDefaultGeometryCache = 30 << 20;
};

class RayScene {
 public:
  /// Tessellates every object that some ray may see, displaced with `shading` where trace:displacements asks for it.
  RayScene(const Scene& scene, const Camera& camera, const ShadingSystem& shading, const RaySettings& settings,
           Stats& stats, Log& log);
  ~RayScene();

  void report(Stats& stats) const;  ///< Adds statistics; called after the last ray.

  /// Returns what the ray meets first, by the hit list if its offset is above 0; Hit::object is -1 if it meets nothing.
  Hit closest(const Ray& ray, RayMask mask) const;
  /// Returns the fraction of light that passes from each origin to tMax. Opaque surfaces are searched first and end the
  /// ray. The opacity of the others is that of the object and its primitive variable, or of its shader (Attribute
  /// "shade" "transmissionhitmode"), whose points are shaded together. `names`: as in shadeHits(). `adjusted` grows by
  /// the number of unblocked rays that started at a recorded hit.
  std::vector<vec3> transmission(const std::vector<Ray>& rays, const std::vector<SampleName>& names,
                                 const ShadingSystem& shading, const ShadeContext& context, int64_t& adjusted) const;

  /// Returns a list indexed by group: 1 if the group has a member in one of the sets of `subset` (all, if empty) and
  /// none in those of `exclude`. Sets are separated by commas or spaces. Returns null for all groups. The result stays
  /// valid.
  const std::vector<uint8_t>* groupsIn(const std::string& subset, const std::string& exclude) const;
  /// Returns a list indexed by group: 0 for the geometry of an area light, else 1. It stays valid.
  const std::vector<uint8_t>* groupsBesideLamp(int light) const;

  /// Prepares a ray to leave P: sets its group, level, offset and bias. Its spread and radius must be set already. P
  /// lies on a micropolygon of this group with edges no longer than `edgeLength`; 0: on the true surface. The offset is
  /// trace:offset, and the bias trace:bias; by default they exceed the largest distance between the coarse surface, the
  /// true one (displacement bound included) and the micropolygon.
  void prepareOrigin(int group, const vec3& P, float edgeLength, Ray& ray) const;

  /// The rays that left a group: how many there were, and how many had Hit::crowded.
  struct Starts {
    int64_t rays = 0, crowded = 0;
  };
  void noteStarts(int group, int64_t rays, int64_t crowded) const;
  std::map<int, Starts> starts() const;  ///< The counts so far.

  /// Prepares Ray::surroundings for many rays of this mask and level that leave the same origin: with it the hit list
  /// costs each of them little. Their hits are the same as without it. `largestOffset`: the greatest offset of all of
  /// them.
  void lookAround(const Ray& one, float largestOffset, RayMask mask, Surroundings& out) const;

  /// Tells whether rays from points of this group may meet anything that moves.
  bool samplesTime(int group) const;
  /// Tells the same of one ray.
  bool mayMeetMotion(const Ray& ray) const;
  /// Returns the position of a point of this group at a time of the shutter, from its position at shutter open and its
  /// drift (kDriftX).
  vec3 placeAt(int group, const vec3& atOpen, const vec3& drift, float time) const;

  /// Computes the radiance at hits towards the ray origins. All hits of one call are shaded together, a batch for each
  /// shade group. `names` name the hits for random numbers. radiance: one entry for each hit; misses get 0.
  void shadeHits(const std::vector<Ray>& rays, const std::vector<Hit>& hits, const std::vector<SampleName>& names,
                 const ShadingSystem& shading, const ShadeContext& context, std::vector<vec3>& radiance) const;
  /// The same, with all other outputs that hits provide.
  void shadeHits(const std::vector<Ray>& rays, const std::vector<Hit>& hits, const std::vector<SampleName>& names,
                 const ShadingSystem& shading, const ShadeContext& context, const HitQuestion& question,
                 HitAnswers& answers) const;

  /// Changes the answers by the volume between each hit and the surface from which its ray starts. That surface is the
  /// hit `left` of an earlier ray `came`. The volume is the Interior or Exterior of its group, by the side on which the
  /// ray leaves it.
  void crossVolumes(const std::vector<Ray>& came, const std::vector<Hit>& left, const std::vector<Ray>& rays,
                    const std::vector<Hit>& hits, const std::vector<SampleName>& names, const ShadingSystem& shading,
                    const ShadeContext& context, HitAnswers& answers) const;

  /// Changes the answers by the Volumes between the start of each ray and its hit, or its tMax. Where nothing was hit,
  /// the colour becomes the light that they scatter, and the opacity the share of light that they stop.
  void throughVolumes(const std::vector<Ray>& rays, const std::vector<Hit>& hits, const std::vector<SampleName>& names,
                      RayMask mask, const ShadingSystem& shading, const ShadeContext& context,
                      HitAnswers& answers) const;
  bool hasVolumes() const;
  /// Returns the share of light that passes through the Volumes along a ray up to tMax.
  vec3 passedByVolumes(const Ray& ray, float tMax, RayMask mask) const;

  /// Returns the surfaces of area lights.
  const Emitters& emitters() const;

  /// Returns the greatest distance from the surface of this group that rays see to the displaced one.
  float unseenDisplacement(int group) const;

  const Scene& scene() const;
  int groupOf(const Hit& hit) const;  ///< Pre: something was hit.

  struct Impl;  ///< raytrace/ray_scene.h

 private:
  std::unique_ptr<Impl> impl_;
};

/// The objects that answer a ray.
struct RayTools {
  const RayScene* rays;
  const ShadingSystem* shading;  ///< The shading of the scene that the rays meet.
};

}  // namespace tomales
