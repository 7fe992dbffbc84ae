// Private to gi: photons as they leave a sky, in proportion to its brightness in every direction, and most of
// them through its portals if it has any.
// Space: current. Power: W. Threads: const members may be called concurrently.
#pragma once
#include "gi/photons/emission.h"

namespace tomales {

/// Directions by weights of the cells of a sphere, each as large as what skies see of their pictures at once.
class SkyCells {
 public:
  static constexpr int kRows = 512, kColumns = 1024;
  struct Cell {
    size_t row, column;
  };

  /// `radiance`: at the corners of the cells, row by row. `share`: of a direction, what its radiance counts.
  template <class Share>
  SkyCells(const std::vector<float>& radiance, const Share& share);
  SkyCells() = default;

  /// Of radiance times share over all directions.
  double integral() const { return integral_; }
  vec3 sample(vec2 xi, Cell& cell) const;
  float density(const Cell& cell) const;  ///< Of sample(), over solid angle.

 private:
  Distribution rows_;
  std::vector<Distribution> row_;
  double integral_ = 0;
};

class SkyPhotons {
 public:
  SkyPhotons(int light, const ShadingSystem& shading, const RayScene& rays, const PhotonTarget& target);

  double power() const { return power_; }  ///< As PhotonSource::power().
  /// By two pairs of random numbers each.
  void emit(const std::vector<vec2>& a, const std::vector<vec2>& b, std::vector<EmittedPhoton>& out) const;

 private:
  struct Opening : Portal {
    float free[2];  ///< Of the sky before and behind it, what nothing is in the way of.
    float across(const vec3& toSky) const {
      const float area = dot(normal, toSky);
      return std::abs(area) * free[area < 0];
    }
  };
  float across(const vec3& toSky) const;
  vec3 onPortal(const vec3& toSky, vec2 xi) const;
  float portalDensity(const vec3& P, const vec3& toSky) const;
  vec3 onDisk(const vec3& toSky, const vec2& xi) const;

  const int light_;
  const ShadingSystem& shading_;
  const vec3 center_;   ///< Of the scene.
  const float radius_;  ///< Likewise
  std::vector<Opening> portals_;
  SkyCells open_, through_;  ///< Of photons by a disk before the whole scene, of those by portals.
  float share_ = 0;          ///< Of those by portals.
  double power_ = 0;
};

}  // namespace tomales
