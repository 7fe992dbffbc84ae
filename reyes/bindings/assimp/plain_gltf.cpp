#include "reyes/bindings/assimp/plain_gltf.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>

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

/// The parts of a .glb (section 4.4 of the specification); a .gltf is all text.
struct Container {
  std::string text;
  std::string rest;  ///< The chunks after the text, with their heads.
  bool isBinary = false;
};
constexpr size_t kChunkHead = 8;

uint32_t wordAt(const std::string& bytes, size_t at) {
  uint32_t out = 0;
  if (at + sizeof out <= bytes.size()) std::memcpy(&out, bytes.data() + at, sizeof out);
  return out;
}

Container opened(std::string bytes) {
  constexpr size_t kText = 20;  // after the file's head and the chunk's
  if (!bytes.starts_with("glTF") || bytes.size() < kText) return {std::move(bytes), "", false};
  const size_t end = kText + wordAt(bytes, 12);
  if (end > bytes.size()) return {};
  return {bytes.substr(kText, end - kText), bytes.substr(end), true};
}

std::string closed(Container c) {
  if (!c.isBinary) return c.text;
  c.text.append(-c.text.size() % 4, ' ');
  constexpr size_t kHead = 12;
  const auto word = [](size_t value) {
    const auto bits = static_cast<uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&bits), sizeof bits);
  };
  return "glTF" + word(2) + word(kHead + kChunkHead + c.text.size() + c.rest.size()) + word(c.text.size()) + "JSON" +
         c.text + c.rest;
}

/// Says in a document what its extensions say.
class Amendments {
 public:
  Amendments(json& document, GltfBuffers& buffers, std::string& floats)
      : document_(document), buffers_(buffers), floats_(floats) {}

  /// Tells whether anything has changed.
  bool make() {
    if (document_.contains("materials"))
      for (json& material : document_["materials"]) amendMaterial(material);
    if (document_.contains("meshes"))
      for (const json& mesh : document_["meshes"])
        for (const json& primitive : mesh.value("primitives", json::array())) {
          const json attributes = primitive.value("attributes", json::object());
          for (const auto& [name, accessor] : attributes.items())
            amendAttribute(name, document_.at("accessors").at(accessor.get<size_t>()));
        }
    if (!floats_.empty()) document_["buffers"].push_back({{"uri", kFloatsFile}, {"byteLength", floats_.size()}});
    return changed_;
  }

 private:
  static const json* extension(const json& of, const char* name) {
    const auto all = of.find("extensions");
    return all != of.end() && all->is_object() && all->contains(name) ? &all->at(name) : nullptr;
  }

  void amendMaterial(json& material) {
    if (const json* more = extension(material, "KHR_materials_emissive_strength")) {
      json emitted = material.value("emissiveFactor", json{0, 0, 0});
      for (json& channel : emitted) channel = channel.get<double>() * more->value("emissiveStrength", 1.0);
      material["emissiveFactor"] = emitted;
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

  /// Assimp takes integers of anything but colours for the bits of floats, and colours without alpha for transparent.
  void amendAttribute(const std::string& name, json& accessor) {
    const bool isColor = name.starts_with("COLOR_"),
               isPlace = name == "POSITION" || name == "NORMAL" || name.starts_with("TEXCOORD_");
    constexpr int kFloat = 5126;
    if (isColor ? componentsOf(accessor) != 3 : !isPlace || accessor.value("componentType", 0) == kFloat) return;
    const auto values = buffers_.floats(accessor);
    if (!values) return;
    const size_t start = floats_.size();
    for (size_t k = 0; k < values->size(); ++k) {
      addFloat((*values)[k]);
      if (isColor && k % 3 == 2) addFloat(1);
    }
    json& views = document_["bufferViews"];
    for (const char* old : {"normalized", "min", "max", "byteOffset"}) accessor.erase(old);
    accessor.update({{"bufferView", views.size()}, {"componentType", kFloat}});
    if (isColor) accessor["type"] = "VEC4";
    views.push_back(
        {{"buffer", document_["buffers"].size()}, {"byteOffset", start}, {"byteLength", floats_.size() - start}});
    changed_ = true;
  }
  void addFloat(float value) { floats_.append(reinterpret_cast<const char*>(&value), sizeof value); }

  json& document_;
  GltfBuffers& buffers_;
  std::string& floats_;
  bool changed_ = false;
};

}  // namespace

PlainGltf plainGltf(const std::string& path) {
  Container container = opened(contentOf(path));
  json document = json::parse(container.text, nullptr, false);
  PlainGltf out;
  if (!document.is_object()) return out;
  try {
    out.leftOut = notUnderstood(document, "extensionsUsed");
    out.required = notUnderstood(document, "extensionsRequired");
    GltfBuffers buffers(document, std::filesystem::path(path).parent_path().string(),
                        container.rest.substr(std::min(kChunkHead, container.rest.size())));
    if (!Amendments(document, buffers, out.floats).make()) return out;
    container.text = document.dump(-1, ' ', false, json::error_handler_t::replace);
    out.bytes = closed(std::move(container));
  } catch (const json::exception&) {  // which Assimp says more of, or does not mind
    out.floats.clear();
  }
  return out;
}

}  // namespace tomales::model
