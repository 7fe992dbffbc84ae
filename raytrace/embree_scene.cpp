#include "raytrace/embree_scene.h"

#include <embree3/rtcore.h>

#include <atomic>
#include <deque>
#include <map>
#include <tuple>

#include "reyes/base/parallel.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

/// The groups that rays treat alike share one Embree geometry: a geometry of its own for each would cost 65 kB, and a scene
/// may have a group for every object.
struct Geometry {
  bool opaque, flips;
  DetailShare detail;
  std::vector<uint32_t> groupOfQuad;
  const std::vector<uint32_t>* firstQuad;  ///< of each group, in its geometry
  const std::vector<CoarseGroup>* groups;

  PolygonHit hit(float t, uint32_t primitive, float u, float v, bool leaving) const {
    const uint32_t group = groupOfQuad[primitive];
    return {t, group, primitive - (*firstQuad)[group], u, v, leaving};
  }
};

/// What filters are given beside the hit. Embree hands back the address of its first member.
struct Traversal {
  RTCIntersectContext embree;
  float shift = 0;  ///< Embree's t of the ray's own origin.
  float window = 0;
  float tMax = kInfinity;
  HitList* list = nullptr;
  float level = 0;  ///< The ray's number for levels of detail.
};
static_assert(std::is_standard_layout_v<Traversal>);

bool leaves(const vec3& direction, const vec3& normal, bool flips) {
  return (dot(direction, normal) > 0) != flips;
}

PolygonHit hitOf(const RTCFilterFunctionNArguments& args, const Traversal& traversal) {
  const vec3 direction(RTCRayN_dir_x(args.ray, 1, 0), RTCRayN_dir_y(args.ray, 1, 0),
                       RTCRayN_dir_z(args.ray, 1, 0));
  const vec3 normal(RTCHitN_Ng_x(args.hit, 1, 0), RTCHitN_Ng_y(args.hit, 1, 0), RTCHitN_Ng_z(args.hit, 1, 0));
  const Geometry& geometry = *static_cast<const Geometry*>(args.geometryUserPtr);
  return geometry.hit(RTCRayN_tfar(args.ray, 1, 0) - traversal.shift, RTCHitN_primID(args.hit, 1, 0),
                      RTCHitN_u(args.hit, 1, 0), RTCHitN_v(args.hit, 1, 0), leaves(direction, normal, geometry.flips));
}

/// Records and rejects hits in the window, accepts those beyond.
void recordNear(const RTCFilterFunctionNArguments* args) {
  const auto& traversal = *reinterpret_cast<const Traversal*>(args->context);
  if (!args->valid[0] || RTCRayN_tfar(args->ray, 1, 0) - traversal.shift > traversal.window) return;
  traversal.list->push_back(hitOf(*args, traversal));
  args->valid[0] = 0;
}

/// Accepts what is opaque beyond the window, which ends the traversal; records and rejects all else.
void recordShadow(const RTCFilterFunctionNArguments* args) {
  const auto& traversal = *reinterpret_cast<const Traversal*>(args->context);
  if (!args->valid[0]) return;
  const PolygonHit hit = hitOf(*args, traversal);
  const bool counts = hit.t < traversal.tMax;
  if (counts && hit.t > traversal.window && static_cast<const Geometry*>(args->geometryUserPtr)->opaque)
    return;
  if (counts) traversal.list->push_back(hit);
  args->valid[0] = 0;
}

/// Records and rejects every hit.
void recordAll(const RTCFilterFunctionNArguments* args) {
  const auto& traversal = *reinterpret_cast<const Traversal*>(args->context);
  if (!args->valid[0]) return;
  traversal.list->push_back(hitOf(*args, traversal));
  args->valid[0] = 0;
}

/// Rejects hits that trim curves have cut away, and levels of detail that the ray does not see. Embree asks it before the
/// filters of a traversal.
void rejectUnseen(const RTCFilterFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const Geometry& geometry = *static_cast<const Geometry*>(args->geometryUserPtr);
  if (!geometry.detail.contains(reinterpret_cast<const Traversal*>(args->context)->level)) {
    args->valid[0] = 0;
    return;
  }
  const PolygonHit hit =
      geometry.hit(0, RTCHitN_primID(args->hit, 1, 0), RTCHitN_u(args->hit, 1, 0), RTCHitN_v(args->hit, 1, 0), false);
  if (!(*geometry.groups)[hit.group].keeps(hit.quad, hit.u, hit.v)) args->valid[0] = 0;
}

/// Embree takes no negative tnear: the ray starts `shift` before its origin.
RTCRay rayFrom(const Ray& ray, float shift, float tNear, uint32_t mask) {
  const vec3 origin = ray.origin - shift * ray.direction;
  RTCRay r{};
  r.org_x = origin.x, r.org_y = origin.y, r.org_z = origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.tnear = tNear, r.tfar = ray.tMax + shift, r.time = ray.time;
  r.mask = mask;
  return r;
}

}  // namespace

struct EmbreeScene::Impl {
  const std::vector<CoarseGroup>& groups;
  bool fades = false;  ///< Some group does.
  std::atomic<int64_t> bytes{0};
  std::vector<uint32_t> firstQuad{};
  std::deque<Geometry> geometries{};  ///< By Embree's geomID; Embree keeps their addresses.
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  static bool countBytes(void* self, ssize_t bytes, bool) {
    static_cast<Impl*>(self)->bytes += bytes;
    return true;
  }

  float levelOf(const Ray& ray) const {
    if (!fades) return 0;
    uint32_t name = 0;
    for (const vec3& v : {ray.origin, ray.direction})
      for (int axis = 0; axis < 3; ++axis) name = hashCombine(name, __builtin_bit_cast(uint32_t, v[axis]));
    const DetailShare from = ray.group >= 0 ? groups[static_cast<size_t>(ray.group)].detail : DetailShare{};
    return std::min(lerp(from.lo, from.hi, unitFloat(name)), 0x1.fffffep-1f);
  }

  Traversal traversalOf(const Ray& ray, RTCFilterFunctionN filter, float shift, float window, HitList* list) const {
    Traversal t{{}, shift, window, ray.tMax, list, levelOf(ray)};
    rtcInitIntersectContext(&t.embree);
    t.embree.filter = filter;
    return t;
  }

  /// One geometry of the given groups. Embree pads the vertex buffer that it allocates, of which it reads 16 bytes at the last.
  void attach(const std::vector<uint32_t>& members, uint32_t mask, bool opaque) {
    const size_t steps = groups[members.front()].laterP.size() + 1;
    size_t vertexCount = 0, quadCount = 0;
    for (const uint32_t g : members) vertexCount += groups[g].P.size(), quadCount += groups[g].quads.size();
    const auto id = static_cast<unsigned>(geometries.size());
    Geometry& out = geometries.emplace_back(Geometry{
        opaque, groups[members.front()].flipsNormal, groups[members.front()].detail, {}, &firstQuad, &groups});
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
    rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(steps));
    std::vector<vec3*> vertices;
    for (unsigned step = 0; step < steps; ++step)
      vertices.push_back(static_cast<vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT3,
                                                                    sizeof(vec3), vertexCount)));
    auto* quads = static_cast<Quad*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, sizeof(Quad), quadCount));
    uint32_t firstVertex = 0;
    for (const uint32_t g : members) {
      if (!vertices.back() || !quads) break;  // out of memory: the device's error tells
      firstQuad[g] = static_cast<uint32_t>(out.groupOfQuad.size());
      out.groupOfQuad.insert(out.groupOfQuad.end(), groups[g].quads.size(), g);
      for (size_t step = 0; step < steps; ++step) {
        const std::vector<vec3>& P = step == 0 ? groups[g].P : groups[g].laterP[step - 1];
        vertices[step] = std::copy(P.begin(), P.end(), vertices[step]);
      }
      for (const Quad& q : groups[g].quads)
        *quads++ = {q[0] + firstVertex, q[1] + firstVertex, q[2] + firstVertex, q[3] + firstVertex};
      firstVertex += static_cast<uint32_t>(groups[g].P.size());
    }
    rtcSetGeometryMask(geometry, mask);
    rtcSetGeometryUserData(geometry, &out);
    const CoarseGroup& like = groups[members.front()];
    if (like.trimmed || !like.detail.whole()) {
      rtcSetGeometryIntersectFilterFunction(geometry, rejectUnseen);
      rtcSetGeometryOccludedFilterFunction(geometry, rejectUnseen);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
  }

  bool trace(const Ray& ray, float shift, float tNear, uint32_t mask, Traversal& traversal,
             PolygonHit& out) const {
    RTCRayHit r{rayFrom(ray, shift, tNear, mask), {}};
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &traversal.embree, &r);
    const float t = r.ray.tfar - shift;
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID || t >= ray.tMax) return false;
    const Geometry& geometry = geometries[r.hit.geomID];
    out = geometry.hit(t, r.hit.primID, r.hit.u, r.hit.v,
                       leaves(ray.direction, {r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z}, geometry.flips));
    return true;
  }
};

EmbreeScene::EmbreeScene(const std::vector<CoarseGroup>& groups, const std::vector<uint32_t>& masks,
                         const std::vector<bool>& opaque, bool solids, Log& log)
    : impl_(new Impl{groups}) {
  impl_->device = rtcNewDevice(nullptr);
  rtcSetDeviceMemoryMonitorFunction(impl_->device, &Impl::countBytes, impl_.get());
  impl_->scene = rtcNewScene(impl_->device);
  rtcSetSceneFlags(impl_->scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                                            RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  std::map<std::tuple<uint32_t, bool, bool, bool, size_t, float, float>, std::vector<uint32_t>> alike;
  for (uint32_t i = 0; i < groups.size(); ++i) {
    const CoarseGroup& g = groups[i];
    impl_->fades |= !g.detail.whole();
    if (!g.quads.empty() && g.solid == solids)
      alike[{masks[i], opaque[i], g.flipsNormal, g.trimmed, g.laterP.size(), g.detail.lo, g.detail.hi}].push_back(i);
  }
  impl_->firstQuad.resize(groups.size());
  for (const auto& [kind, members] : alike) impl_->attach(members, std::get<0>(kind), std::get<1>(kind));
  // With several threads the order of primitives in a leaf, and with it which of two hits at equal t is found
  // first, would depend on their number.
  const ThreadLimit one(1);
  rtcCommitScene(impl_->scene);
  if (rtcGetDeviceError(impl_->device) != RTC_ERROR_NONE)
    log.report(Severity::Missing, "trace-embree", {},
               "Embree could not build the scene for rays: they may miss objects");
}

EmbreeScene::~EmbreeScene() {
  if (impl_->scene) rtcReleaseScene(impl_->scene);
  if (impl_->device) rtcReleaseDevice(impl_->device);
}

bool EmbreeScene::nearest(const Ray& ray, uint32_t mask, PolygonHit& hit) const {
  Traversal traversal = impl_->traversalOf(ray, nullptr, 0, 0, nullptr);
  return impl_->trace(ray, 0, std::max(ray.bias, 0.0f), mask, traversal, hit);
}

bool EmbreeScene::nearestBeyond(const Ray& ray, float window, uint32_t mask, HitList& list,
                                PolygonHit& beyond) const {
  list.clear();
  Traversal traversal = impl_->traversalOf(ray, &recordNear, window, window, &list);
  return impl_->trace(ray, window, 0, mask, traversal, beyond);
}

bool EmbreeScene::blockedBeyond(const Ray& ray, float window, uint32_t mask, HitList& list) const {
  list.clear();
  const float shift = std::max(window, 0.0f);
  Traversal traversal = impl_->traversalOf(ray, &recordShadow, shift, window, &list);
  RTCRay r = rayFrom(ray, shift, window < 0 ? std::max(ray.bias, 0.0f) : 0.0f, mask);
  rtcOccluded1(impl_->scene, &traversal.embree, &r);
  return r.tfar < 0;
}

void EmbreeScene::all(const Ray& ray, float window, HitList& list) const {
  list.clear();
  Ray line = ray;
  line.tMax = kInfinity;
  Traversal traversal = impl_->traversalOf(line, &recordAll, window, 0, &list);
  RTCRay r = rayFrom(line, window, 0, ~0U);
  rtcOccluded1(impl_->scene, &traversal.embree, &r);
}

size_t EmbreeScene::bytes() const { return static_cast<size_t>(std::max<int64_t>(0, impl_->bytes)); }

}  // namespace tomales
