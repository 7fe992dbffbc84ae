// Each shader of shaders/ as one loop over the points by hand, which knows everything beforehand: as plain C++ of one
// point after another (fused.cpp), and over vectors of points (by_hand.cpp). Both are the text of loops/, over other
// numbers. Threads: any.
#pragma once
#include <span>
#include <string_view>

#include "tests/bench/rsl/batch.h"

namespace tomales::bench {

struct Loop {
  std::string_view name;  ///< Name of the shader.
  void (*run)(const Batch& batch);
};
std::span<const Loop> fusedLoops();
std::span<const Loop> vectorLoops();

/// Light as the loops over vectors work it out, for the renderer that shaders in RSL ask.
struct Services {
  void (*diffuse)(const Batch& batch, TmConstVec3 N, TmVec3 out);
  void (*specular)(const Batch& batch, TmConstVec3 N, TmConstVec3 V, const float* roughness, TmVec3 out);
};
const Services& vectorServices();

}  // namespace tomales::bench
