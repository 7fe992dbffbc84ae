#include "gi/gather/polygon_start.h"

#include "raytrace/hit_list.h"

namespace tomales {

PolygonStart polygonStart(const RayScene& scene, const Ray& first, RayMask mask) {
  const float reach = recordingWindow(first.offset);
  if (!(reach > 0)) return {};
  Ray across = first;
  across.origin -= reach * first.direction;
  across.tMax = 2 * reach;
  across.offset = across.bias = 0;
  across.surroundings = nullptr;
  // Nothing is changed if the first hit is the other side of a wall, a convex surface or another object.
  const Hit hit = scene.closest(across, mask);
  if (hit.object < 0 || scene.groupOf(hit) != first.group) return {};
  const float height = hit.t - reach;
  if (height < -2 * roundingAt(first.origin)) return {};
  const float side = dot(hit.geometricNormal, first.direction);
  return {height * first.direction, side < 0 ? -hit.geometricNormal : hit.geometricNormal};
}

}  // namespace tomales
