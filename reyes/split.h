// Verb: Scene -> sub-patches small enough to dice, each with its raster bound. Bound, cull, judge, halve; a piece that
// crosses the eye plane is halved until its parts lie on one side. One pass over the whole frame; depends on the camera
// and on ShadingRate, never on buckets, crop or threads.
#pragma once
#include "reyes/base/stats.h"
#include "reyes/scene.h"

namespace tomales {

/// A rectangle of a patch that one grid can hold, and the size of that grid.
struct SubPatch {
  int object;
  uint32_t patch;
  UvRect rect;
  int nu, nv;
  Bound2 raster;    ///< Conservative, over the shutter, displacement included.
  float zMin;       ///< Nearest camera z, likewise.
};

/// `window`: raster pixels that have samples; what lies wholly outside is culled. Order: by object, then by place.
std::vector<SubPatch> splitScene(const Scene& scene, const Camera& camera, const PixelRect& window, Stats& stats, Log& log);

/// Lengths in camera space of a rectangle's longest u and v lines, and the raster lengths when the camera sees it:
/// what dicing and ray tessellation choose their rates from.
struct PatchSize { float u_px, v_px, u_length, v_length; };
PatchSize measure(const Object& object, const Camera& camera, uint32_t patch, const UvRect& rect);

}  // namespace tomales
