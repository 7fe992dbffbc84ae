#include "reyes/bindings/assimp/gltf_buffers.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <limits>

#include "reyes/bindings/assimp/file_content.h"

namespace tomales::model {
namespace {

using nlohmann::json;

std::string fromBase64(std::string_view text) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const size_t digit = digits.find(c);
    if (digit == digits.npos) continue;
    bits = bits << 6 | static_cast<uint32_t>(digit);
    if ((count += 6) < 8) continue;
    count -= 8;
    out += static_cast<char>(bits >> count & 0xff);
  }
  return out;
}

template <class T>
float numberAt(const char* bytes, bool isNormalized) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return isNormalized ? std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max()), -1.0f)
                      : static_cast<float>(value);
}

/// How glTF stores a number.
struct Component {
  int type;
  size_t bytes;
  float (*read)(const char* bytes, bool isNormalized);
};
constexpr Component kComponents[] = {
    {5120, 1, numberAt<int8_t>},
    {5121, 1, numberAt<uint8_t>},
    {5122, 2, numberAt<int16_t>},
    {5123, 2, numberAt<uint16_t>},
    {5126, 4, [](const char* bytes, bool) { return numberAt<float>(bytes, false); }},
};

}  // namespace

int componentsOf(const json& accessor) {
  const std::string type = accessor.value("type", "");
  return type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 0;
}

size_t GltfBuffers::bytesRead() const {
  size_t out = binary_.size();
  for (const auto& [index, bytes] : decoded_) out += bytes.size();
  for (const auto& [path, bytes] : content_) out += bytes.size();
  return out;
}

std::string_view GltfBuffers::file(const std::string& uri, size_t most) {
  std::error_code failed;
  const std::filesystem::path path = std::filesystem::path(folder_) / uri,
                              same = std::filesystem::weakly_canonical(path, failed);
  const auto [place, isNew] = content_.try_emplace((failed ? path : same).string());
  // Reading more of a file for each buffer that names it would take long, so the second buffer reads all of it.
  if (isNew)
    place->second = contentOf(place->first, most);
  else if (most > place->second.size() && readWhole_.insert(place->first).second)
    place->second = contentOf(place->first);
  return std::string_view(place->second).substr(0, most);
}

std::string_view GltfBuffers::buffer(size_t index) {
  const json& described = document_.at("buffers").at(index);
  const auto most = described.at("byteLength").get<size_t>();
  const auto uri = described.find("uri");
  if (uri == described.end()) return binary_.substr(0, most);
  const auto& name = uri->get_ref<const std::string&>();
  if (!name.starts_with("data:")) return file(name, most);
  const auto [place, isNew] = decoded_.try_emplace(index);
  if (isNew) place->second = fromBase64(std::string_view(name).substr(std::min(name.find(','), name.size())));
  return std::string_view(place->second).substr(0, most);
}

std::optional<std::vector<float>> GltfBuffers::floats(const json& accessor) {
  const int type = accessor.value("componentType", 0);
  const auto* component =
      std::find_if(std::begin(kComponents), std::end(kComponents), [&](const Component& c) { return c.type == type; });
  const auto width = static_cast<size_t>(componentsOf(accessor));
  if (component == std::end(kComponents) || width == 0 || accessor.contains("sparse") ||
      !accessor.contains("bufferView"))
    return std::nullopt;
  const json& view = document_.at("bufferViews").at(accessor.at("bufferView").get<size_t>());
  const std::string_view bytes = buffer(view.at("buffer").get<size_t>());
  const size_t element = width * component->bytes, count = accessor.at("count").get<size_t>(),
               given = view.value("byteStride", size_t{0}), stride = given == 0 ? element : given,
               first = view.value("byteOffset", size_t{0}) + accessor.value("byteOffset", size_t{0});
  // Each factor is checked before they are multiplied, so that no product overflows.
  if (count == 0 || count > bytes.size() || stride > 1024 || first > bytes.size() ||
      (count - 1) * stride + element > bytes.size() - first)
    return std::nullopt;
  const bool isNormalized = accessor.value("normalized", false);
  std::vector<float> out;
  out.reserve(count * width);
  for (size_t i = 0; i < count; ++i)
    for (size_t k = 0; k < width; ++k)
      out.push_back(component->read(bytes.data() + first + i * stride + k * component->bytes, isNormalized));
  return out;
}

}  // namespace tomales::model
