// Counts the values that primitives of the C binding take: the callers of reyes/ri.h pass arrays without their lengths.
#pragma once
#include <array>

#include "reyes/ri.h"
#include "reyes/state.h"

namespace tomales::rib {

/// The number of values of each storage class that a primitive takes (RISpec 3.2 section 5).
struct ValueCounts {
  size_t uniform = 1, varying = 1, vertex = 1, faceVarying = 1;
  size_t of(Storage s) const {
    switch (s) {
      case Storage::Constant:
        return 1;
      case Storage::Uniform:
        return uniform;
      case Storage::Varying:
        return varying;
      case Storage::Vertex:
        return vertex;
      case Storage::FaceVarying:
        return faceVarying;
    }
    return 1;
  }
};
inline constexpr ValueCounts kQuadric{1, 4, 4, 4};

/// Lengths of arrays: negative numbers count as 0.
inline size_t count(RtInt n) { return n > 0 ? static_cast<size_t>(n) : 0; }
size_t sum(const RtInt n[], RtInt length);

inline bool isCubic(RtToken type) {
  return type && (std::string_view(type) == RI_BICUBIC || std::string_view(type) == RI_CUBIC);
}
/// `steps`: those of the bases along u and v.
ValueCounts meshCounts(RtToken type, RtInt nu, RtToken uwrap, RtInt nv, RtToken vwrap, const std::array<int, 2>& steps);
/// `step`: that of the basis along v.
ValueCounts curveCounts(RtToken type, RtInt ncurves, const RtInt nvertices[], RtToken wrap, int step);
ValueCounts faceCounts(RtInt nfaces, size_t corners, const RtInt vertices[]);

}  // namespace tomales::rib
