#include "reyes/bindings/assimp/plain_gltf.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>

#include "reyes/bindings/assimp/file_content.h"
#include "reyes/bindings/assimp/gltf_buffers.h"

namespace tomales::model {
namespace {

using nlohmann::json;

constexpr const char* kUnderstood[] = {"KHR_draco_mesh_compression",
                                       "KHR_lights_punctual",
                                       "KHR_materials_clearcoat",
                                       "KHR_materials_unlit",
                                       "KHR_mesh_quantization",
                                       "KHR_materials_emissive_strength",
                                       "KHR_texture_transform",
                                       "KHR_materials_transmission",  // which has a message of its own
                                       "KHR_materials_pbrSpecularGlossiness"};

std::vector<std::string> notUnderstood(const json& document, const char* list) {
  std::vector<std::string> out;
  for (const json& name : document.value(list, json::array()))
    if (name.is_string() && std::find(std::begin(kUnderstood), std::end(kUnderstood), name) == std::end(kUnderstood))
      out.push_back(name);
  return out;
}

/// The parts of a .glb (section 4.4 of the specification) within its bytes; a .gltf is all text.
struct Container {
  std::string_view text;
  std::string_view rest;  ///< The chunks after the text, with their heads.
  bool isBinary = false;
};
constexpr size_t kChunkHead = 8;

uint32_t wordAt(std::string_view bytes, size_t at) {
  uint32_t out = 0;
  if (at + sizeof out <= bytes.size()) std::memcpy(&out, bytes.data() + at, sizeof out);
  return out;
}

Container opened(std::string_view bytes) {
  constexpr size_t kText = 20;  // after the file's head and the chunk's
  if (!bytes.starts_with("glTF") || bytes.size() < kText) return {bytes, "", false};
  const size_t end = kText + wordAt(bytes, 12);
  if (end > bytes.size()) return {};
  return {bytes.substr(kText, end - kText), bytes.substr(end), true};
}

/// Returns the file with another text.
std::string closed(const Container& c, std::string text) {
  if (!c.isBinary) return text;
  text.append(-text.size() % 4, ' ');
  constexpr size_t kHead = 12;
  const auto word = [](size_t value) {
    const auto bits = static_cast<uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&bits), sizeof bits);
  };
  std::string out =
      "glTF" + word(2) + word(kHead + kChunkHead + text.size() + c.rest.size()) + word(text.size()) + "JSON";
  out.reserve(out.size() + text.size() + c.rest.size());
  out.append(text).append(c.rest);
  return out;
}

/// Tells whether lists are nested so deeply that recursion over them would exhaust the stack.
bool isDeep(std::string_view text) {
  constexpr int kDeepest = 500;
  int depth = 0;
  bool isQuoted = false;
  for (size_t k = 0; k < text.size() && depth <= kDeepest; ++k) {
    const char c = text[k];
    if (isQuoted && c == '\\') ++k;  // The next one does not end the word.
    if (c == '"') isQuoted = !isQuoted;
    if (isQuoted) continue;
    depth += (c == '[' || c == '{') - (c == ']' || c == '}');
  }
  return depth > kDeepest;
}

/// Thrown if the floats would take far more memory than the integers that they are made from.
struct TooLarge {};

/// Rewrites a document's extensions in plain glTF. Malformed parts are left as they are, for Assimp to report or to
/// ignore.
class Amendments {
 public:
  Amendments(json& document, GltfBuffers& buffers, std::string& floats)
      : document_(document), buffers_(buffers), floats_(floats) {}

  /// Tells whether anything has changed. Throws TooLarge.
  bool make() {
    for (json& material : listIn(document_, "materials")) unlessMalformed([&] { amendMaterial(material); });
    for (json& mesh : listIn(document_, "meshes"))
      for (json& primitive : listIn(mesh, "primitives"))
        if (primitive.is_object() && primitive.contains("attributes"))
          for (const auto& [name, accessor] : primitive["attributes"].items())
            unlessMalformed([&, &name = name, &accessor = accessor] { amendAttribute(name, accessor); });
    if (!floats_.empty()) document_["buffers"].push_back({{"uri", kFloatsFile}, {"byteLength", floats_.size()}});
    return changed_;
  }

 private:
  template <class Change>
  static void unlessMalformed(Change change) {
    try {
      change();
    } catch (const json::exception&) {
    }
  }
  json& listIn(json& of, const char* name) {
    const auto found = of.is_object() ? of.find(name) : of.end();
    return found != of.end() && found->is_array() ? *found : none_;
  }
  static const json* extension(const json& of, const char* name) {
    const auto all = of.find("extensions");
    return all != of.end() && all->is_object() && all->contains(name) ? &all->at(name) : nullptr;
  }

  void amendMaterial(json& material) {
    constexpr const char* kStrength = "KHR_materials_emissive_strength";
    if (const json* more = extension(material, kStrength)) {
      json emitted = material.value("emissiveFactor", json{0, 0, 0});
      for (json& channel : emitted) channel = channel.get<double>() * more->value("emissiveStrength", 1.0);
      material["emissiveFactor"] = emitted;
      material["extensions"].erase(kStrength);  // for a later Assimp may apply it too
      changed_ = true;
    }
    amendPictures(material);
    if (material.contains("pbrMetallicRoughness")) amendPictures(material["pbrMetallicRoughness"]);
  }
  void amendPictures(json& owner) {
    for (json& picture : owner) {
      const json* transform = picture.is_object() ? extension(picture, "KHR_texture_transform") : nullptr;
      if (!transform || !transform->contains("texCoord")) continue;
      picture["texCoord"] = json(transform->at("texCoord"));
      changed_ = true;
    }
  }

  /// Converts an attribute to floats: Assimp takes integers, except in colours, for the bits of floats, and colours
  /// without alpha for transparent.
  void amendAttribute(const std::string& name, json& index) {
    const json& accessor = document_.at("accessors").at(index.get<size_t>());
    const bool isColor = name.starts_with("COLOR_"),
               isPlace = name == "POSITION" || name == "NORMAL" || name.starts_with("TEXCOORD_");
    if (isColor ? componentsOf(accessor) != 3 : !isPlace || accessor.value("componentType", 0) == kFloat) return;
    json key = json::array({isColor});
    for (const char* part : {"bufferView", "byteOffset", "componentType", "count", "type", "normalized", "sparse"})
      key.push_back(accessor.value(part, json()));
    const auto [place, isNew] = made_.try_emplace(std::move(key));
    if (isNew) place->second = withFloats(accessor, isColor);
    if (!place->second) return;
    index = *place->second;
    changed_ = true;
  }
  /// Adds an accessor of the same numbers as floats, because other attributes may use the old one too. Returns its
  /// index.
  std::optional<size_t> withFloats(json accessor, bool isColor) {
    const auto values = buffers_.floats(accessor);
    if (!values) return std::nullopt;
    const size_t start = floats_.size(), added = values->size() * sizeof(float) * (isColor ? 4 : 3) / 3;
    if (start + added > std::max(kLeastBound, kMostGrowth * buffers_.bytesRead())) throw TooLarge();
    for (size_t k = 0; k < values->size(); ++k) {
      addFloat((*values)[k]);
      if (isColor && k % 3 == 2) addFloat(1);
    }
    json &views = document_["bufferViews"], &accessors = document_["accessors"];
    for (const char* old : {"normalized", "min", "max", "byteOffset"}) accessor.erase(old);
    accessor.update({{"bufferView", views.size()}, {"componentType", kFloat}});
    if (isColor) accessor["type"] = "VEC4";
    views.push_back(
        {{"buffer", document_["buffers"].size()}, {"byteOffset", start}, {"byteLength", floats_.size() - start}});
    accessors.push_back(std::move(accessor));
    return accessors.size() - 1;
  }
  void addFloat(float value) { floats_.append(reinterpret_cast<const char*>(&value), sizeof value); }

  static constexpr int kFloat = 5126;
  // If no two accessors share bytes, the data grows to six times its size at most.
  static constexpr size_t kLeastBound = size_t{64} << 20, kMostGrowth = 16;

  json& document_;
  GltfBuffers& buffers_;
  std::string& floats_;
  json none_ = json::array();
  std::map<json, std::optional<size_t>> made_;  // Accessors of floats by what the others say.
  bool changed_ = false;
};

}  // namespace

PlainGltf plainGltf(const std::string& path) {
  const std::string bytes = contentOf(path);
  const Container container = opened(bytes);
  PlainGltf out;
  if (isDeep(container.text)) return out;
  json document = json::parse(container.text, nullptr, false);
  if (!document.is_object()) return out;
  out.leftOut = notUnderstood(document, "extensionsUsed");
  out.required = notUnderstood(document, "extensionsRequired");
  GltfBuffers buffers(document, std::filesystem::path(path).parent_path().string(),
                      container.rest.substr(std::min(kChunkHead, container.rest.size())));
  try {
    if (Amendments(document, buffers, out.floats).make())
      out.bytes = closed(container, document.dump(-1, ' ', false, json::error_handler_t::replace));
  } catch (const TooLarge&) {
    out.floats = {};
    out.isTooLarge = true;
  }
  return out;
}

}  // namespace tomales::model
