// The lights of a model, or default lights if it has none. Units: docs/import.md. Space: the right-handed world.
#pragma once
#include <assimp/scene.h>

#include "reyes/bindings/assimp/nodes.h"
#include "reyes/bindings/assimp/rib_calls.h"

namespace tomales::model {

struct LightSettings {
  Bound3 world;         ///< Bound of the world that is lit.
  float scale = 0;      ///< Multiplies all lights; 0: lightsOf() chooses it.
  bool isGltf = false;  ///< Intensities are in candela and lux, and cones are given by their half angles.
};

struct Lights {
  Requests requests;
  float scale = 1;  ///< Factor that all lights were multiplied by.
  int unknown = 0;  ///< Number of lights whose kind Assimp does not know, such as area lights of .fbx.
};

/// Returns the lights of the model. If the given scale is 0, it is 1 if their E/pi in the middle of the world, without
/// shadows, is between 0.3 and 3; otherwise it is the scale that makes this 1.
Lights lightsOf(const aiScene& scene, const Nodes& nodes, const LightSettings& settings);

/// Returns a sun from the upper left behind the camera, and a sky.
Requests studioLights(const mat4& worldFromCamera);

}  // namespace tomales::model
