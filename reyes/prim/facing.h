// Private to the primitives: the width of points and curves, and the eye to which they turn.
#pragma once
#include "reyes/prim_factories.h"

namespace tomales {

/// The eye in object space. Until it is set it is far away and looks along z.
struct Eye {
  vec3 position{0}, forward{0, 0, 1};
  bool perspective = false;
  vec3 towards(const vec3& from) const { return perspective ? position - from : -forward; }
};

/// Returns the primvar "width", else "constantwidth", else a constant 1. Throws PrimError if one is negative or not
/// finite.
Primvar widthOf(const std::vector<Primvar>& primvars);

/// Returns the primvar "N" if it has one normal for each element; null if there is none.
const Primvar* normalsOf(const std::vector<Primvar>& primvars);

}  // namespace tomales
