// What displacement shaders compute for surfaces. Vertices have room for it behind their primitive variables, and
// points to shade have the means of vertices, as they have of primitive variables.
#pragma once
#include "reyes/prim.h"
#include "reyes/state.h"

namespace tomales {

/// The name of such a variable begins with this. So do the names by which Attributes::user keeps their types.
inline constexpr std::string_view kOfDisplacement = "displacement:";

/// Returns the layout of all of an object, in the order in which they follow its primitive variables.
inline std::vector<Primvar> displacementOutputs(const Attributes& a) {
  std::vector<Primvar> out;
  for (auto it = a.user.lower_bound(std::string(kOfDisplacement));
       it != a.user.end() && it->first.starts_with(kOfDisplacement); ++it)
    out.push_back({it->first, Storage::Vertex, it->second.type, floatsPerValue(it->second.type), {}});
  return out;
}

}  // namespace tomales
