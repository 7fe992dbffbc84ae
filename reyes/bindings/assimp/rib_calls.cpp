#include "reyes/bindings/assimp/rib_calls.h"

#include <glm/gtc/type_ptr.hpp>

namespace tomales::model {
namespace {

RibArg argOf(RibArg::Kind kind) {
  RibArg out;
  out.kind = kind;
  return out;
}

Param paramOf(std::string name, ValueType type) {
  Param out;
  out.name = std::move(name);
  out.type = type;
  return out;
}

}  // namespace

RibArg arg(float number) {
  RibArg out = argOf(RibArg::Kind::Number);
  out.numbers = {number};
  return out;
}
RibArg arg(const char* text) { return arg(std::string(text)); }
RibArg arg(std::string text) {
  RibArg out = argOf(RibArg::Kind::String);
  out.strings.push_back(std::move(text));
  return out;
}
RibArg arg(std::vector<float> numbers) {
  RibArg out = argOf(RibArg::Kind::Numbers);
  out.numbers = std::move(numbers);
  return out;
}
RibArg arg(std::vector<int> integers) {
  RibArg out = argOf(RibArg::Kind::Integers);
  out.integers = std::move(integers);
  return out;
}
RibArg arg(std::vector<std::string> texts) {
  RibArg out = argOf(RibArg::Kind::Strings);
  out.strings = std::move(texts);
  return out;
}
RibArg arg(const vec3& triple) { return arg(std::vector<float>{triple.x, triple.y, triple.z}); }
RibArg arg(const mat4& matrix) {
  const float* m = glm::value_ptr(matrix);
  return arg(std::vector<float>(m, m + 16));
}

Param param(std::string name, float value) {
  Param out = paramOf(std::move(name), ValueType::Float);
  out.floats = {value};
  return out;
}
Param param(std::string name, int value) {
  Param out = paramOf(std::move(name), ValueType::Integer);
  out.ints = {value};
  return out;
}
Param param(std::string name, std::string value) {
  Param out = paramOf(std::move(name), ValueType::String);
  out.strings.push_back(std::move(value));
  return out;
}
Param param(std::string name, ValueType type, const vec3& value) {
  Param out = paramOf(std::move(name), type);
  out.floats = {value.x, value.y, value.z};
  return out;
}
Param variable(std::string name, Storage storage, ValueType type, std::vector<float> values, int arrayLength) {
  Param out = paramOf(std::move(name), type);
  out.storage = storage;
  out.arrayLength = arrayLength;
  out.floats = std::move(values);
  return out;
}

void write(const Requests& requests, RiSink& sink) {
  for (const Request& r : requests) sink.request(r);
}

}  // namespace tomales::model
