#include "reyes/shade/parameter_values.h"

#include <fmt/format.h>

#include <algorithm>

#include "reyes/shader_registry.h"

namespace tomales {
namespace {

/// Indexed by TmType.
constexpr ValueType kValueTypes[] = {ValueType::Float,  ValueType::Color,  ValueType::Point, ValueType::Vector,
                                     ValueType::Normal, ValueType::String, ValueType::Matrix};

std::vector<float> numbersOf(const Param& p) {
  std::vector<float> out(p.floats);
  for (const int i : p.ints) out.push_back(static_cast<float>(i));
  if (p.type != ValueType::HPoint) return out;
  std::vector<float> points;
  for (size_t k = 0; k + 4 <= out.size(); k += 4)
    for (size_t c = 0; c < 3; ++c) points.push_back(out[k + 3] != 0 ? out[k + c] / out[k + 3] : out[k + c]);
  return points;
}

/// Makes a single float one value of `width` floats.
std::vector<float> promoted(float x, size_t width) {
  if (width != 16) return std::vector<float>(width, x);
  std::vector<float> out(16, 0.0f);
  for (size_t k = 0; k < 4; ++k) out[5 * k] = x;
  return out;
}

void takeStrings(const TmParamDecl& declared, const Param* given, ParameterValue& out) {
  const auto length = static_cast<size_t>(std::max(1, declared.arrayLength));
  for (size_t k = 0; k < length; ++k)
    out.strings.emplace_back(declared.strings && declared.strings[k] ? declared.strings[k] : "");
  if (!given) return;
  if (given->strings.empty()) {
    out.remark = fmt::format("is a string and was given a {}; its default is used", nameOf(given->type));
    return;
  }
  std::copy_n(given->strings.begin(), std::min(length, given->strings.size()), out.strings.begin());
  if (given->strings.size() != length)
    out.remark = fmt::format("has {} strings and was given {}", length, given->strings.size());
}

/// Tells whether the value needs no conversion. One without a declaration has the shader's, if it is numbers or texts.
bool agrees(int32_t type, const Param& given) {
  return accepts(type, given.type) || (given.arrayLength == 0 && given.strings.empty() == (type != TM_STRING));
}

/// Tells whether numbers of this type may stand where values of `width` floats are wanted.
bool converts(const Param& given, size_t numbers, size_t width, size_t wanted) {
  const auto own = given.type == ValueType::HPoint ? 3 : static_cast<size_t>(floatsPerValue(given.type));
  return own == width || own == 1 || numbers == wanted;
}

void takeNumbers(const TmParamDecl& declared, const Param& given, size_t width, ParameterValue& out) {
  const int32_t type = TM_TYPE_OF(declared.type);
  std::vector<float> numbers = numbersOf(given);
  if (!agrees(type, given) && (numbers.empty() || !converts(given, numbers.size(), width, out.floats.size()))) {
    out.remark = fmt::format("is a {} and was given a {}; its default is used", typeName(type), nameOf(given.type));
    return;
  }
  const size_t count = numbers.size();
  if (count == 1 && width > 1 && floatsPerValue(given.type) == 1) numbers = promoted(numbers[0], width);
  const size_t taken = std::min(numbers.size(), out.floats.size()) / width * width;
  std::copy_n(numbers.begin(), taken, out.floats.begin());
  if (numbers.size() != out.floats.size())
    out.remark = fmt::format("takes {} numbers and was given {}{}", out.floats.size(), count,
                             taken == 0 ? "; its default is used" : "");
  else if (!agrees(type, given))
    out.remark = fmt::format("is a {} and was given a {}, which is converted", typeName(type), nameOf(given.type));
}

}  // namespace

ValueType valueTypeOf(int32_t type) {
  return type >= TM_FLOAT && type <= TM_MATRIX ? kValueTypes[type] : ValueType::Float;
}

TmType tmTypeOf(ValueType type) {
  const auto it = std::find(std::begin(kValueTypes), std::end(kValueTypes), type);
  return it == std::end(kValueTypes) ? TM_FLOAT : static_cast<TmType>(it - std::begin(kValueTypes));
}

const char* typeName(int32_t type) {
  return type >= TM_FLOAT && type <= TM_MATRIX ? nameOf(valueTypeOf(type)).data() : "unknown type";
}

int floatsOf(int32_t type) { return type == TM_STRING ? 0 : floatsPerValue(valueTypeOf(type)); }

bool accepts(int32_t type, ValueType given) {
  switch (type) {
    case TM_FLOAT:
      return given == ValueType::Float || given == ValueType::Integer;
    case TM_COLOR:
      return given == ValueType::Color;
    case TM_STRING:
      return given == ValueType::String;
    case TM_MATRIX:
      return given == ValueType::Matrix;
    default:
      return given == ValueType::Point || given == ValueType::Vector || given == ValueType::Normal;
  }
}

ParameterValue parameterValue(const TmParamDecl& declared, const Param* given) {
  ParameterValue out;
  const int32_t type = TM_TYPE_OF(declared.type);
  if (type == TM_STRING) {
    takeStrings(declared, given, out);
    return out;
  }
  const auto width = static_cast<size_t>(floatsOf(type));
  out.floats.resize(width * static_cast<size_t>(std::max(1, declared.arrayLength)), 0.0f);
  if (declared.floats) std::copy_n(declared.floats, out.floats.size(), out.floats.begin());
  if (given) takeNumbers(declared, *given, width, out);
  return out;
}

}  // namespace tomales
