// Verb: photons from the lights through the scene (Christensen and Batali 2004, section 4). Each photon that arrives on
// a diffuse surface is stored; Russian roulette decides which go on, so that powers stay even. In a medium photons are
// stored where they collide (gi/photons/medium.h). What a photon flies through is the Interior or Exterior of the
// surface that it flies to, whichever lies on the side that it comes from. Power: W. Space: current. Threads: uses the
// pool; the photons are the same for any number of threads.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "raytrace/trace.h"

namespace tomales {

/// Surfaces at which a photon may arrive if nobody sets a number. Roulette by the albedo of the surfaces ends most
/// paths before that: at a mean albedo of 0.93, 1 % of the light is left then.
constexpr int kEnoughBounces = 64;

constexpr int kNoBounceLimit = 1 << 20;  ///< More bounces than any photon has.

struct PhotonSettings {
  int64_t emit = 1'000'000;  ///< Photons of all lights together.
  /// Most surfaces that a photon may arrive at; collisions in media count as well. 0: kEnoughBounces.
  int maxDepth = 0;
  uint32_t seed = 0;
  /// Store photons that come straight from a light, too. Without them, whoever looks the irradiance up has to sample
  /// the lights.
  bool direct = true;
  /// Trace only the paths whose first surface, beside transparent ones, is mirror or glass. All others end at their
  /// first diffuse surface.
  bool specularFirstOnly = false;
  int mostBounces = kNoBounceLimit;  ///< Photons that have bounced more often (StoredPhoton::bounces) are not traced.
};

struct StoredPhoton {
  /// Unit normal of the polygon that P lies on, towards the side that the photon came from; zero in a medium.
  vec3 P, N;
  vec3 power;  ///< Power in W. In a medium it is the power times the free path, in W m (lengths of the world).
  int group;   ///< Index into Scene::groups; -1: in a medium.
  int depth;   ///< 0: straight from a light.
  /// The diffuse surfaces and collisions on its path, and one more if mirrors or glass come before the first of them. A
  /// path tracer finds the same light after as many diffuse rays (docs/gi.md).
  int bounces;
  bool specularFirst;  ///< Mirrors or glass come before the first diffuse surface of its path.

  /// A caustic path, L S+ D (Heckbert 1990).
  bool caustic() const { return specularFirst && bounces == 1; }
};

constexpr int kMostParts = 4096;
/// One part of work that several processes share: number `index` of `count` from 0.
struct WorkPart {
  int index = 0, count = 1;
};

struct PhotonFigures {
  int64_t emitted = 0, stored = 0;
  /// The share of the light between surfaces that is missing, because it comes after the last bounce. It is estimated
  /// from the powers of the last two arrivals, and reported as "photons-bounces".
  double left = 0;
};

/// Traces photons and hands those that arrive to `store`. One thread at a time calls it, in an order that does not
/// depend on threads. The photons of all parts, one part after the other, are those of the whole. `progress` gets the
/// share that is done. A scene without light gives no photons, with a warning.
PhotonFigures tracePhotons(const Scene& scene, const RayScene& rays, const ShadingSystem& shading,
                           const PhotonSettings& settings,
                           const std::function<void(std::span<const StoredPhoton>)>& store,
                           const std::function<void(float)>& progress, Stats& stats, Log& log, WorkPart part = {});

/// Attribute "photon" "shadingmodel": what a surface does to photons.
enum class PhotonModel {
  Matte,        ///< Diffuse, by the surface shader; photons are stored.
  Translucent,  ///< Diffuse; half of the scattered light goes through. Photons are stored.
  Chrome,       ///< Mirrors, tinted by the object's colour.
  Glass,        ///< Reflects and refracts by Fresnel's law, with index 1.5.
  Water,        ///< The same with index 1.33.
  Transparent,  ///< Passes straight on, tinted.
};
/// Returns nothing if there is no model of this name.
std::optional<PhotonModel> photonModel(const std::string& name);
/// Tells whether photons are mirrored or refracted by surfaces of this model.
constexpr bool isMirrorOrGlass(PhotonModel m) {
  return m == PhotonModel::Chrome || m == PhotonModel::Glass || m == PhotonModel::Water;
}

/// Tells whether photons are mirrored or refracted by objects with these attributes.
bool isSpecularForPhotons(const Attributes& attributes);

}  // namespace tomales
