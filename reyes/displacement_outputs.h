// What displacement shaders compute for surfaces. Vertices have room for it behind their primitive variables. As with
// primitive variables, points to shade get the mean over their vertices.
#pragma once
#include "reyes/prim.h"
#include "reyes/state.h"

namespace tomales {

/// The name of such a variable begins with this.
inline constexpr std::string_view kOfDisplacement = "displacement:";

/// Returns the layout of all such variables of an object, in the order in which they follow its primitive variables.
inline std::vector<Primvar> displacementVariables(const Attributes& a) {
  std::vector<Primvar> out;
  for (const Param& p : a.displacementOutputs)
    out.push_back({std::string(kOfDisplacement) + p.name, Storage::Vertex, p.type, floatsPerValue(p.type), {}});
  return out;
}

/// Returns how many floats these variables take together.
inline int displacementFloats(const Attributes& a) {
  int out = 0;
  for (const Param& p : a.displacementOutputs) out += floatsPerValue(p.type);
  return out;
}

}  // namespace tomales
