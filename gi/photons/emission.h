// Private to gi: photons as they leave a light, in proportion to its emission, and only towards the scene. Power: W. A
// light shader's Cl is E/pi at normal incidence (RSL's convention), so E = pi Cl. Threads: const members may be called
// concurrently.
#pragma once
#include <span>

#include "gi/photons/cone.h"
#include "raytrace/trace.h"
#include "reyes/base/distribution.h"

namespace tomales {

/// Does the same as cosineHemisphere(), for many directions.
void cosineHemispheres(std::span<const vec2> xi, std::span<vec3> out);

/// Distance from the middle of the scene at which photons from outside begin, in radii of the scene.
constexpr float kOutside = 1.01f;

/// A photon that leaves a light, in current space.
struct EmittedPhoton {
  Ray ray;
  vec3 power{0.0f};   ///< Power of this photon if it were the only one; zero: the light sends nothing there.
  vec3 normal{0.0f};  ///< Normal of the surface that it leaves; zero: it leaves none.
};

/// The part of the scene that photons are aimed at.
struct PhotonTarget {
  Bound3 bound;
  std::vector<Bound3> objects;
  explicit PhotonTarget(const Scene& scene);
  vec3 center() const { return bound.center(); }
  float radius() const { return 0.5f * glm::length(bound.size()); }
};

class SkyPhotons;

/// Two pairs of random numbers for each photon, each pair stratified over all photons of a source and unrelated to the
/// other. `stream` names the source.
struct StartNumbers {
  std::vector<vec2> a, b;
};
StartNumbers startNumbers(uint32_t first, uint32_t stream, size_t count);

class PhotonSource {
 public:
  virtual ~PhotonSource() = default;
  /// Returns the index of the light; -1: surfaces that glow by their shaders.
  virtual int light() const = 0;
  /// Estimated emitted power in W, by which photons are shared out; 0: none is emitted.
  virtual double power() const = 0;
  /// Emits photons `first` .. first + out.size() - 1 of this source.
  virtual void emit(uint32_t first, uint32_t seed, std::vector<EmittedPhoton>& out) const = 0;
};

class LightPhotons : public PhotonSource {
 public:
  LightPhotons(int light, const ShadingSystem& shading, const RayScene& rays, const PhotonTarget& target);

  int light() const override { return light_; }
  double power() const override { return power_; }
  void emit(uint32_t first, uint32_t seed, std::vector<EmittedPhoton>& out) const override;

 private:
  void surveyPoint();
  void surveyDistant(const PhotonTarget& target);
  void surveyArea();
  void askAlong(const vec3& local, const vec3& offset, LightProbe& probe) const;
  vec3 intensity(const LightProbe& probe, size_t i) const;
  /// Evaluates the light at the middle of the scene; L of a distant light is a unit vector.
  LightProbe askedFromMiddle(const std::vector<vec2>& xi) const;
  void emitFromPoint(const std::vector<vec2>& a, const std::vector<vec2>& b, std::vector<EmittedPhoton>& out) const;
  void emitFromDistance(const std::vector<vec2>& a, const std::vector<vec2>& b, std::vector<EmittedPhoton>& out) const;
  void emitFromArea(const std::vector<vec2>& a, const std::vector<vec2>& b, std::vector<EmittedPhoton>& out) const;

  const int light_;
  const ShadingSystem& shading_;
  const RayScene& rays_;
  const LightKind kind_;
  double power_ = 0;
  std::shared_ptr<const SkyPhotons> sky_;  ///< Set for a sky alone.
  bool isDrawn_ = false;                   ///< Point, Distant: each photon draws its own place or direction.
  Distribution cells_;    ///< Point: cells of the cone. Distant: cells of the square that the scene's shadow fits in.
  vec3 middle_{0.0f};     ///< Point: from the middle of the scene to the middle of the light.
  PhotonCone cone_;       ///< Point: the cone of directions.
  vec3 direction_{0.0f};  ///< Distant: the middle direction of its light.
  vec3 center_{0.0f};     ///< Center of the scene.
  float radius_ = 0;      ///< Radius of the scene.
};

}  // namespace tomales
