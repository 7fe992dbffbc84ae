// Private to splitting: bounds of pieces in camera space and in raster space.
#pragma once
#include "reyes/split.h"

namespace tomales {

/// Returns the box in camera space around a rectangle, over the shutter, before displacement. (cameraBound() in
/// reyes/camera_bound.h returns the box around a whole object after displacement.)
Bound3 undisplacedBound(const Object& o, uint32_t patch, const UvRect& rect);
/// Returns the raster length of the path of a rectangle's middle over the shutter. Pre: it stays in front of the eye.
float pathLength_px(const Object& o, const Camera& camera, uint32_t patch, const UvRect& rect);
/// Returns the least diameter of the circle of confusion in a range of depths; 0 if the focal plane is among them.
float leastBlur_px(const Camera& camera, float zMin, float zMax);
/// Returns the raster bound, grown by the distance that the hider may push borders: at a corner both are pushed.
Bound2 rasterOf(const Bound3& bound, float reach_px, const Camera& camera, const Bound2& throughTheEye = {});

}  // namespace tomales
