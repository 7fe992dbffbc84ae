// Composer: rays against a coarse tessellation of the scene (Embree), with the hit-list origin offset of
// "An Approximate Global Illumination System", section 4.3:
//   1 record the hits within the offset distance, before and after the origin
//   2 stop at the first hit beyond it
//   3 the recorded hit closest to the origin, if any, is the new origin
//   4 the next hit after that is the answer
// One traversal: an Embree filter function records and rejects hits inside the offset and accepts the first beyond.
// Motion: rays see objects move, but not the camera, and area lights stand where they are when the shutter opens. Only
// rays from objects with Attribute "trace" "samplemotion" 1 are given times; all others see the scene at shutter open.
// Space: current (camera space at shutter open). Threads: const members may be called concurrently.
#pragma once
#include <map>
#include <optional>

#include "raytrace/level.h"
#include "raytrace/surroundings.h"
#include "reyes/shade.h"

namespace tomales {

/// What a ray may meet besides what its mask says.
struct RayFilter {
  const std::vector<uint8_t>* groups = nullptr;  ///< 1 for each shade group that it sees; null: all
  HitSides sides = HitSides::Both;
  bool passesAll() const { return !groups && sides == HitSides::Both; }
  bool passes(uint32_t group, bool leaving) const {
    return (!groups || (*groups)[group]) && (sides == HitSides::Both || leaving == (sides == HitSides::Back));
  }
};

struct Ray {
  vec3 origin, direction;  ///< direction: unit length
  float tMax = kInfinity;  ///< Hits at t >= tMax do not count.
  float offset = 0;        ///< Hit-list distance; 0 switches the algorithm off and uses `bias` alone.
  float bias = 0;          ///< Without a hit list: hits at t <= bias do not count.
  float spread = 0;        ///< Radius of the ray's footprint for each unit of t (half the width of its differential).
  float radius = 0;        ///< And at its origin.
  int group = -1;  ///< Shade group that the ray leaves, -1: unknown. Settles which of two walls that meet is left.
  float time = 0;  ///< Part of the shutter, 0..1.
  Level level = Level::Fine;  ///< Of surfaces that have several. A ray sees one, so that none slips between two.
  const RayFilter* filter = nullptr;           ///< Null: all pass.
  const Surroundings* surroundings = nullptr;  ///< Null, or of its origin (RayScene::lookAround).
};

struct Hit {
  float t = kInfinity;  ///< From the ray's own origin.
  int object = -1;      ///< -1: nothing was hit.
  uint32_t patch = 0;
  float u = 0, v = 0;       ///< Patch parameters.
  vec3 normal{0};           ///< Of the coarse surface, RISpec side, interpolated, unit length.
  vec3 geometricNormal{0};  ///< Of the coarse polygon, RISpec side, unit length.
  bool adjusted = false;    ///< The origin was moved to a recorded hit,
  bool crowded = false;     ///< and within the offset lay the other side of its wall: which is left is a guess.
  vec3 atOpen{0};  ///< Where the point that was met is when the shutter opens; normals are those of that time too.
};

/// Asked and told of a list of hits.
struct HitAnswers {
  std::optional<HitMode> mode;       ///< Empty: as the object's attributes say for this kind of ray.
  bool wantsColor = true;            ///< Else hits are not shaded.
  std::vector<RayOutput> outputs;    ///< Element i belongs to hit i; those of misses are left alone.
  std::vector<int> elements;         ///< Which element of the outputs belongs to each hit.
  std::vector<vec3> color, opacity;  ///< Misses: 0.
};

/// Which rays see an object; bits of Attributes::visibility.
enum RayMask : uint32_t { kMaskDiffuse = 1, kMaskSpecular = 2, kMaskTransmission = 4, kMaskPhoton = 8 };

class Emitters;

struct RaySettings {
  bool hitList = true;
  size_t geometryCacheBytes =
      kDefaultGeometryCache;  ///< For surfaces of several levels (docs/decisions/0036-geometry-cache.md)

  static constexpr size_t kDefaultGeometryCache = 30 << 20;
};

class RayScene {
 public:
  /// Tessellates every object that some ray may see. Displaces with `shading` where trace:displacements asks for it.
  RayScene(const Scene& scene, const Camera& camera, const ShadingSystem& shading, const RaySettings& settings,
           Stats& stats, Log& log);
  ~RayScene();

  void report(Stats& stats) const;  ///< After the last ray.

  Hit closest(const Ray& ray, RayMask mask) const;
  /// Fraction of light that passes from each origin to tMax. What hides all is met first and ends the ray; the opacity
  /// of the rest is the object's and its primitive variable's, or its shader's (Attribute "shade"
  /// "transmissionhitmode"), whose points are shaded together. `names` as in shadeHits. `adjusted` grows by how many of
  /// those that are not blocked started at a recorded hit.
  std::vector<vec3> transmission(const std::vector<Ray>& rays, const std::vector<SampleName>& names,
                                 const ShadingSystem& shading, const ShadeContext& context, int64_t& adjusted) const;

  /// Which groups have a member in one of the sets of `subset` (all, if empty) and none in those of `exclude`. Sets are
  /// separated by commas or spaces. Null: all. Stays valid.
  const std::vector<uint8_t>* groupsIn(const std::string& subset, const std::string& exclude) const;

  /// Sets group, level, offset and bias of a ray of known spread and radius that leaves P on a micropolygon of this
  /// group with edges no longer than `edgeLength` (0: a point of the true surface): trace:offset and trace:bias, or by
  /// default more than the largest distance between the coarse surface, the true one (displacement bound included) and
  /// the micropolygon.
  void prepareOrigin(int group, const vec3& P, float edgeLength, Ray& ray) const;

  /// Of rays that left a group: how many there were, and how many Hit::crowded.
  struct Starts {
    int64_t rays = 0, crowded = 0;
  };
  void noteStarts(int group, int64_t rays, int64_t crowded) const;
  std::map<int, Starts> starts() const;  ///< Noted so far.

  /// For many rays of this mask that leave the origin of one of them and are of its level: with Ray::surroundings the
  /// hit list costs each of them little. What they meet is the same. `largestOffset`: of any of them.
  void lookAround(const Ray& one, float largestOffset, RayMask mask, Surroundings& out) const;

  /// Do rays from points of this group meet anything that moves?
  bool samplesTime(int group) const;
  /// Where a point of this group is at a time of the shutter, of which place at shutter open and drift (kDriftX) are
  /// known.
  vec3 placeAt(int group, const vec3& atOpen, const vec3& drift, float time) const;

  /// Radiance at hits towards the ray origins. All hits of one call are shaded together, a batch for each shade group.
  /// `names` name the hits for random numbers. radiance: count entries; misses get 0.
  void shadeHits(const std::vector<Ray>& rays, const std::vector<Hit>& hits, const std::vector<SampleName>& names,
                 const ShadingSystem& shading, const ShadeContext& context, std::vector<vec3>& radiance) const;
  /// The same with all that hits can tell.
  void shadeHits(const std::vector<Ray>& rays, const std::vector<Hit>& hits, const std::vector<SampleName>& names,
                 const ShadingSystem& shading, const ShadeContext& context, HitAnswers& answers) const;

  /// What lies between each hit and the surface that its ray has come through (`left`, met by `came`) changes the
  /// answers: Interior or Exterior of that surface's group, by the side on which the ray leaves it.
  void crossVolumes(const std::vector<Ray>& came, const std::vector<Hit>& left, const std::vector<Ray>& rays,
                    const std::vector<Hit>& hits, const std::vector<SampleName>& names, const ShadingSystem& shading,
                    const ShadeContext& context, HitAnswers& answers) const;

  /// The surfaces of area lights.
  const Emitters& emitters() const;

  const Scene& scene() const;
  int groupOf(const Hit& hit) const;  ///< Pre: something was hit.

  struct Impl;  ///< raytrace/ray_scene.h

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales
