// Materials of KHR_materials_pbrSpecularGlossiness, an old extension of glTF. Threads: plain functions.
#pragma once
#include <assimp/material.h>

#include <optional>

#include "reyes/base/math.h"

namespace tomales::model {

/// Such a material in the terms of disney.
struct Metallic {
  vec3 color{1.0f};
  float opacity = 1, metallic = 0, roughness = 1;
  float specular = 0.5f;
};

/// Returns nothing where the material is described by metallic and roughness too, which disney has.
std::optional<Metallic> metallicOfSpecularGlossiness(const aiMaterial& material);

}  // namespace tomales::model
