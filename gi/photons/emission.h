// Private to gi: what sends photons, and photons as they leave it, in proportion to its emission, and only towards the
// scene. Space: current. Power: W. Threads: const members may be called concurrently.
#pragma once
#include <span>

#include "raytrace/trace.h"

namespace tomales {

/// Does the same as cosineHemisphere(), for many directions.
void cosineHemispheres(std::span<const vec2> xi, std::span<vec3> out);

/// Distance from the middle of the scene at which photons from outside begin, in radii of the scene.
constexpr float kOutside = 1.01f;

/// A photon that leaves a light, in current space.
struct EmittedPhoton {
  Ray ray;
  vec3 power{0.0f};         ///< Power of this photon if it were the only one; zero: the light sends nothing there.
  vec3 normal{0.0f};        ///< Normal of the surface that it leaves; zero: it leaves none.
  bool passesLamp = false;  ///< The geometry of its own lamp lets it pass, as it does shadow rays.
};

/// The part of the scene that photons are aimed at.
struct PhotonTarget {
  Bound3 bound;
  std::vector<Bound3> patchBounds;
  explicit PhotonTarget(const Scene& scene);
  vec3 center() const { return bound.center(); }
  float radius() const { return 0.5f * glm::length(bound.size()); }
};

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

}  // namespace tomales
