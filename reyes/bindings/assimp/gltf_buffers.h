// The numbers of a glTF file (sections 3.6 and 4 of its specification). Threads: plain object.
#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tomales::model {

class GltfBuffers {
 public:
  /// `binary`: the buffer within a .glb; all other buffers have a "uri".
  GltfBuffers(const nlohmann::json& document, std::string folder, std::string_view binary)
      : document_(document), folder_(std::move(folder)), binary_(binary) {}

  /// Returns the elements of an accessor one after another. Integers that are normalized become -1..1. Returns nothing
  /// if they are encoded in another way (sparse, compressed), or if the file has too few.
  std::optional<std::vector<float>> floats(const nlohmann::json& accessor);

  /// Returns the size of all that was read. A file that several buffers name counts once.
  size_t bytesRead() const;

 private:
  std::string_view buffer(size_t index);
  /// Returns the first bytes of a file beside the document.
  std::string_view file(const std::string& uri, size_t most);

  const nlohmann::json& document_;
  const std::string folder_;
  const std::string_view binary_;
  std::map<size_t, std::string> decoded_;       // Indexed by buffer.
  std::map<std::string, std::string> content_;  // Indexed by path.
  std::set<std::string> readWhole_;             // Their paths.
};

/// Returns the number of components of an element, 0 if its type is none that vertices have.
int componentsOf(const nlohmann::json& accessor);

}  // namespace tomales::model
