// Scenes of which the light of all photons is known.
#pragma once
#include "tests/unit/gi/fixture.h"

namespace tomales::test {

// Inside a sphere, a light in the middle gives pi I / R^2 everywhere, and all bounces together 1 / (1 - rho)
// times that.
inline constexpr float kSphereRadius = 2, kSphereAlbedo = 0.5f, kSphereIntensity = 3;
inline constexpr double kSpherePower = 4 * double{kPi} * double{kPi} * double{kSphereIntensity};

inline Scene insideOfASphere(const std::string& model = "matte", float tessellation = 1) {
  SceneBuilder b;
  b.light("pointlight", {floatParam("intensity", kSphereIntensity), pointParam("from", {0.3f, 0, 0.5f})});
  b.light("indirectlight", {});
  b.sphere(kSphereRadius, vec3(kSphereAlbedo), {0, 0, 0.5f});
  auto attributes = std::make_shared<Attributes>(*b.scene.objects[0].attributes);
  attributes->photon.shadingModel = model;
  attributes->trace.tessellation = tessellation;
  b.scene.objects[0].attributes = attributes;
  return b.scene;
}

/// A ball of radius 1 around (0, 0, 4) that photons fly through, with a medium in it that the first light
/// lights.
inline SceneBuilder cloud(const vec3& scattering, const vec3& absorption) {
  SceneBuilder b;
  b.sphere(1, vec3(1), {0, 0, 4});
  auto attributes = std::make_shared<Attributes>(*b.scene.objects[0].attributes);
  attributes->photon.shadingModel = "transparent";
  const auto color = [](const char* name, const vec3& c) {
    return Param{name, Storage::Uniform, ValueType::Color, 1, {c.x, c.y, c.z}, {}, {}};
  };
  attributes->interior =
      std::make_shared<ShaderCall>(call("fog", {color("scattering", scattering), color("absorption", absorption)}));
  attributes->lights = {0};
  b.scene.objects[0].attributes = attributes;
  return b;
}

}  // namespace tomales::test
