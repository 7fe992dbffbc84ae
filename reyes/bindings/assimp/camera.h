// The camera of a picture of a model. Spaces: the world is right-handed; RenderMan's camera space is left-handed, x
// right, y up, z into the picture.
#pragma once
#include <assimp/camera.h>

#include "reyes/bindings/assimp/rib_calls.h"

namespace tomales::model {

struct Camera {
  mat4 worldFromCamera{1.0f};
  float fov_degrees = 30;            ///< Along the shorter side of the picture.
  bool isAngleKnown = true;          ///< False: fov_degrees is not that of the model.
  float aspect = 4.0f / 3;           ///< Width over height.
  float orthographic_halfWidth = 0;  ///< Greater than 0: a parallel projection.
};

/// Returns the camera that glTF means by one that Assimp 5.2 has read. Assimp repeats the place of the camera's node as
/// that of the camera within the node, and multiplies angles by the aspect, not their tangents.
aiCamera gltfCamera(const aiCamera& camera);
Camera cameraOf(const aiCamera& camera, const mat4& worldFromNode);
/// Looks at the box from above its front right corner (+z is in front), so that it fills the picture.
Camera cameraAround(const Bound3& box);

/// Format, projection and the transformation from the world.
Requests requestsOf(const Camera& camera);

}  // namespace tomales::model
