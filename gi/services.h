// Composer: the ShadeServices that rays and global illumination stand behind (injected by reyes/app), and the gather
// pass that fills the irradiance cache from the deep frame buffer before anything is shaded.
#pragma once
#include "gi/atlas.h"
#include "gi/gather.h"
#include "gi/hit_radiance.h"
#include "raytrace/emitters.h"
#include "reyes/deep.h"

#include <atomic>
#include <functional>
#include <optional>

namespace tomales {

enum class GiMode {
  None,       ///< Direct light only: indirect lights give nothing.
  Gather,     ///< One bounce, shaded hits, irradiance caching.
  Atlas,      ///< All bounces: gather rays look up the irradiance that photons left in brick maps; irradiance caching.
  Radiosity,  ///< One bounce from what was baked of direct light, textures or brick maps; irradiance caching.
  Baked,      ///< All of it from brick maps of what was gathered for earlier frames (irradiance-atlas 6.3): no rays.
  Reference,  ///< Brute-force path tracing of the same transport: unbiased for diffuse surfaces.
};

struct GiSettings {
  GiMode mode = GiMode::Gather;
  int samples = 0;      ///< Rays per record, or paths per point of the reference; 0: as the indirect light asks.
  int bounces = 0;      ///< 0: as the indirect light asks (1 by default).
  float maxError = -1;  ///< As the `maxerror` of indirectlight; < 0: as the light asks.
  uint32_t seed = 0;
  std::optional<ErrorFunction> errorFunction{};  ///< None: as the light asks.
  bool storesDirect = true;  ///< GiMode::Atlas: its maps hold what comes straight from lights; else gather
                             ///< rays sample that where they hit.
};

/// Everything that decides the value of an irradiance record, and how far it may be used.
struct GatherPlan {
  CacheSettings cache;
  GatherSettings gather;
  bool operator==(const GatherPlan&) const = default;
};

struct PreparedCache {
  GatherPlan plan;
  IrradianceCache cache;
  std::vector<uint64_t> frames{};  ///< That it has been refined for: sums of what their pixels see.
};

/// What it takes to answer a ray.
struct RayTools {
  const RayScene* rays;
  const ShadingSystem* shading;  ///< Of the scene that the rays meet.
};
/// Asked when the first ray is wanted, from any thread: a shot from a file may never need its geometry. Null: there is
/// no geometry to be had, which has been reported; rays then meet nothing.
using RaySource = std::function<const RayTools*()>;
using AtlasSource = std::function<std::unique_ptr<const IrradianceAtlas>()>;
using RadiositySource = std::function<std::unique_ptr<const HitRadiance>()>;

/// Are answers of occlusion() kept where a group asks for it (ShadingSystem::asksOcclusion)?
bool keepsOcclusion(const GiSettings&);

class GiServices final : public ShadeServices {
 public:
  GiServices(const Scene& scene, const Camera& camera, const RayScene& rays, const ShadingSystem& shading,
             const GiSettings& settings, Stats& stats);
  GiServices(const Scene& scene, const Camera& camera, RaySource rays, const ShadingSystem& shading,
             const GiSettings& settings, Stats& stats);
  ~GiServices() override;

  /// Adds E at every point that the gather pass has served to what FOLDER/points has of this world, and makes
  /// FOLDER/NAME.bkm of it: for GiMode::Baked. `world`: worldSum() of the scene. Throws FileError.
  void bake(const DeepFrame& layout, const TileReader& tiles, const std::filesystem::path& folder,
            const MapNames& names, uint64_t world) const;

  /// What gather rays look up in GiMode::Atlas, before the gather pass; and points themselves in GiMode::Baked.
  void setAtlas(std::unique_ptr<const IrradianceAtlas> atlas);
  /// Or brought when the first point has to be gathered, from any thread.
  void setAtlasSource(AtlasSource source);
  /// Likewise for GiMode::Radiosity.
  void setRadiositySource(RadiositySource source);
  void reportAtlas(Stats& stats) const;  ///< After the last lookup.

  /// Fills the irradiance cache for every point that a shaded frame will ask about, coarse to fine. Records of one
  /// level are frozen before the next reads them, and their order is that of the pixels, so the cache does not depend
  /// on threads or buckets. Reads the tiles again in every phase. covered: told when the nearest points of every
  /// `stride`th pixel and row can be shaded without rays: 16, 8, 4, 2. May be empty.
  void gatherPass(const DeepFrame& layout, const TileReader& tiles, const std::function<void(float)>& progress,
                  const std::atomic<bool>* cancelled, const std::function<void(int stride)>& covered = {});

  /// What gatherPass has left; frozen while shading.
  const std::vector<PreparedCache>& caches() const;
  std::vector<PreparedCache> takeCaches();  ///< Leaves none.
  /// Instead of a gather pass, or before one: which then gathers what these records leave uncovered or, in a
  /// frame that is new to them, disagree about. anew: records have been taken out of these pixels.
  void useCaches(std::vector<PreparedCache> caches, std::optional<PixelRect> anew = {});
  /// So that area lights can be sampled without geometry.
  void useEmitters(EmitterTable emitters);

  void transmission(const ShadePoints&, const uint8_t* active, TmConstVec3 toward, const ShadowRays&,
                    const ShadeContext&, TmVec3 light) const override;
  void trace(const ShadePoints&, const uint8_t* active, TmConstVec3 P, TmConstVec3 direction, const RayQuery&,
             const ShadeContext&, const RayResult&) const override;
  bool sampleEmitter(int light, int count, TmConstVec3 from, const float* xi0, const float* xi1,
                     const EmitterPoints& out) const override;
  void meetEmitter(int light, int count, TmConstVec3 from, TmConstVec3 direction,
                   const EmitterPoints& out) const override;
  void storedIrradiance(const ShadePoints&, const uint8_t* active, TmVec3 E) const override;
  float emitterReach(int light) const override;
  bool interpolatedOcclusion(const ShadePoints&, const uint8_t* active, TmConstVec3 N, const OcclusionQuery&,
                             const ShadeContext&, float* covered) const override;
  void indirectDiffuse(const ShadePoints&, const uint8_t* active, TmConstVec3 N, const IndirectQuery&,
                       const ShadeContext&, IndirectResult out) const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales
