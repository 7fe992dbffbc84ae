// What compiled shaders of the shading language and their host agree upon, besides what every shader may declare
// (reyes/shader_api.h): no plugin needs it.
#pragma once
#include <cstdint>

namespace tomales {

/// Added to the type of a parameter that is an array: primitive variables of the same name and length override it.
/// TmValue::step is 1 then, and element e of component k of point i is c[k][e * components * padded + i].
constexpr int32_t kArrayVaries = 0x10000;

}  // namespace tomales
