// Private to gi: directions from a point light to the scene, in cells of equal solid angle. Space: current.
// Threads: const members may be called concurrently.
#pragma once
#include "reyes/base/math.h"

namespace tomales {

/// From outside a sphere around the scene only the cone to it counts, however far away the light is; from
/// within, all directions do.
class PhotonCone {
 public:
  static constexpr int kRows = 64, kColumns = 128;
  static constexpr size_t kCells = size_t{kRows} * kColumns;

  PhotonCone() = default;
  /// `light`: from the middle of the scene. `radius`: of the scene.
  PhotonCone(const vec3& center, const vec3& light, float radius);

  /// A direction in the frame of the cone, but for its height, of which it is what is missing from 1: narrow
  /// cones keep their precision.
  vec3 local(size_t cell, vec2 at) const;
  vec3 direction(const vec3& local) const { return frame_ * vec3(local.x, local.y, 1 - local.z); }
  vec3 place(const vec3& local, float distance) const;  ///< So far from the light.
  double cellSolidAngle() const;
  float start() const { return start_; }  ///< How far from the light its photons begin.
  /// Where the light is asked: at the scene if it is outside, as what its distance does to it is its shader's
  /// affair.
  float askingDistance() const { return distance_ > 0 ? distance_ : 1.0f; }

 private:
  mat3 frame_{1.0f};  ///< The third axis towards the scene.
  /// Of places: the light, or the middle of the scene if the light is outside, far away as it may be.
  vec3 origin_{0.0f};
  float height_ = 2;    ///< 1 - the cosine of half its angle.
  float distance_ = 0;  ///< Of the light from the middle of the scene. 0: it is within.
  float start_ = 0;
};

}  // namespace tomales
