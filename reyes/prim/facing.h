// What points and curves share: they have a width, and turn to the eye. Private to the primitives.
#pragma once
#include "reyes/prim.h"

namespace tomales {

/// In object space. Before anybody has said where it is: far away, looking along z.
struct Eye {
  vec3 position{0}, forward{0, 0, 1};
  bool perspective = false;
  vec3 towards(const vec3& from) const { return perspective ? position - from : -forward; }
};

/// "width" or else "constantwidth" of the primvars, or a constant 1. Throws PrimError if one is negative or
/// not finite.
Primvar widthOf(const std::vector<Primvar>& primvars);

/// The primvar "N" if it is one normal an element; null if there is none.
const Primvar* normalsOf(const std::vector<Primvar>& primvars);

}  // namespace tomales
