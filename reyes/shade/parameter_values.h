// What RIB gives, as a shader's declaration wants it.
#pragma once
#include <string>
#include <vector>

#include "reyes/base/value.h"
#include "reyes/shader_api.h"

namespace tomales {

/// One value of a parameter, in shader space still.
struct ParameterValue {
  std::vector<float> floats;         ///< arrayLength values; empty for strings.
  std::vector<std::string> strings;  ///< arrayLength of them; empty for numbers.
  std::string remark;                ///< What had to be done to what was given; empty: nothing.
};

/// `given` null: the default. Conversions are those of RISpec 3.2 section 11 (a float becomes any other number: the
/// same in each component, or the diagonal of a matrix) and between triples, whose numbers are taken as they stand; an
/// hpoint is divided by its w, an integer is a float. What is too long is cut, what is too short is filled up by the
/// default.
ParameterValue parameterValue(const TmParamDecl& declared, const Param* given);

/// Floats in one value of a TmType; strings have none.
int floatsOf(int32_t type);
/// Is `given` this type, without conversion? Integers are floats; points, vectors and normals are told apart by the
/// declaration.
bool accepts(int32_t type, ValueType given);

}  // namespace tomales
