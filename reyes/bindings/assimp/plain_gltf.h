// glTF in the words that Assimp knows. Threads: plain function.
#pragma once
#include <string>
#include <vector>

namespace tomales::model {

struct PlainGltf {
  std::string bytes;                  ///< What Assimp shall read in place of the file; empty: the file as it is.
  std::string floats;                 ///< Content of a file kFloatsFile beside it.
  bool isTooLarge = false;            ///< The file is left as it is, as the words would be far larger.
  std::vector<std::string> leftOut;   ///< Extensions that the file uses and that are not understood.
  std::vector<std::string> required;  ///< Those of them without which it asks not to be read.
};

constexpr const char* kFloatsFile = "tomales-import-floats.bin";

/// Reads a .gltf or .glb. What Assimp 5.2 does not know of it becomes what it knows: vertices that are told by
/// integers, colours without alpha, KHR_materials_emissive_strength, and the set of texture coordinates that
/// KHR_texture_transform names. A file that is no glTF is left as it is.
PlainGltf plainGltf(const std::string& path);

}  // namespace tomales::model
