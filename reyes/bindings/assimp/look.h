// A model's material as attributes of RIB and parameters of `disney`. Threads: plain data.
#pragma once
#include <assimp/material.h>

#include <string>

#include "reyes/bindings/assimp/rib_calls.h"

namespace tomales::model {

struct Look {
  std::string name;
  vec3 color{0.8f};
  float opacity = 1;
  ParamList parameters;         ///< Of disney.
  unsigned textureSet = 0;      ///< Which of a mesh's texture coordinates are st.
  mat3 textureTransform{1.0f};  ///< Of (s, t, 1), before t is turned to run down the picture.
};

Look lookOf(const aiMaterial& material);
/// Color, Opacity and Surface.
Requests requestsOf(const Look& look);

}  // namespace tomales::model
