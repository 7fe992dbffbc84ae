// Reads what Assimp 5.2 does not pass on from the material files of .obj. Threads: plain functions.
#pragma once
#include <assimp/material.h>

#include <map>
#include <string>

#include "reyes/base/math.h"

namespace tomales::model {

struct MtlMaterial {
  bool hasColor = false;  ///< It has a Kd; for other materials Assimp makes one up.
  std::map<aiTextureType, mat3>
      placed;  ///< Mapping of pictures by their options -s and -o, in coordinates whose v runs up.
};
using MtlMaterials = std::map<std::string, MtlMaterial>;

/// Adds the materials of a text. Returns the text without the options -s, -o and -t of pictures: Assimp ignores them,
/// and takes the picture's name for a number where they have fewer than three.
std::string plainMtl(const std::string& text, MtlMaterials& materials);

}  // namespace tomales::model
