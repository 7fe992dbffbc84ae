// Typed values as RIB carries them: parameter lists and primitive variables (RISpec 3.2 section 3.1).
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tomales {

enum class Storage : uint8_t { Constant, Uniform, Varying, Vertex, FaceVarying };
enum class ValueType : uint8_t { Float, Integer, String, Color, Point, Vector, Normal, HPoint, Matrix };

/// The words of declarations, in the order of the enumerations.
inline constexpr std::string_view kStorageNames[] = {"constant", "uniform", "varying", "vertex", "facevarying"};
inline constexpr std::string_view kValueTypeNames[] = {"float",  "int",    "string", "color", "point",
                                                       "vector", "normal", "hpoint", "matrix"};
inline std::string_view nameOf(Storage storage) { return kStorageNames[static_cast<size_t>(storage)]; }
inline std::string_view nameOf(ValueType type) { return kValueTypeNames[static_cast<size_t>(type)]; }

/// Returns the number of floats in one value of a type; a string counts as 1.
inline int floatsPerValue(ValueType type) {
  switch (type) {
    case ValueType::Color:
    case ValueType::Point:
    case ValueType::Vector:
    case ValueType::Normal:
      return 3;
    case ValueType::HPoint:
      return 4;
    case ValueType::Matrix:
      return 16;
    default:
      return 1;
  }
}

/// One token-value pair. Exactly one of the three arrays is filled, by type.
struct Param {
  std::string name;
  Storage storage = Storage::Uniform;
  ValueType type = ValueType::Float;
  int arrayLength = 1;  ///< The length of the declared array: "float[2] st" has 2.
  std::vector<float> floats;
  std::vector<int> ints;
  std::vector<std::string> strings;

  bool operator==(const Param&) const = default;
  int width() const { return floatsPerValue(type) * arrayLength; }  ///< Number of floats in one element.
  float number(float fallback) const {
    return !floats.empty() ? floats[0] : !ints.empty() ? static_cast<float>(ints[0]) : fallback;
  }
};

using ParamList = std::vector<Param>;

inline const Param* findParam(const ParamList& list, std::string_view name) {
  for (const Param& p : list)
    if (p.name == name) return &p;
  return nullptr;
}

/// Returns the parameter's first string; `fallback` if it is null or has none.
inline std::string wordOf(const Param* param, const char* fallback = "") {
  return param && !param->strings.empty() ? param->strings.front() : fallback;
}
inline std::string wordOf(const ParamList& list, std::string_view name, const char* fallback = "") {
  return wordOf(findParam(list, name), fallback);
}

}  // namespace tomales
