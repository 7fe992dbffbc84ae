// Colours that a .ply file gives to faces, which Assimp 5.2 does not read. Threads: plain function.
#pragma once
#include <string>
#include <vector>

#include "reyes/base/math.h"

namespace tomales::model {

/// Returns a colour for each face, or an empty list if the file has none or ends early.
std::vector<vec3> colorsOfFaces(const std::string& path);

}  // namespace tomales::model
