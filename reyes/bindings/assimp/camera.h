// The camera of a picture of a model. Spaces: the world is right-handed; RenderMan's camera space is left-handed, x
// right, y up, z into the picture.
#pragma once
#include <assimp/camera.h>

#include "reyes/bindings/assimp/rib_calls.h"

namespace tomales::model {

struct Camera {
  mat4 worldFromCamera{1.0f};
  float fov_degrees = 30;            ///< Along the shorter side of the picture.
  bool isAngleKnown = true;          ///< False: fov_degrees does not come from the model.
  float aspect = 4.0f / 3;           ///< Width over height.
  float orthographic_halfWidth = 0;  ///< Greater than 0: a parallel projection.
};

/// Corrects a camera that Assimp 5.2 has read from glTF. Assimp repeats the place of the camera's node as the place of
/// the camera within the node, and multiplies angles by the aspect instead of their tangents.
aiCamera gltfCamera(const aiCamera& camera);
Camera cameraOf(const aiCamera& camera, const mat4& worldFromNode);
/// Returns a camera that sees the box from above its front right corner (+z is in front), so that the box fills the
/// picture.
Camera cameraAround(const Bound3& box);

/// Returns requests for format, projection and the transformation from the world.
Requests requestsOf(const Camera& camera);

}  // namespace tomales::model
