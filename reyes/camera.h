// Noun: the projection of a frame. Camera space (eye at the origin, +x right, +y up, +z into the scene) to raster
// space (pixels, origin at the top left, y down).
// Threads: immutable.
#pragma once
#include <cfloat>

#include "reyes/state.h"

namespace tomales {

class Camera {
 public:
  explicit Camera(const Options& options);

  int xResolution() const { return xResolution_; }
  int yResolution() const { return yResolution_; }
  /// Return the size of the picture, which FrameAspectRatio may make smaller than the format.
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  float frameAspect() const { return frameAspect_; }
  /// Returns the pixels of CropWindow (RISpec: abutting windows tile exactly).
  PixelRect crop() const { return crop_; }
  bool perspective() const { return perspective_; }
  float nearClip() const { return near_; }
  float farClip() const { return far_; }

  /// Geometry nearer than this cannot be diced. It is half as far as the near plane, so that surfaces which the near
  /// plane cuts can still be diced.
  float eyePlane() const { return 0.5f * near_; }
  /// Tells whether the point is finite, and not nearer than the eye plane. Then `raster` is defined, and so is the
  /// depth key.
  bool seeable(const vec3& p) const {
    // A branch would keep it from being vectorised.
    const float nearest = perspective_ ? eyePlane() : -FLT_MAX;
    return (std::abs(p.x) <= FLT_MAX) & (std::abs(p.y) <= FLT_MAX) & (p.z >= nearest) & (p.z <= FLT_MAX);
  }
  /// Returns raster x, y. Pre: p.z > 0 under perspective.
  vec2 raster(const vec3& p) const {
    const float w = perspective_ ? 1.0f / p.z : 1.0f;
    return {offset_.x + scale_.x * p.x * w, offset_.y + scale_.y * p.y * w};
  }
  /// Tells whether near or far clipping or a clipping plane cuts off a point. It is not tested against the window.
  bool clips(const vec3& p) const;
  /// Tells the same of the point that a sample at raster position `at` sees at a depth key. `lens` is the raster shift
  /// of the sample's lens point at the depth key focusKey() + 1.
  bool clips(const vec2& at, const vec2& lens, float key) const;
  /// Returns a depth that grows with distance and is linear in raster space: -1/z under perspective, z otherwise.
  float depthKey(float z) const { return perspective_ ? -1.0f / z : z; }
  /// Returns the least depth key of points that are no nearer than z and not clipped; z may lie behind the eye.
  float leastDepthKey(float z) const { return perspective_ ? -1.0f / std::max(z, near_) : z; }
  float zFromDepthKey(float key) const { return perspective_ ? -1.0f / key : key; }

  /// Returns how far, in raster x and y, the rim of the lens moves a point of this depth key: 0 on the focal plane, a
  /// negative number nearer. Lens point l (unit disk) sees a point at raster + l * defocus(depthKey). This is exact for
  /// a thin lens, as the line through the lens meets the focal plane there (RISpec 3.2 section 4.1.2, DepthOfField).
  vec2 defocus(float key) const { return lens_ * (key - focusKey_); }
  bool defocuses() const { return lens_ != vec2(0); }
  vec2 lens() const { return lens_; }
  float focusKey() const { return focusKey_; }

  /// Conservative raster bound of a camera-space box, defocus included. Returns false where it is nearer than
  /// `eyePlane` under perspective: the box must be split or culled first.
  bool rasterBound(const Bound3& b, Bound2& out) const;

  /// Returns true only if no point of the box can be seen through `window`: it lies outside a side of the frustum,
  /// nearer than `nearClip`, beyond `farClip` or a clipping plane; defocus included. It works for boxes that cross the
  /// eye plane.
  bool outside(const Bound3& b, const PixelRect& window) const;
  /// Does the same without `farClip` and clipping planes: it returns true only if no line of sight through the window
  /// meets the box.
  bool outsideWindow(const Bound3& b, const PixelRect& window) const;

  /// Returns the width in camera space of one pixel's footprint at p, on a surface that faces the eye. The footprint on
  /// a slanted surface is longer by 1 / |cos| of the angle (Tabellion and Lamorlette 2004, section 4.5).
  float pixelSize(const vec3& p) const { return perspective_ ? glm::length(p) * pixelSizeAtUnit_ : pixelSizeAtUnit_; }
  /// Returns RSL's I: the vector from the eye to p, not normalised (orthographic: +z).
  vec3 incident(const vec3& p) const { return perspective_ ? p : vec3(0, 0, 1); }
  /// Returns the ray through raster position r: origin and unit direction in camera space.
  void ray(const vec2& r, vec3& origin, vec3& direction) const;

 private:
  int xResolution_, yResolution_;
  bool perspective_;
  float near_, far_;
  vec2 scale_, offset_;  ///< raster = offset + scale * (x, y) [/ z]
  float pixelSizeAtUnit_;
  float frameAspect_ = 1;
  int columns_ = 1, rows_ = 1;
  vec2 lens_{0};  ///< Raster shift at the lens's rim for one unit of depth key; 0 for a pinhole.
  float focusKey_ = 0;
  PixelRect crop_;
  std::vector<vec4> planes_;
};

}  // namespace tomales
