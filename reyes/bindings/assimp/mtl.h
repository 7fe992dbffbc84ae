// What material files of .obj say that Assimp 5.2 does not tell. Threads: plain functions.
#pragma once
#include <assimp/material.h>

#include <map>
#include <string>

#include "reyes/base/math.h"

namespace tomales::model {

struct MtlMaterial {
  bool hasColor = false;                 ///< It has a Kd; Assimp makes up one for the others.
  std::map<aiTextureType, mat3> placed;  ///< By options -s and -o of pictures, of coordinates whose v runs up.
};
using MtlMaterials = std::map<std::string, MtlMaterial>;

/// Adds the materials of a text. Returns the text without the options -s, -o and -t of pictures: Assimp leaves them
/// out, and takes the picture's name for one of their three numbers where there are fewer.
std::string plainMtl(const std::string& text, MtlMaterials& materials);

}  // namespace tomales::model
