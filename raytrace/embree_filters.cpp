#include "raytrace/embree_filters.h"

namespace tomales {
namespace {

PolygonHit hitOf(const RTCFilterFunctionNArguments& args, const Traversal& traversal) {
  const vec3 direction(RTCRayN_dir_x(args.ray, 1, 0), RTCRayN_dir_y(args.ray, 1, 0), RTCRayN_dir_z(args.ray, 1, 0));
  const vec3 normal(RTCHitN_Ng_x(args.hit, 1, 0), RTCHitN_Ng_y(args.hit, 1, 0), RTCHitN_Ng_z(args.hit, 1, 0));
  const Geometry& geometry = *static_cast<const Geometry*>(args.geometryUserPtr);
  return traversal.hit(geometry, RTCRayN_tfar(args.ray, 1, 0) - traversal.shift, RTCHitN_instID(args.hit, 1, 0, 0),
                       RTCHitN_primID(args.hit, 1, 0), RTCHitN_u(args.hit, 1, 0), RTCHitN_v(args.hit, 1, 0),
                       leaves(direction, normal, geometry.flips), normal);
}

bool isOpaque(const RTCFilterFunctionNArguments& args, const Traversal& traversal, const PolygonHit& hit) {
  return hit.instance >= 0 ? traversal.instances->opaque[static_cast<size_t>(hit.instance)]
                           : static_cast<const Geometry*>(args.geometryUserPtr)->opaque;
}

/// Rejects a hit that the ray does not see. Returns true if nothing is left to do.
bool rejected(const RTCFilterFunctionNArguments* args, const Traversal& traversal) {
  if (!args->valid[0]) return true;
  if (!traversal.filter) return false;
  const PolygonHit hit = hitOf(*args, traversal);
  if (!traversal.filter->passes(hit.group, hit.leaving)) args->valid[0] = 0;
  return !args->valid[0];
}

}  // namespace

void rejectUnseen(const RTCFilterFunctionNArguments* args) {
  rejected(args, *reinterpret_cast<const Traversal*>(args->context));
}

void recordNear(const RTCFilterFunctionNArguments* args) {
  const auto& traversal = *reinterpret_cast<const Traversal*>(args->context);
  const bool isNear = RTCRayN_tfar(args->ray, 1, 0) <= traversal.shift + traversal.window;
  if ((!isNear && !traversal.filter) || rejected(args, traversal) || !isNear) return;
  traversal.list->push_back(hitOf(*args, traversal));
  args->valid[0] = 0;
}

void recordShadow(const RTCFilterFunctionNArguments* args) {
  const auto& traversal = *reinterpret_cast<const Traversal*>(args->context);
  if (rejected(args, traversal)) return;
  const PolygonHit hit = hitOf(*args, traversal);
  const bool counts = hit.t < traversal.tMax;
  if (counts && hit.t > traversal.window && isOpaque(*args, traversal, hit)) return;
  if (counts) traversal.list->push_back(hit);
  args->valid[0] = 0;
}

void recordAll(const RTCFilterFunctionNArguments* args) {
  const auto& traversal = *reinterpret_cast<const Traversal*>(args->context);
  if (!args->valid[0]) return;
  traversal.list->push_back(hitOf(*args, traversal));
  args->valid[0] = 0;
}

void rejectAbsent(const RTCFilterFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const Geometry& geometry = *static_cast<const Geometry*>(args->geometryUserPtr);
  const auto [mesh, quad] = geometry.place(RTCHitN_primID(args->hit, 1, 0));
  if (!geometry.detail.contains(reinterpret_cast<const Traversal*>(args->context)->detailNumber) ||
      !geometry.meshes[mesh].keeps(quad, RTCHitN_u(args->hit, 1, 0), RTCHitN_v(args->hit, 1, 0)))
    args->valid[0] = 0;
}

}  // namespace tomales
