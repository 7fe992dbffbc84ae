// The texture coordinates that a picture of a material is looked up at. Threads: plain functions.
#pragma once
#include <assimp/material.h>

#include "reyes/base/math.h"

namespace tomales::model {

/// Turns Assimp's v, which runs up the picture, to RIB's t, which runs down.
inline const mat3 kStFromUv{{1, 0, 0}, {0, -1, 0}, {0, 1, 1}};

struct TextureCoordinates {
  unsigned set = 0;           ///< Index among the mesh's sets of texture coordinates.
  mat3 stFromUv = kStFromUv;  ///< It takes (u, v, 1) as Assimp gives it.
  bool operator==(const TextureCoordinates&) const = default;
};

/// `set`: the set of the material's first picture of this type.
TextureCoordinates coordinatesOf(const aiMaterial& material, aiTextureType type, unsigned set, bool isGltf);

}  // namespace tomales::model
