// Materials of KHR_materials_pbrSpecularGlossiness, an old extension of glTF. Threads: plain functions.
#pragma once
#include <assimp/material.h>

#include <optional>

#include "reyes/base/math.h"

namespace tomales::model {

/// Such a material in parameters of `disney`.
struct Metallic {
  vec3 color{1.0f};
  float opacity = 1, metallic = 0, roughness = 1;
  float specular = 0.5f;
};

/// Returns nothing if the material also has metallic and roughness, which `disney` takes as they are.
std::optional<Metallic> metallicOfSpecularGlossiness(const aiMaterial& material);

}  // namespace tomales::model
