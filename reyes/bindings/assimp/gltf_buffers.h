// The numbers of a glTF file (sections 3.6 and 4 of its specification). Threads: plain object.
#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace tomales::model {

class GltfBuffers {
 public:
  /// `binary`: the buffer within a .glb, from which the others differ by their "uri".
  GltfBuffers(const nlohmann::json& document, std::string folder, std::string binary)
      : document_(document), folder_(std::move(folder)), binary_(std::move(binary)) {}

  /// Returns the elements of an accessor one after another. Integers that are normalized become -1..1. Returns nothing
  /// where they are told in another way (sparse, compressed), or where the file has fewer.
  std::optional<std::vector<float>> floats(const nlohmann::json& accessor);

 private:
  const std::string& buffer(size_t index);

  const nlohmann::json& document_;
  const std::string folder_, binary_;
  std::map<size_t, std::string> read_;
};

/// Returns the number of components of an element, 0 if its type is none that vertices have.
int componentsOf(const nlohmann::json& accessor);

}  // namespace tomales::model
