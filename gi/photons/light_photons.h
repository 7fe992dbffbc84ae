// Private to gi: photons of point lights, distant lights and area lights. Those of skies are in gi/photons/sky.h. A
// light shader's Cl is E/pi at normal incidence (RSL's convention), so E = pi Cl. Space: current. Power: W. Threads:
// const members may be called concurrently.
#pragma once
#include "gi/photons/cone.h"
#include "gi/photons/emission.h"
#include "reyes/base/distribution.h"

namespace tomales {

/// Returns the source of a light's photons; null if its kind sends none.
std::unique_ptr<const PhotonSource> photonsOf(int light, const ShadingSystem&, const RayScene&, const PhotonTarget&);

/// What the sources of all kinds of lights have.
class LightPhotons : public PhotonSource {
 public:
  int light() const override { return light_; }
  double power() const override { return power_; }
  void emit(uint32_t first, uint32_t seed, std::vector<EmittedPhoton>& out) const override;

 protected:
  LightPhotons(int light, const ShadingSystem& shading, const PhotonTarget& target);
  /// Emits one photon for each element of `xi`, which holds two pairs of random numbers.
  virtual void emitBy(const StartNumbers& xi, std::vector<EmittedPhoton>& out) const = 0;
  /// Evaluates the light at the center of the scene.
  LightProbe probeFromCenter(const std::vector<vec2>& xi) const;

  const int light_;
  const ShadingSystem& shading_;
  const vec3 center_;   ///< Center of the scene.
  const float radius_;  ///< Radius of the scene.
  double power_ = 0;
};

class PointPhotons final : public LightPhotons {
 public:
  PointPhotons(int light, const ShadingSystem& shading, const PhotonTarget& target);

 private:
  void emitBy(const StartNumbers& xi, std::vector<EmittedPhoton>& out) const override;
  void askAlong(const vec3& local, const vec3& offset, LightProbe& probe) const;
  vec3 intensity(const LightProbe& probe, size_t i) const;

  bool hasExtent_ = false;  ///< Each photon draws its own place.
  vec3 middle_{0.0f};       ///< From the center of the scene to the middle of the light.
  PhotonCone cone_;         ///< The cone of directions.
  Distribution cells_;      ///< Its cells.
};

class DistantPhotons final : public LightPhotons {
 public:
  DistantPhotons(int light, const ShadingSystem& shading, const PhotonTarget& target);

 private:
  void emitBy(const StartNumbers& xi, std::vector<EmittedPhoton>& out) const override;
  /// Evaluates the light at the center of the scene; L is a unit vector.
  LightProbe directionsFromCenter(const std::vector<vec2>& xi) const;

  bool hasExtent_ = false;  ///< Each photon draws its own direction.
  vec3 direction_{0.0f};    ///< The middle direction of the light.
  Distribution cells_;      ///< Cells of the square that the shadow of the scene fits in.
};

class AreaPhotons final : public LightPhotons {
 public:
  AreaPhotons(int light, const ShadingSystem& shading, const RayScene& rays, const PhotonTarget& target);

 private:
  void emitBy(const StartNumbers& xi, std::vector<EmittedPhoton>& out) const override;

  const RayScene& rays_;
};

}  // namespace tomales
