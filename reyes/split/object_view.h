// Private to splitting: what the camera can see of an object's pieces. Bounds are in camera space, over the shutter;
// `bare` bounds are without displacement. Pure.
#pragma once
#include "reyes/split.h"

namespace tomales {

class ObjectView {
 public:
  /// `window`: the raster pixels that have samples. All arguments must outlive this object.
  ObjectView(const Object& object, const Camera& camera, const PixelRect& window)
      : object_(object), camera_(camera), window_(window) {}

  bool cannotBeSeen(const Bound3& bare) const;
  /// Tells whether the undisplaced bound crosses the eye plane. A displacement bound does not shrink with halving, so
  /// it does not count.
  bool crossesEye(const Bound3& bare) const { return camera_.perspective() && bare.lo.z < camera_.eyePlane(); }
  /// Tells whether all of the bound is seen at about the same scale. If not, the cost of its near end says little about
  /// the rest.
  bool isOfOneScale(const Bound3& bare) const;
  /// Returns the raster bound of the part beyond the near plane.
  Bound2 rasterOf(Bound3 bound, float reach_px) const;
  /// Returns the factor, at least 1, by which blur lets edges be longer than the shading rate asks for. A micropolygon
  /// may be as wide as a quarter of the circle of confusion, and its area may be a quarter of the length of its path,
  /// both times the factors of GeometricApproximation.
  float coarsening(uint32_t patch, const UvRect& rect, const Bound3& bound) const;
  /// Tells whether the patch is a whole disk that can be one round cell, without corners or neighbours.
  bool canBeRound(uint32_t patch) const {
    return standsStillInFocus(object_, camera_) && object_.shape().info(patch).disk;
  }

 private:
  const Object& object_;
  const Camera& camera_;
  const PixelRect& window_;
};

}  // namespace tomales
