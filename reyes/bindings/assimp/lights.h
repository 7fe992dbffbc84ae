// Lights of a model, and those that it gets if it has none. Units: docs/import.md. Space: the right-handed world.
#pragma once
#include <assimp/scene.h>

#include "reyes/bindings/assimp/nodes.h"
#include "reyes/bindings/assimp/rib_calls.h"

namespace tomales::model {

struct LightSettings {
  Bound3 world;         ///< Bound of the world that is lit.
  float scale = 0;      ///< Multiplies all; 0: as lights() finds it.
  bool isGltf = false;  ///< Intensities are candela and lux, and cones are told by half their angles.
};

struct Lights {
  Requests requests;
  float scale = 1;  ///< Factor that all lights were multiplied by.
  int unknown = 0;  ///< Number of lights whose kind Assimp does not tell, such as areas of .fbx.
};

/// Returns the lights of the model. If the given scale is 0, theirs is 1 if they bring between 0.3 and 3 (E/pi) to the
/// middle of the world without shadows. Otherwise it is the scale with which they bring 1.
Lights lightsOf(const aiScene& scene, const Nodes& nodes, const LightSettings& settings);

/// Returns a sun from the upper left behind the camera, and a sky.
Requests studioLights(const mat4& worldFromCamera);

}  // namespace tomales::model
