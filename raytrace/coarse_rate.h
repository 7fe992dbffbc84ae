// Chooses how many quadrilaterals a patch becomes for rays along u and v (the rule is in raytrace/tessellate.h).
#pragma once
#include <array>

#include "raytrace/level.h"
#include "reyes/camera.h"
#include "reyes/scene.h"

namespace tomales {

struct CoarseRate {
  int nu, nv;
};
/// Returns the rate of the coarse polygons, whose edges and turns are `longer` times what is asked. A patch that asks
/// for millions is reported and gets fewer. log: null reports nothing.
CoarseRate coarseRate(const Scene& scene, const Camera& camera, int object, uint32_t patch, float longer, Log* log);
/// Returns the rates of the levels in chunks. Each is no coarser than the next, and the last no coarser than
/// coarseRate().
std::array<CoarseRate, kLevelsInChunks> levelRates(const Scene& scene, const Camera& camera, int object, uint32_t patch,
                                                   Log& log);

bool displacesForRays(const Object& object);
/// Tells whether the patch is exactly one quadrilateral.
inline bool isExactQuad(const Object& o, uint32_t patch) {
  return o.shape().info(patch).planar && !displacesForRays(o);
}

}  // namespace tomales
