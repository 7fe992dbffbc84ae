// Private to reyes/image: metadata of files about the camera.
#pragma once
#include <vector>

#include "reyes/image.h"
#include "reyes/image/image_file.h"

namespace tomales {

Metadata matrixEntry(const char* name, const mat4& m);
/// Returns standard attributes of OpenEXR (ImfStandardAttributes.h): world to NDC gives (0, 0) at the top left of the
/// display window and (1, 1) at the bottom right.
std::vector<Metadata> cameraOf(const View& view);

}  // namespace tomales
