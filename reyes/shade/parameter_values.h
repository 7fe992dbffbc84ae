// Converts the values of RIB to the types that a shader declares.
#pragma once
#include <string>
#include <vector>

#include "reyes/base/value.h"
#include "reyes/shader_api.h"

namespace tomales {

/// The value of a parameter, still in shader space.
struct ParameterValue {
  std::vector<float> floats;         ///< arrayLength values; empty for strings.
  std::vector<std::string> strings;  ///< arrayLength strings; empty for numbers.
  std::string remark;                ///< Says how the given value had to be changed; empty if it was not.
};

/// Returns the value for a parameter, or its default if `given` is null. By RISpec 3.2 section 11 a float becomes a
/// triple of equal components, or the diagonal of a matrix. Beyond that, any kind of triple is taken for any other,
/// without conversion, an hpoint is divided by its w, and an integer becomes a float. A value that is too long is cut;
/// one that is too short is filled up from the default.
ParameterValue parameterValue(const TmParamDecl& declared, const Param* given);

/// Returns RIB's type for a TmType; float for an unknown number.
ValueType valueTypeOf(int32_t type);
/// Returns the shaders' type for a type of RIB; float if shaders do not have it.
TmType tmTypeOf(ValueType type);
/// Tells whether `given` needs no conversion to this type. Integers count as floats, and points, vectors and normals as
/// the same.
bool accepts(int32_t type, ValueType given);

}  // namespace tomales
