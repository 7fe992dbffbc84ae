// Verb: photons from the lights through the scene (irradiance-atlas 4). Each photon that arrives on a diffuse
// surface is stored; what goes on is decided by Russian roulette, so that powers stay even. In a medium
// (gi/medium.h: what the Interior or Exterior of the surface that a photon flies to says of that side of it)
// photons are stored where they collide. Power: W. Space: current. Same photons for any number of threads.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "raytrace/trace.h"

namespace tomales {

struct PhotonSettings {
  int64_t emit = 1'000'000;  ///< Of all lights together.
  int maxDepth = 10;         ///< Most surfaces that a photon may arrive at; being scattered counts as well.
  uint32_t seed = 0;
  bool direct = true;  ///< Store those that come straight from a light, too: else who looks their irradiance
                       ///< up samples lights himself.
};

struct StoredPhoton {
  vec3 P, N;     ///< N: unit, of the polygon that P lies on, towards the side that the photon came from; zero:
                 ///< in a medium.
  vec3 power;    ///< In a medium times the free path there, in lengths of the world: W m.
  int group;     ///< Of Scene::groups; -1: in a medium.
  int depth;     ///< 0: straight from a light.
  bool caustic;  ///< It has met mirrors and glass alone on its way, and at least one.
};

struct PhotonFigures {
  int64_t emitted = 0, stored = 0;
};

/// `store` is called by one thread at a time, in an order that no thread decides. A scene without light gives
/// nothing, with a warning.
PhotonFigures tracePhotons(const Scene& scene, const RayScene& rays, const ShadingSystem& shading,
                           const PhotonSettings& settings,
                           const std::function<void(std::span<const StoredPhoton>)>& store,
                           const std::function<void(float)>& progress, Stats& stats, Log& log);

/// Attribute "photon" "shadingmodel": what a surface does to photons.
enum class PhotonModel {
  Matte,        ///< Diffuse, by the surface shader: stored.
  Translucent,  ///< Likewise, and half of it goes through.
  Chrome,       ///< Mirrors, tinted by the object's colour.
  Glass,
  Water,        ///< Reflects and refracts by Fresnel's law (index 1.5, 1.33).
  Transparent,  ///< Passes straight on, tinted.
};
/// Empty: there is no such model.
std::optional<PhotonModel> photonModel(const std::string& name);

}  // namespace tomales
