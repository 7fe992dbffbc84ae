// Private to gi: photons as they leave a sky, in proportion to its brightness in every direction, and most of them
// through its portals if it has any. Space: current. Power: W. Threads: const members may be called concurrently.
#pragma once
#include "gi/photons/emission.h"

namespace tomales {

/// A distribution of directions over weighted cells of the sphere. A sky that has a picture filters it over about one
/// cell for each direction.
class SkyCells {
 public:
  static constexpr int kRows = 512, kColumns = 1024;
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

class SkyPhotons {
 public:
  SkyPhotons(int light, const ShadingSystem& shading, const RayScene& rays, const PhotonTarget& target);

  double power() const { return power_; }  ///< The same as PhotonSource::power().
  /// Each photon takes a pair of random numbers from a and one from b.
  void emit(const std::vector<vec2>& a, const std::vector<vec2>& b, std::vector<EmittedPhoton>& out) const;

 private:
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

  const int light_;
  const ShadingSystem& shading_;
  const vec3 center_;   ///< Center of the scene.
  const float radius_;  ///< Radius of the scene.
  std::vector<Opening> portals_;
  /// Directions of photons that start on a disk before the whole scene, and of those through portals.
  SkyCells open_, through_;
  float share_ = 0;  ///< Share of photons through portals.
  double power_ = 0;
};

}  // namespace tomales
