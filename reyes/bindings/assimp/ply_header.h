// What the head of a .ply file tells. Threads: plain function.
#pragma once
#include <string>

namespace tomales::model {

/// Tells whether faces have colours, which Assimp 5.2 does not read.
bool hasColorsOfFaces(const std::string& path);

}  // namespace tomales::model
