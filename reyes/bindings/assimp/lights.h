// Lights of a model, and those that it gets if it has none. Units: docs/import.md. Space: the right-handed world.
#pragma once
#include <assimp/scene.h>

#include "reyes/bindings/assimp/nodes.h"
#include "reyes/bindings/assimp/rib_calls.h"

namespace tomales::model {

struct LightSettings {
  Bound3 world;         ///< What is lit.
  float scale = 0;      ///< Multiplies all; 0: as lights() finds it.
  bool isGltf = false;  ///< Intensities are candela and lux, and cones are told by half their angles.
};

struct Lights {
  Requests requests;
  float scale = 1;  ///< That they were multiplied by.
  int unknown = 0;  ///< Those whose kind Assimp does not tell, such as areas of .fbx.
};

/// Those of the model. Scale 0: 1 if they bring between 0.3 and 3 (E/pi) to the middle of the world, all shadows left
/// out, else what makes that 1.
Lights lightsOf(const aiScene& scene, const Nodes& nodes, const LightSettings& settings);

/// A sun from the upper left behind the camera, and a sky.
Requests studioLights(const mat4& worldFromCamera);

}  // namespace tomales::model
