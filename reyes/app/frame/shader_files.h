// The files that a frame's shaders need: their own text, and the pictures that they name.
#pragma once
#include <set>

#include "reyes/scene.h"
#include "reyes/shader_registry.h"

namespace tomales {

struct ShaderFiles {
  std::set<std::string> files;  ///< Paths of what shaders are made of.
  std::set<std::string> names;  ///< Texts that may be names of pictures: parameters, and texts in shaders.
  bool isKnown = true;          ///< False if a shader computes the name of a file.
};
ShaderFiles shaderFilesOf(const Scene& scene, ShaderRegistry& shaders);

/// Returns the pictures among them that are there under exactly these names.
std::vector<std::string> picturesOf(const ShaderFiles& files, const Scene& scene);

}  // namespace tomales
