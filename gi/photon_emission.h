// Private to gi: photons as they leave a light, in proportion to what it sends, and only where the scene is.
// Power: W, of RSL's convention E/pi = Cl: a light shader's Cl is irradiance over pi at normal incidence, so E = pi Cl.
// Threads: const members may be called concurrently.
#pragma once
#include "raytrace/trace.h"
#include "reyes/base/distribution.h"

namespace tomales {

/// Current space.
struct EmittedPhoton {
  Ray ray;
  vec3 power{0.0f};  ///< As if this were the only photon; zero: the light sends nothing there.
};

/// What photons are aimed at.
struct PhotonTarget {
  Bound3 bound;
  std::vector<Bound3> objects;
  explicit PhotonTarget(const Scene& scene);
  vec3 center() const { return bound.center(); }
  float radius() const { return 0.5f * glm::length(bound.size()); }
};

class PhotonSource {
 public:
  PhotonSource(int light, const ShadingSystem& shading, const RayScene& rays, const PhotonTarget& target);

  int light() const { return light_; }
  double power() const { return power_; }  ///< Estimate, W; what photons are shared out by. 0: the light emits none.

  /// Photons number `first` .. first + out.size() - 1 of this light.
  void emit(uint32_t first, uint32_t seed, std::vector<EmittedPhoton>& out) const;

 private:
  void surveyPoint();
  void surveyDistant(const PhotonTarget& target);
  void surveySky();
  void surveyArea();
  /// At the middle of the scene; L of a distant light is unit.
  LightProbe askedFromMiddle(const std::vector<vec2>& xi) const;
  void emitFromPoint(const std::vector<vec2>& a, const std::vector<vec2>& b, std::vector<EmittedPhoton>& out) const;
  void emitFromDistance(const std::vector<vec2>& a, const std::vector<vec2>& b, std::vector<EmittedPhoton>& out) const;
  void emitFromSky(const std::vector<vec2>& a, const std::vector<vec2>& b, std::vector<EmittedPhoton>& out) const;
  void emitFromArea(const std::vector<vec2>& a, const std::vector<vec2>& b, std::vector<EmittedPhoton>& out) const;

  const int light_;
  const ShadingSystem& shading_;
  const RayScene& rays_;
  const LightKind kind_;
  double power_ = 0;
  Distribution cells_;      ///< Point, Sky: of the sphere of directions. Distant: of the square that the scene's shadow fits in.
  vec3 position_{0.0f};     ///< Point: of its middle.
  vec3 direction_{0.0f};    ///< Distant: of the middle of its light.
  vec3 center_{0.0f};       ///< Of the scene.
  float radius_ = 0;        ///< Likewise
};

}  // namespace tomales
