// Private to gi: photons as they leave a sky, in proportion to its brightness in every direction, and most of them
// through its portals if it has any. Space: current. Power: W. Threads: const members may be called concurrently.
#pragma once
#include "gi/photons/light_photons.h"

namespace tomales {

/// A distribution of directions over weighted cells of the sphere. A sky that has a picture filters it over about one
/// cell for each direction.
class SkyCells {
 public:
  static constexpr int kRows = kSkyRows, kColumns = kSkyColumns;
  struct Cell {
    size_t row, column;
  };

  /// `radiance`: at the corners of the cells, row by row. `share`: factor on the radiance, by direction.
  template <class Share>
  SkyCells(const std::vector<float>& radiance, const Share& share);
  SkyCells() = default;

  /// Returns the integral of radiance times share over all directions.
  double integral() const { return integral_; }
  vec3 sample(vec2 xi, Cell& cell) const;
  float pdf(const Cell& cell) const;  ///< Density of sample() over solid angle.

 private:
  Distribution rows_;
  std::vector<Distribution> row_;
  double integral_ = 0;
};

class SkyPhotons final : public LightPhotons {
 public:
  SkyPhotons(int light, const ShadingSystem& shading, const RayScene& rays, const PhotonTarget& target);

 private:
  void emitBy(const StartNumbers& xi, std::vector<EmittedPhoton>& out) const override;
  struct Opening : Portal {
    float free[2];  ///< Share of the sky before and behind the portal that nothing hides.
    float across(const vec3& toSky) const {
      const float area = dot(normal, toSky);
      return std::abs(area) * free[area < 0];
    }
  };
  float across(const vec3& toSky) const;
  vec3 onPortal(const vec3& toSky, vec2 xi) const;
  float portalPdf(const vec3& P, const vec3& toSky) const;
  vec3 onDisk(const vec3& toSky, const vec2& xi) const;

  std::vector<Opening> portals_;
  /// Directions of photons that start on a disk before the whole scene, and of those through portals.
  SkyCells open_, through_;
  float share_ = 0;  ///< Share of photons through portals.
};

}  // namespace tomales
