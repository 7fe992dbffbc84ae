#include "raytrace/embree_scene.h"

#include <atomic>
#include <deque>
#include <map>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>

#include "raytrace/embree_buffers.h"
#include "raytrace/embree_chunks.h"
#include "reyes/base/parallel.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr size_t kManyQuads =
    4096;  ///< A geometry of its own costs less than copies of so many quads (Geometry in raytrace/embree_filters.h).

/// Embree takes no negative tnear: the ray starts `shift` before its origin.
RTCRay rayFrom(const Ray& ray, float shift, float tNear, uint32_t mask) {
  const vec3 origin = ray.origin - shift * ray.direction;
  RTCRay r{};
  r.org_x = origin.x, r.org_y = origin.y, r.org_z = origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.tnear = tNear, r.tfar = ray.tMax + shift, r.time = ray.time;
  r.mask = maskAt(mask, ray.level);
  return r;
}

/// Throws std::bad_alloc where memory does not suffice, which Embree tells by returning no device.
RTCDevice newDevice() {
  if (const RTCDevice device = rtcNewDevice(nullptr)) return device;
  const RTCError error = rtcGetDeviceError(nullptr);
  if (error == RTC_ERROR_UNSUPPORTED_CPU)
    throw std::runtime_error("rays cannot be traced: Embree does not know this processor");
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw std::runtime_error("rays cannot be traced: Embree does not start (error " + std::to_string(error) +
                           "); is there too little memory?");
}

const SharedShapes kNoShapes;

}  // namespace

struct EmbreeScene::Impl {
  Impl(const std::vector<CoarseGroup>& g, const SharedShapes& s) : groups(g), shapes(s), device(newDevice()) {
    rtcSetDeviceMemoryMonitorFunction(device, &countBytes, this);
    scene = newScene();
  }
  ~Impl() {
    chunks.reset();
    if (scene) rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  const std::vector<CoarseGroup>& groups;
  const SharedShapes& shapes;
  bool fades = false;  ///< Some group fades between levels of detail.
  std::atomic<int64_t> bytes{0};
  std::deque<Geometry> geometries;  ///< Indexed by geomID of Embree; Embree keeps their addresses.
  std::deque<Geometry> masters;
  Instances instances;
  std::optional<EmbreeChunks> chunks;
  const RTCDevice device;
  RTCScene scene = nullptr;

  static bool countBytes(void* self, ssize_t bytes, bool) {
    static_cast<Impl*>(self)->bytes += bytes;
    return true;
  }

  RTCScene newScene() const {
    RTCScene out = rtcNewScene(device);
    rtcSetSceneFlags(out, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    return out;
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
    Traversal t{{}, shift, window, ray.tMax, list, &instances, ray.filter, levelOf(ray)};
    rtcInitIntersectContext(&t.embree);
    t.embree.filter = filter;
    return t;
  }

  /// Adds one geometry with the quads of the given groups.
  void attach(std::vector<Geometry::Run> runs, uint32_t mask, bool opaque) {
    const CoarseGroup& like = groups[runs.front().mesh];
    const auto id = static_cast<unsigned>(geometries.size());
    Geometry& out =
        geometries.emplace_back(Geometry{opaque, like.flipsNormal, mask, like.detail, groups.data(), runs.front()});
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
    rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(like.laterP.size() + 1));
    if (runs.size() == 1)
      shareBuffers(geometry, like, runs.front());
    else
      copyBuffers(geometry, std::move(runs), out);
    rtcSetGeometryMask(geometry, mask);
    if (like.trimmed || !like.detail.whole()) filterAbsent(geometry);
    attach(scene, geometry, id, &out);
  }

  static void attach(RTCScene to, RTCGeometry geometry, unsigned id, void* user) {
    rtcSetGeometryUserData(geometry, user);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(to, geometry, id);
    rtcReleaseGeometry(geometry);
  }

  RTCScene sceneOf(const CoarseGroup& mesh) {
    RTCScene out = newScene();
    const Geometry::Run whole{0, 0, static_cast<uint32_t>(mesh.quads.size())};
    Geometry& described = masters.emplace_back(Geometry{true, mesh.flipsNormal, 0, {}, &mesh, whole});
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
    shareBuffers(geometry, mesh, whole);
    if (mesh.trimmed) filterAbsent(geometry);
    attach(out, geometry, 0, &described);
    rtcCommitScene(out);
    return out;
  }

  /// Attaches the groups that are parts of solids, or all others.
  void attachGroups(const RayGroups& all, bool solids) {
    std::map<std::tuple<uint32_t, bool, bool, bool, size_t, float, float, uint32_t>, std::vector<Geometry::Run>> alike;
    for (uint32_t i = 0; i < groups.size(); ++i) {
      const CoarseGroup& g = groups[i];
      fades |= !g.detail.whole();
      if (g.solid != solids) continue;
      const auto plain = static_cast<uint32_t>(g.quads.size() - g.onlyCoarse),
                 coarse = static_cast<uint32_t>(g.onlyCoarse);
      for (const auto& [run, mask] : {std::pair(Geometry::Run{i, 0, plain}, maskAtAllLevels(all.masks[i])),
                                      std::pair(Geometry::Run{i, plain, coarse}, maskAt(all.masks[i], Level::Coarse))})
        if (run.count > 0)
          alike[{mask, all.opaque[i], g.flipsNormal, g.trimmed, g.laterP.size(), g.detail.lo, g.detail.hi,
                 g.quads.size() < kManyQuads ? 0 : i + 1}]
              .push_back(run);
    }
    for (auto& [kind, runs] : alike) attach(std::move(runs), std::get<0>(kind), std::get<1>(kind));
  }

  void attachInstances(const RayGroups& all) {
    std::vector<RTCScene> scenes;
    for (const CoarseGroup& mesh : shapes.masters) scenes.push_back(sceneOf(mesh));
    instances.firstId = static_cast<uint32_t>(geometries.size());
    for (size_t i = 0; i < shapes.instances.size(); ++i) {
      const CoarseInstance& instance = shapes.instances[i];
      RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
      rtcSetGeometryInstancedScene(geometry, scenes[instance.master]);
      rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &instance.cameraFromObject[0][0]);
      instances.mask.push_back(maskAtAllLevels(all.masks[instance.group]));
      rtcSetGeometryMask(geometry, instances.mask.back());
      attach(scene, geometry, instances.firstId + static_cast<uint32_t>(i), nullptr);
      instances.group.push_back(instance.group);
      instances.opaque.push_back(all.opaque[instance.group]);
      instances.mirrors.push_back(glm::determinant(mat3(instance.cameraFromObject)) < 0);
    }
    for (RTCScene s : scenes) rtcReleaseScene(s);  // the instances hold it
    instances.firstChunk = instances.firstId + static_cast<uint32_t>(instances.group.size());
  }

  void commit(Log& log) {
    rtcCommitScene(scene);
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    if (error != RTC_ERROR_NONE)
      log.report(Severity::Missing, "trace-embree", {},
                 "Embree could not build the scene for rays: they may miss objects");
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
  const ThreadLimit one(1);  // as above
  impl_->attachInstances(groups);
  impl_->commit(log);
}

EmbreeScene::~EmbreeScene() = default;

bool EmbreeScene::nearest(const Ray& ray, uint32_t mask, PolygonHit& hit) const {
  Traversal traversal = impl_->traversalOf(ray, ray.filter ? &rejectUnseen : nullptr, 0, 0, nullptr);
  return impl_->trace(ray, 0, std::max(ray.bias, 0.0f), mask, traversal, hit);
}

void EmbreeScene::around(const vec3& P, float reach, uint32_t mask, Level level, Surroundings& out) const {
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
