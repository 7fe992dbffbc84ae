// Composer: single-bounce light from brick maps instead of photons (Christensen and Batali 2004, section 6.3). The
// radiosity by direct light is baked as points all over the surfaces, visible or not, as finely as in radiosity maps;
// brick maps of the points answer gather rays.
//   FOLDER/radiosity/NAME.ptc  ->  FOLDER/radiosity/NAME.bkm      NAME as in gi/atlas_files.h
// The channel "radiosity" holds pi L in W/m2, in world space. The camera of the frame that first bakes decides how fine
// the points are. Threads: lookup() may be called concurrently.
#pragma once
#include "gi/atlas.h"
#include "gi/radiosity/maps.h"

namespace tomales {

struct RadiosityBrickSettings {
  RadiositySettings points;
  /// maxError is a share of the map's mean, as for the atlas; bricks are as fine as the points.
  BrickSettings bricks{.maxError = 0.03f};
  size_t cacheBytes = BrickCache::kDefaultBytes;
};

class RadiosityBricks final : public HitRadiance {
 public:
  /// Bakes what the folder does not yet hold of this world (names.world is that of all objects). Throws FileError.
  RadiosityBricks(const std::filesystem::path& folder, const RayTools& tools, const Camera& camera,
                  const MapNames& names, const RadiosityBrickSettings& settings, Stats& stats, Log& log);

  bool lookup(const Ray& ray, const Hit& hit, vec3& radiance) const override;
  void report(Stats& stats) const override;

 private:
  const Scene& scene_;
  std::vector<uint8_t> sides_;  ///< The sides of each object that have points.
  std::unique_ptr<const IrradianceAtlas> maps_;
};

}  // namespace tomales
