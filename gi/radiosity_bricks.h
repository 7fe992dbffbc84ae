// Composer: single-bounce light from brick maps instead of photons (irradiance-atlas 6.3). What surfaces send back of
// direct light is baked as points all over them, seen or not, as finely as radiosity maps are; brick maps of those
// answer gather rays.
//   FOLDER/radiosity/NAME.ptc  ->  FOLDER/radiosity/NAME.bkm      NAME as in gi/atlas.h
// Channel "radiosity": pi L in W/m2, world space. The camera of the frame that first bakes decides how fine they are.
#pragma once
#include "gi/atlas.h"
#include "gi/radiosity_maps.h"

namespace tomales {

struct RadiosityBrickSettings {
  RadiositySettings points;
  BrickSettings bricks{0.03f};  ///< maxError: a share of the map's mean, as of the atlas; as fine as the points
};

class RadiosityBricks final : public HitRadiance {
 public:
  /// Bakes what the folder does not hold yet of this world (names.world: of all objects). Throws FileError.
  RadiosityBricks(const std::filesystem::path& folder, const RayScene& rays, const ShadingSystem& shading,
                  const Camera& camera, const MapNames& names, const RadiosityBrickSettings& settings,
                  size_t cacheBytes, Stats& stats, Log& log);

  bool lookup(const Ray& ray, const Hit& hit, vec3& radiance) const override;
  void report(Stats& stats) const override;

 private:
  const Scene& scene_;
  std::vector<uint8_t> sides_;  ///< Of each object, that have points.
  std::unique_ptr<const IrradianceAtlas> maps_;
};

}  // namespace tomales
