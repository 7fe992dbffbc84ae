#include "reyes/split/placement.h"

namespace tomales {
namespace {

constexpr float kRounding_px = 0.01f;  ///< Rounding of the projection of a box or its points.

/// Gives the same bits as transformBound(), from extremes of products instead of eight corners, because rounding is
/// monotonic.
Bound3 boundThrough(const mat4& m, const Bound3& b) {
  if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1) return transformBound(m, b);
  const vec3 x0 = vec3(m[0]) * b.lo.x, x1 = vec3(m[0]) * b.hi.x, y0 = vec3(m[1]) * b.lo.y, y1 = vec3(m[1]) * b.hi.y;
  const vec3 z0 = vec3(m[2]) * b.lo.z, z1 = vec3(m[2]) * b.hi.z, origin(m[3]);
  return {(glm::min(x0, x1) + glm::min(y0, y1)) + (glm::min(z0, z1) + origin),
          (glm::max(x0, x1) + glm::max(y0, y1)) + (glm::max(z0, z1) + origin)};
}

}  // namespace

Bound3 undisplacedBound(const Object& o, uint32_t patch, const UvRect& rect) {
  Bound3 object;
  for (const PrimPtr& shape : o.shapes) object.extend(shape->bound(patch, rect));
  Bound3 camera;
  for (const float t : o.keyTimes) camera.extend(boundThrough(o.cameraFromObject.at(t), object));
  return camera;
}

float pathLength_px(const Object& o, const Camera& camera, uint32_t patch, const UvRect& rect) {
  float length = 0;
  vec2 last(0);
  for (size_t k = 0; k < o.keyTimes.size(); ++k) {
    const vec3 middle = o.shapesAround(o.keyTimes[k]).before->bound(patch, rect).center();
    const vec2 at = camera.raster(transformPoint(o.cameraFromObject.at(o.keyTimes[k]), middle));
    if (k > 0) length += glm::length(at - last);
    last = at;
  }
  return length;
}

float leastBlur_px(const Camera& camera, float zMin, float zMax) {
  if (!camera.defocuses()) return 0;
  const vec2 a = camera.defocus(camera.depthKey(zMin)), b = camera.defocus(camera.depthKey(zMax));
  return dot(a, b) <= 0 ? 0 : 2 * std::min(glm::length(a), glm::length(b)) / std::sqrt(2.0f);
}

Bound2 rasterOf(const Bound3& bound, float reach_px, const Camera& camera, const Bound2& throughTheEye) {
  Bound2 raster;
  if (!camera.rasterBound(bound, raster)) raster = throughTheEye;
  const vec2 margin(2 * reach_px + kRounding_px);
  return {raster.lo - margin, raster.hi + margin};
}

std::optional<Placement> placeBox(const MovingBox& moving, const Camera& camera, const PixelRect& window,
                                  Clipping clipping) {
  Bound3 bound;
  for (const float t : moving.keyTimes) bound.extend(transformBound(moving.cameraFromObject.at(t), moving.box));
  bound = bound.grown(moving.margin);
  const Placement anywhere{{{window.x0, window.y0}, {window.x1, window.y1}}, -kInfinity};
  if (!isFinite(bound.lo) || !isFinite(bound.hi)) return anywhere;  // one bad patch must not spoil its neighbours
  const bool isUnseen = clipping == Clipping::On ? camera.outside(bound, window) : camera.outsideWindow(bound, window);
  if (isUnseen) return std::nullopt;
  return Placement{rasterOf(bound, borderReach_px(moving.margin), camera, anywhere.raster), bound.lo.z};
}

}  // namespace tomales
