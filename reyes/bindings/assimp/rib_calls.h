// Short spellings of requests, for what is written as RIB. Threads: plain functions.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "reyes/base/math.h"
#include "reyes/rib.h"

namespace tomales::model {

RibArg arg(float number);
RibArg arg(const char* text);
RibArg arg(std::string text);
RibArg arg(std::vector<float> numbers);
RibArg arg(std::vector<int> integers);
RibArg arg(std::vector<std::string> texts);
RibArg arg(const vec3& triple);
RibArg arg(const mat4& matrix);  ///< RenderMan's sixteen numbers are glm's storage.

Param param(std::string name, float value);
Param param(std::string name, int value);
Param param(std::string name, std::string value);
Param param(std::string name, ValueType type, const vec3& value);
/// Returns a primitive variable of `width` floats an element beyond its type's own, as "float[2] st" has 2.
Param variable(std::string name, Storage storage, ValueType type, std::vector<float> values, int arrayLength = 1);

template <class... Args>
Request callWith(ParamList params, std::string name, Args&&... args) {
  Request out;
  out.name = std::move(name);
  out.params = std::move(params);
  (out.args.push_back(arg(std::forward<Args>(args))), ...);
  return out;
}
template <class... Args>
Request call(std::string name, Args&&... args) {
  return callWith({}, std::move(name), std::forward<Args>(args)...);
}

using Requests = std::vector<Request>;
void write(const Requests& requests, RiSink& sink);

}  // namespace tomales::model
