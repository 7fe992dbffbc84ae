// Rewrites glTF in terms that Assimp knows. Threads: plain function.
#pragma once
#include <string>
#include <vector>

namespace tomales::model {

struct PlainGltf {
  std::string bytes;                  ///< What Assimp shall read instead of the file; empty: the file itself.
  std::string floats;                 ///< Content of the file kFloatsFile beside it.
  bool isTooLarge = false;            ///< The file is left as it is, because its rewritten text would be far larger.
  std::vector<std::string> leftOut;   ///< Extensions that the file uses and that are not understood.
  std::vector<std::string> required;  ///< Those of them that the file requires ("extensionsRequired").
};

constexpr const char* kFloatsFile = "tomales-import-floats.bin";

/// Reads a .gltf or .glb. It rewrites what Assimp 5.2 does not know: vertices given as integers, colours without alpha,
/// KHR_materials_emissive_strength, and the set of texture coordinates that KHR_texture_transform names. A file that is
/// no glTF is left as it is.
PlainGltf plainGltf(const std::string& path);

}  // namespace tomales::model
