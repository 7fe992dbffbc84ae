// Private to gi: photons as they leave a light, in proportion to what it sends, and only where the scene is.
// Power: W, of RSL's convention E/pi = Cl: a light shader's Cl is irradiance over pi at normal incidence, so
// E = pi Cl. Threads: const members may be called concurrently.
#pragma once
#include <span>

#include "gi/photon_cone.h"
#include "raytrace/trace.h"
#include "reyes/base/distribution.h"

namespace tomales {

/// As cosineHemisphere(), of each.
void cosineHemispheres(std::span<const vec2> xi, std::span<vec3> out);

/// From the middle of the scene to where photons from outside begin, in radii.
constexpr float kOutside = 1.01f;

/// Current space.
struct EmittedPhoton {
  Ray ray;
  vec3 power{0.0f};   ///< As if this were the only photon; zero: the light sends nothing there.
  vec3 normal{0.0f};  ///< Of the surface that it leaves; zero: it comes from the air.
};

/// What photons are aimed at.
struct PhotonTarget {
  Bound3 bound;
  std::vector<Bound3> objects;
  explicit PhotonTarget(const Scene& scene);
  vec3 center() const { return bound.center(); }
  float radius() const { return 0.5f * glm::length(bound.size()); }
};

class SkyPhotons;

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
  void surveyArea();
  void askAlong(const vec3& local, const vec3& offset, LightProbe& probe) const;
  vec3 intensity(const LightProbe& probe, size_t i) const;
  /// At the middle of the scene; L of a distant light is unit.
  LightProbe askedFromMiddle(const std::vector<vec2>& xi) const;
  void emitFromPoint(const std::vector<vec2>& a, const std::vector<vec2>& b, std::vector<EmittedPhoton>& out) const;
  void emitFromDistance(const std::vector<vec2>& a, const std::vector<vec2>& b, std::vector<EmittedPhoton>& out) const;
  void emitFromArea(const std::vector<vec2>& a, const std::vector<vec2>& b, std::vector<EmittedPhoton>& out) const;

  const int light_;
  const ShadingSystem& shading_;
  const RayScene& rays_;
  const LightKind kind_;
  double power_ = 0;
  std::shared_ptr<const SkyPhotons> sky_;  ///< Sky alone.
  bool isDrawn_ = false;                   ///< Point, Distant: its place or direction is another for every photon.
  Distribution cells_;                     ///< Point: of the cone. Distant: of the square that
                                           ///< the scene's shadow fits in.
  vec3 middle_{0.0f};                      ///< Point: from the middle of the scene to that of the light.
  PhotonCone cone_;                        ///< Point: of directions.
  vec3 direction_{0.0f};                   ///< Distant: of the middle of its light.
  vec3 center_{0.0f};                      ///< Of the scene.
  float radius_ = 0;                       ///< Likewise
};

}  // namespace tomales
