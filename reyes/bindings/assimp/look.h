// A model's material as attributes of RIB and parameters of `disney`. Threads: plain data.
#pragma once
#include <assimp/material.h>

#include <map>
#include <optional>
#include <string>

#include "reyes/bindings/assimp/rib_calls.h"
#include "reyes/bindings/assimp/texture_coordinates.h"
#include "reyes/bindings/assimp/textures.h"

namespace tomales::model {

struct Look {
  std::string name;
  vec3 color{0.8f};
  bool isColorGiven =
      true;  ///< False: `color` is a default, and does not count where vertices or pictures have colours.
  std::optional<vec3> unlit;  ///< Colour that it glows in, whatever lights it; `color` is black then.
  float opacity = 1;
  bool usesVertexAlpha = true;
  std::string shader = "disney";
  ParamList parameters;
  TextureCoordinates first;                  ///< They become st.
  std::optional<TextureCoordinates> second;  ///< They become s1 and t1.
  std::string leftOut;                       ///< Names of properties that the shader does not have; empty: none.
};

/// What the format of a material says that Assimp does not pass on.
struct LookSource {
  bool pictureReplaces = false;          ///< A picture replaces the colour; in other formats it multiplies it.
  bool isColorGiven = true;              ///< As in Look.
  std::map<aiTextureType, mat3> placed;  ///< How pictures are placed, as in MtlMaterial.
};
Look lookOf(const aiMaterial& material, Textures& textures, const LookSource& source);
/// Returns the requests Color, Opacity and Surface.
Requests requestsOf(const Look& look);

}  // namespace tomales::model
