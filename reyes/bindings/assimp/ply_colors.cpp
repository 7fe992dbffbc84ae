#include "reyes/bindings/assimp/ply_colors.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

namespace tomales::model {
namespace {

struct PlyType {
  const char *name, *other;
  size_t bytes;
  double most;  ///< What a colour of 1 is.
  double (*read)(const char* bytes);
};
template <class T>
double plyValue(const char* bytes) {
  T out;
  std::memcpy(&out, bytes, sizeof out);
  return static_cast<double>(out);
}
constexpr PlyType kPlyTypes[] = {
    {"char", "int8", 1, 127, plyValue<int8_t>},         {"uchar", "uint8", 1, 255, plyValue<uint8_t>},
    {"short", "int16", 2, 32767, plyValue<int16_t>},    {"ushort", "uint16", 2, 65535, plyValue<uint16_t>},
    {"int", "int32", 4, 2147483647, plyValue<int32_t>}, {"uint", "uint32", 4, 4294967295, plyValue<uint32_t>},
    {"float", "float32", 4, 1, plyValue<float>},        {"double", "float64", 8, 1, plyValue<double>}};

const PlyType* typeNamed(const std::string& name) {
  const auto* found = std::find_if(std::begin(kPlyTypes), std::end(kPlyTypes),
                                   [&](const PlyType& t) { return name == t.name || name == t.other; });
  return found == std::end(kPlyTypes) ? nullptr : found;
}

struct Property {
  std::string name;
  const PlyType *count = nullptr, *type = nullptr;  ///< A list has a `count` before its values.
};
struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  explicit PlyReader(const std::string& path) : in_(path, std::ios::binary) {
    for (std::string line; std::getline(in_, line);) {
      std::istringstream words(line);
      std::string kind, first, second, third, name;
      words >> kind >> first >> second >> third >> name;
      if (kind == "format") isText_ = first == "ascii", isSwapped_ = first == "binary_big_endian";
      if (kind == "element") elements_.push_back({first, std::strtoull(second.c_str(), nullptr, 10), {}});
      if (kind == "property" && !elements_.empty())
        elements_.back().properties.push_back(first == "list" ? Property{name, typeNamed(second), typeNamed(third)}
                                                              : Property{second, nullptr, typeNamed(first)});
      if (kind == "end_header") break;
    }
  }
  std::vector<vec3> colorsOfFaces() {
    const auto face =
        std::find_if(elements_.begin(), elements_.end(), [](const Element& e) { return e.name == "face"; });
    if (face == elements_.end() || !hasColors(*face)) return {};
    for (const Element& e : elements_) {
      const bool isFace = &e == &*face;
      if (e.properties.empty()) continue;  // else the loop would not end
      std::vector<vec3> colors;
      for (uint64_t k = 0; k < e.count && in_; ++k) {
        const vec3 color = colorOf(e);
        if (isFace) colors.push_back(color);
      }
      if (isFace || !in_) return in_ ? colors : std::vector<vec3>();
    }
    return {};
  }

 private:
  static bool hasColors(const Element& e) {
    return std::any_of(e.properties.begin(), e.properties.end(), [](const Property& p) { return p.name == "red"; });
  }
  /// Returns a colour from 0 to 1, and 0 for what is no number.
  static float shareOf(double value) { return value > 0 ? static_cast<float>(std::min(value, 1.0)) : 0; }
  /// Reads one of the elements.
  vec3 colorOf(const Element& e) {
    vec3 out(0.0f);
    for (const Property& p : e.properties) {
      const double count = p.count ? number(p.count) : 1;
      for (double k = 0; k < count && in_; ++k) {
        const double value = number(p.type);
        const size_t channel = p.name == "red" ? 0 : p.name == "green" ? 1 : p.name == "blue" ? 2 : 3;
        if (channel < 3 && p.type) out[static_cast<int>(channel)] = shareOf(value / p.type->most);
      }
    }
    return out;
  }
  double number(const PlyType* type) {
    if (!type) in_.setstate(std::ios::failbit);
    if (isText_ || !in_) return writtenNumber();
    char bytes[8] = {};
    in_.read(bytes, static_cast<std::streamsize>(type->bytes));
    if (isSwapped_ == (std::endian::native == std::endian::little)) std::reverse(bytes, bytes + type->bytes);
    return type->read(bytes);
  }

  /// Streams do not read "nan" and "inf", which strtod does.
  double writtenNumber() {
    in_ >> word_;
    char* end = word_.data();
    const double out = in_ ? std::strtod(word_.c_str(), &end) : 0;
    if (end == word_.data()) in_.setstate(std::ios::failbit);
    return out;
  }

  std::ifstream in_;
  std::string word_;
  bool isText_ = false, isSwapped_ = false;
  std::vector<Element> elements_;
};

}  // namespace

std::vector<vec3> colorsOfFaces(const std::string& path) { return PlyReader(path).colorsOfFaces(); }

}  // namespace tomales::model
