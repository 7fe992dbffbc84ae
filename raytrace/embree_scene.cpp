#include "raytrace/embree_scene.h"

#include "raytrace/embree_world.h"
#include "reyes/base/parallel.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

/// Embree takes no negative tnear: the ray starts `shift` before its origin.
RTCRay rayFrom(const Ray& ray, float shift, float tNear, uint32_t mask) {
  const vec3 origin = ray.origin - shift * ray.direction;
  RTCRay r{};
  r.org_x = origin.x;
  r.org_y = origin.y;
  r.org_z = origin.z;
  r.dir_x = ray.direction.x;
  r.dir_y = ray.direction.y;
  r.dir_z = ray.direction.z;
  r.tnear = tNear;
  r.tfar = ray.tMax + shift;
  r.time = ray.time;
  r.mask = maskAt(mask, ray.level);
  return r;
}

const SharedShapes kNoShapes;

}  // namespace

struct EmbreeScene::Impl : EmbreeWorld {
  using EmbreeWorld::EmbreeWorld;

  float detailNumberOf(const Ray& ray) const {
    if (!fades) return 0;
    uint32_t name = 0;
    for (const vec3& v : {ray.origin, ray.direction})
      for (int axis = 0; axis < 3; ++axis) name = hashCombine(name, __builtin_bit_cast(uint32_t, v[axis]));
    const DetailShare from = ray.group >= 0 ? groups[static_cast<size_t>(ray.group)].detail : DetailShare{};
    return std::min(lerp(from.lo, from.hi, unitFloat(name)), 0x1.fffffep-1f);
  }

  Traversal traversalOf(const Ray& ray, RTCFilterFunctionN filter, float shift, float window, HitList* list) const {
    Traversal t{{}, shift, window, ray.tMax, list, &instances, ray.filter, detailNumberOf(ray)};
    rtcInitIntersectContext(&t.embree);
    t.embree.filter = filter;
    return t;
  }

  /// `mask` is Embree's mask.
  void addTo(Surroundings& out, uint32_t geometryId, uint32_t primitive, uint32_t mask) const {
    if (geometryId >= instances.firstChunk) {
      if (chunks->maskOf(geometryId - instances.firstChunk) & mask) out.giveUp();
      return;
    }
    const Geometry& geometry = geometries[geometryId];
    if (!(geometry.mask & mask)) return;
    const auto [mesh, quad] = geometry.place(primitive);
    const CoarseGroup& g = geometry.meshes[mesh];
    if (g.trimmed || !g.detail.whole()) return out.giveUp();
    out.add(mesh, quad, g.flipsNormal, g.corners(quad));
  }

  void addOfInstance(Surroundings& out, uint32_t instance, uint32_t quad, uint32_t mask) const {
    if (!(instances.mask[instance] & mask)) return;
    const auto& [object, group, master, cameraFromObject, normals] = shapes.instances[instance];
    const CoarseGroup& g = shapes.masters[master];
    if (g.trimmed) return out.giveUp();
    const std::array<vec3, 4> corners = g.corners(quad);
    std::array<vec3, 4> placed = corners;
    for (vec3& p : placed) p = transformPoint(cameraFromObject, p);
    out.add(group, quad, g.flipsNormal != instances.mirrors[instance], placed, static_cast<int>(instance), corners);
  }

  void requireChunks() const {
    if (chunks && chunks->failed()) throw std::bad_alloc();
  }

  bool trace(const Ray& ray, float shift, float tNear, uint32_t mask, Traversal& traversal, PolygonHit& out) const {
    RTCRayHit r{rayFrom(ray, shift, tNear, mask), {}};
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &traversal.embree, &r);
    requireChunks();
    const float t = r.ray.tfar - shift;
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID || t >= ray.tMax) return false;
    const uint32_t instance = r.hit.instID[0];
    const bool inChunk = instance != RTC_INVALID_GEOMETRY_ID && instance >= instances.firstChunk;
    const CoarseInstance* placed =
        instance != RTC_INVALID_GEOMETRY_ID && !inChunk ? &shapes.instances[instance - instances.firstId] : nullptr;
    const Geometry& geometry = inChunk  ? chunks->geometryOf(instance - instances.firstChunk)
                               : placed ? masters[placed->master]
                                        : geometries[r.hit.geomID];
    const vec3 normal(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z);
    out = traversal.hit(geometry, t, instance, r.hit.primID, r.hit.u, r.hit.v,
                        leaves(ray.direction, placed ? placed->normals * normal : normal, geometry.flips), normal);
    return true;
  }
};

EmbreeScene::EmbreeScene(const RayGroups& groups, const SharedShapes& shapes, const Chunks& chunks, size_t chunkBytes,
                         Log& log)
    : impl_(std::make_unique<Impl>(groups.meshes, shapes)) {
  impl_->attachGroups(groups, false);
  // With several threads the order of primitives in a leaf would depend on their number, and with it which of two hits
  // at equal t is found first.
  const ThreadLimit one(1);
  impl_->attachInstances(groups);
  const uint32_t end = impl_->instances.firstChunk;
  if (!chunks.all().empty())
    impl_->chunks.emplace(chunks, chunkBytes)
        .attach(impl_->device, impl_->scene, end, end, groups.meshes, groups.masks, groups.opaque);
  impl_->commit(log);
}

EmbreeScene::EmbreeScene(const RayGroups& groups, Log& log) : impl_(std::make_unique<Impl>(groups.meshes, kNoShapes)) {
  impl_->attachGroups(groups, true);
  const ThreadLimit one(1);  // the reason is that of the other constructor
  impl_->attachInstances(groups);
  impl_->commit(log);
}

EmbreeScene::~EmbreeScene() = default;

bool EmbreeScene::nearest(const Ray& ray, uint32_t mask, PolygonHit& hit) const {
  Traversal traversal = impl_->traversalOf(ray, ray.filter ? &rejectUnseen : nullptr, 0, 0, nullptr);
  return impl_->trace(ray, 0, std::max(ray.bias, 0.0f), mask, traversal, hit);
}

void EmbreeScene::around(const vec3& P, float reach, uint32_t mask, TessellationLevel level, Surroundings& out) const {
  struct Asked {
    const Impl& scene;
    uint32_t mask;
    Surroundings& out;
  } asked{*impl_, maskAt(mask, level), out};
  out.reset(P, reach);
  RTCPointQuery query{P.x, P.y, P.z, 0, reach + 2 * roundingAt(P)};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  const auto meets = [](RTCPointQueryFunctionArguments* args) {
    const Asked& a = *static_cast<Asked*>(args->userPtr);
    if (args->context->instStackSize > 0)
      a.scene.addOfInstance(a.out, args->context->instID[0] - a.scene.instances.firstId, args->primID, a.mask);
    else
      a.scene.addTo(a.out, args->geomID, args->primID, a.mask);
    if (!a.out.gaveUp()) return false;
    args->query->radius = 0;
    return true;
  };
  rtcPointQuery(impl_->scene, &query, &context, meets, &asked);
}

bool EmbreeScene::nearestBeyond(const Ray& ray, float window, uint32_t mask, HitList& list, PolygonHit& beyond) const {
  list.clear();
  if (ray.surroundings && ray.time == 0 && ray.surroundings->know(ray.origin, window)) {
    // A hit at the end of the window may be found twice, but must not be missed.
    ray.surroundings->meet(ray.direction, window + roundingAt(ray.origin), list);
    if (ray.filter)
      std::erase_if(list, [&](const PolygonHit& hit) { return !ray.filter->passes(hit.group, hit.leaving); });
    Traversal traversal = impl_->traversalOf(ray, ray.filter ? &rejectUnseen : nullptr, 0, 0, nullptr);
    return impl_->trace(ray, 0, window, mask, traversal, beyond);
  }
  Traversal traversal = impl_->traversalOf(ray, &recordNear, window, window, &list);
  return impl_->trace(ray, window, 0, mask, traversal, beyond);
}

bool EmbreeScene::blockedBeyond(const Ray& ray, float window, uint32_t mask, HitList& list) const {
  list.clear();
  const float shift = std::max(window, 0.0f);
  Traversal traversal = impl_->traversalOf(ray, &recordShadow, shift, window, &list);
  RTCRay r = rayFrom(ray, shift, window < 0 ? std::max(ray.bias, 0.0f) : 0.0f, mask);
  rtcOccluded1(impl_->scene, &traversal.embree, &r);
  impl_->requireChunks();
  return r.tfar < 0;
}

void EmbreeScene::all(const Ray& ray, float window, HitList& list) const {
  list.clear();
  Ray line = ray;
  line.tMax = kInfinity;
  Traversal traversal = impl_->traversalOf(line, &recordAll, window, 0, &list);
  RTCRay r = rayFrom(line, window, 0, ~0U);
  rtcOccluded1(impl_->scene, &traversal.embree, &r);
  impl_->requireChunks();
}

vec3 EmbreeScene::normal(const PolygonHit& hit) const { return impl_->chunks->normal(hit); }

ResidentFigures EmbreeScene::chunkFigures() const {
  return impl_->chunks ? impl_->chunks->figures() : ResidentFigures{};
}

size_t EmbreeScene::bytes() const { return static_cast<size_t>(std::max<int64_t>(0, impl_->bytes)); }

}  // namespace tomales
