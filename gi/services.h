// Composer: implements ShadeServices with ray tracing and global illumination (injected by reyes/app), and the gather
// pass that fills the irradiance cache from the deep frame buffer before anything is shaded. Space: current.
// Irradiance: E/pi, except in files. Threads: the members of ShadeServices may be called concurrently; all others
// belong to one thread, and what they set stays as it is while something is shaded.
#pragma once
#include "gi/atlas.h"
#include "gi/gather.h"
#include "gi/hit_radiance.h"
#include "gi/method.h"
#include "raytrace/emitters.h"
#include "reyes/base/checkpoint.h"
#include "reyes/base/stop.h"
#include "reyes/deep.h"

#include <functional>
#include <optional>

namespace tomales {

struct GiSettings {
  GiMode mode = GiMode::Gather;
  int samples = 0;      ///< Rays per record, or paths per point of the reference; 0: the indirect light decides.
  int bounces = 0;      ///< Diffuse bounces; 0: the indirect light decides, and where it does not say, the method.
  float maxError = -1;  ///< The `maxerror` of indirectlight; < 0: the light decides.
  uint32_t seed = 0;
  std::optional<ErrorFunction> errorFunction{};  ///< Empty: the light decides.
  /// GiMode::Atlas: the maps hold direct light too. Without it gather rays sample direct light where they hit.
  bool storesDirect = true;
};

/// Everything that decides the value of an irradiance record, and how far it may be used.
struct CacheKey {
  CacheSettings cache;
  GatherSettings gather;
  bool operator==(const CacheKey&) const = default;
};

struct PreparedCache {
  CacheKey key;
  IrradianceCache cache;
  /// A checksum of what the pixels see, for each frame for which the cache has been refined.
  std::vector<uint64_t> frames{};
};

/// Photons that are counted where the frame's shaders ask for indirect light.
struct PhotonPasses {
  int64_t photons = 1'000'000;  ///< The most that are sent.
  double noise = 0;             ///< The noise at which no more are sent (PhotonMeasurement::noise).
  uint32_t seed = 0;
  bool specularFirstOnly = false;  ///< Count only the light that comes from lamps by mirrors or glass first.
  /// The disks on which photons count shrink while photons are sent. Otherwise each has the area of its micropolygon.
  bool shrinks = false;
  Log* log = nullptr;  ///< Must not be null.
  /// Called at the end with the number of photons that were sent, the number of points, and their noise. Must not be
  /// empty.
  std::function<void(int64_t sent, size_t points, double noise)> tell;
};

struct LearntLight;

/// Called when the first ray is wanted, from any thread: a shot from a file may never need its geometry. Null: the
/// geometry cannot be had, which has been reported; rays then meet nothing.
using RaySource = std::function<const RayTools*()>;
using AtlasSource = std::function<std::unique_ptr<const IrradianceAtlas>()>;
using HitRadianceSource = std::function<std::unique_ptr<const HitRadiance>()>;

/// Tells whether the cache keeps answers of occlusion() and indirectdiffuse() where a group asks for them
/// (GroupTraits::asksHemispheres).
bool keepsHemispheres(const GiSettings&);

class GiServices final : public ShadeServices {
 public:
  GiServices(const Scene& scene, const Camera& camera, const RayScene& rays, const ShadingSystem& shading,
             const GiSettings& settings, Stats& stats);
  GiServices(const Scene& scene, const Camera& camera, RaySource rays, const ShadingSystem& shading,
             const GiSettings& settings, Stats& stats);
  ~GiServices() override;

  /// Adds E in W/m2 at every point that the gather pass has served to the points of this world in FOLDER/points, and
  /// makes FOLDER/NAME.bkm from them, for GiMode::Baked. `world`: worldSum() of the scene. Throws FileError.
  void bake(const DeepFrame& layout, const TileReader& tiles, const std::filesystem::path& folder,
            const MapNames& names, uint64_t world) const;

  /// Has the gather pass keep what it has made, and take over what an interrupted run has. Null: nothing is kept.
  void useCheckpoint(Checkpoint* kept);

  /// Sets the maps that gather rays look up in GiMode::Atlas, before the gather pass, and shaded points in
  /// GiMode::Baked.
  void setAtlas(std::unique_ptr<const IrradianceAtlas> atlas);
  /// Sets a function that brings the atlas when the first point has to be gathered. Any thread may call it.
  void setAtlasSource(AtlasSource source);
  /// Sets the function that brings the radiance of what gather rays meet in GiMode::Radiosity.
  void setHitRadianceSource(HitRadianceSource source);
  /// Lets gatherPass() count photons, in GiMode::Reference and Progressive.
  void setPhotonPasses(PhotonPasses passes);
  void reportAtlas(Stats& stats) const;  ///< Adds statistics; called after the last lookup.

  /// Fills the irradiance cache for every point that a shaded frame will ask about, coarse to fine. Records of one
  /// level are frozen before the next reads them, and their order is that of the pixels, so the cache does not depend
  /// on threads or buckets. Every tile is read twice, or in every phase if the frame is very large. `covered`, if not
  /// empty, is called when the nearest points of every `stride`th pixel and row can be shaded without rays: 16, 8,
  /// 4, 2.
  void gatherPass(const DeepFrame& layout, const TileReader& tiles, const std::function<void(float)>& progress,
                  StopToken stop, const std::function<void(int stride)>& covered = {});

  /// Forgets all that gatherPass() has made. From now on, gatherPass() and shading use these settings. Maps stay, so
  /// the mode must be the same. Records are no longer kept for a later run.
  void startAgain(const GiSettings& settings);

  /// The cost of the bounce caches in the last gatherPass(). They have about as many records for a small part of the
  /// frame as for all of it.
  struct BounceCost {
    double rays = 0, time_s = 0;
  };
  BounceCost bounceCost() const;
  /// Reports how much light the bounces after those of the last gatherPass() would add, if that is known.
  void tellBouncesLeft(Log& log) const;

  /// Returns the caches of gatherPass(); frozen while shading.
  const std::vector<PreparedCache>& caches() const;
  std::vector<PreparedCache> takeCaches();  ///< Moves the caches out; none remain.
  /// Sets caches instead of a gather pass or before one. The gather pass then adds records where these leave points
  /// uncovered or, in a frame that they were not made for, where they disagree. anew: pixels whose records were
  /// removed.
  void useCaches(std::vector<PreparedCache> caches, std::optional<PixelRect> anew = {});
  /// Returns what gatherPass() has learnt besides the caches. With both, points that the caches do not serve get the
  /// same bits as in the run that gathered.
  std::shared_ptr<LearntLight> learnt() const;
  void useLearnt(std::shared_ptr<LearntLight> learnt);
  /// Has records keep the share of each of these groups of lights (LightTraits::group), so that they can be mixed. The
  /// first is empty and stands for surfaces that glow by themselves. Call it before the gather pass, or with caches
  /// whose records have these shares. It costs the shading of hits once for each group.
  void keepShares(std::vector<std::string> groups);
  const std::vector<std::string>& shareGroups() const;
  /// Sets the gains of the groups of lights, until they are set again. `gains` applies to the shares of records and
  /// answers that were given, and `ofNew` to light that is gathered anew. Empty: all are 1. Indirect light is then as
  /// if the lights were brighter by their gains, except that the dominant directions stay. Nothing may be shaded during
  /// the call.
  void mixShares(std::vector<vec3> gains, std::vector<vec3> ofNew = {});
  /// Draws the noise of each record anew, for points that are shaded with ShadeContext::redrawn. Nothing may be shaded
  /// during the call.
  void redrawRecords();
  /// Sets emitters, so that area lights can be sampled without geometry.
  void useEmitters(EmitterTable emitters);

  void transmission(const ShadePoints&, const uint8_t* active, TmConstVec3 toward, const ShadowRays&,
                    const ShadeContext&, TmVec3 light) const override;
  bool volumesBefore(const ShadePoints& points, const ShadeContext& context, ShadedPoints& out) const override;
  bool tracesFrom(const ShadePoints&, const RayQuery&, const ShadeContext&) const override;
  void trace(const ShadePoints&, const uint8_t* active, TmConstVec3 P, TmConstVec3 direction, const RayQuery&,
             const ShadeContext&, const RayResult&) const override;
  bool sampleEmitter(int light, int count, TmConstVec3 from, const float* xi0, const float* xi1,
                     const EmitterPoints& out) const override;
  bool sampleWholeEmitter(int light, int count, TmConstVec3 from, const float* xi0, const float* xi1,
                          const EmitterPoints& out) const override;
  void meetWholeEmitter(int light, int layer, int count, TmConstVec3 from, TmConstVec3 direction,
                        const EmitterPoints& out) const override;
  void meetEmitter(int light, int count, TmConstVec3 from, TmConstVec3 direction,
                   const EmitterPoints& out) const override;
  void storedIrradiance(const ShadePoints&, const uint8_t* active, TmVec3 E) const override;
  float emitterReach(int light) const override;
  float emitterArea(int light) const override;
  Bound3 emitterBound(int light) const override;
  bool interpolatedHemisphere(const ShadePoints&, const uint8_t* active, TmConstVec3 N, const HemisphereQuery&,
                              const ShadeContext&, TmVec3 out) const override;
  void indirectDiffuse(const ShadePoints&, const uint8_t* active, TmConstVec3 N, const IndirectQuery&,
                       const ShadeContext&, IndirectResult out) const override;
  bool followsLobes(const ShadeContext& context) const override;
  void indirectAlong(const ShadePoints& points, const uint8_t* active, const LobeDirection& way,
                     const IndirectQuery& query, const ShadeContext& context, TmVec3 out) const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales
