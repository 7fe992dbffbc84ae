// Private to gi: directions from a point light to the scene, in cells of equal solid angle. Space: current.
// Threads: const members may be called concurrently.
#pragma once
#include "reyes/base/math.h"

namespace tomales {

/// Directions from a light to the sphere around the scene. From outside the sphere only the cone around it counts,
/// however far away the light is. From within, all directions do.
class PhotonCone {
 public:
  static constexpr int kRows = 64, kColumns = 128;
  static constexpr size_t kCells = size_t{kRows} * kColumns;

  PhotonCone() = default;
  /// `light`: position relative to the middle of the scene. `radius`: that of the scene.
  PhotonCone(const vec3& center, const vec3& light, float radius);

  /// Returns a direction in the frame of the cone, with z = 1 - cos(theta) in place of cos(theta), so that narrow cones
  /// keep their precision.
  vec3 local(size_t cell, vec2 at) const;
  vec3 direction(const vec3& local) const { return frame_ * vec3(local.x, local.y, 1 - local.z); }
  vec3 place(const vec3& local, float distance) const;  ///< Place at this distance from the light.
  double cellSolidAngle() const;
  float start() const { return start_; }  ///< Distance from the light at which its photons begin.
  /// Returns the distance at which the light shader is evaluated. If the light is outside of the scene, it is evaluated
  /// at the scene, because the shader decides how light falls off.
  float askingDistance() const { return distance_ > 0 ? distance_ : 1.0f; }

 private:
  mat3 frame_{1.0f};  ///< The third axis points to the scene.
  /// Origin of places: the light, or the middle of the scene if the light is outside, however far away.
  vec3 origin_{0.0f};
  float height_ = 2;    ///< 1 - cos of the cone's half angle.
  float distance_ = 0;  ///< Distance of the light from the middle of the scene; 0: it is within the scene.
  float start_ = 0;
};

}  // namespace tomales
