// How many quadrilaterals a patch becomes for rays along u and v (the rule is in raytrace/tessellate.h).
#pragma once
#include "reyes/camera.h"
#include "reyes/scene.h"

namespace tomales {

struct CoarseRate {
  int nu, nv;
};
/// A patch that asks for millions is reported and gets fewer.
CoarseRate coarseRate(const Scene& scene, const Camera& camera, int object, uint32_t patch, Log& log);

}  // namespace tomales
