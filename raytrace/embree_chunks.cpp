#include "raytrace/embree_chunks.h"

#include <map>
#include <new>

namespace tomales {
namespace {

// Bytes that Embree allocates for each grid polygon and for a scene, as its memory monitor tells.
constexpr size_t kPolygonBytes = 22, kSceneBytes = 10000;

/// An Extent has one box for this many polygons: 24 bytes, while the polygons take 9000.
constexpr int kPartEdge = 16, kPartPolygons = kPartEdge * kPartEdge;

/// Tests a ray against boxes, grown a little for rounding.
class Slabs {
 public:
  explicit Slabs(const RTCRay& r)
      : origin_(r.org_x, r.org_y, r.org_z), direction_(r.dir_x, r.dir_y, r.dir_z), first_(r.tnear), last_(r.tfar) {}

  bool meets(const Bound3& box) const {
    const float margin =
        1e-5f * (glm::length(origin_) + std::max(maxComponent(glm::abs(box.lo)), maxComponent(glm::abs(box.hi))));
    float first = first_, last = last_;
    for (int k = 0; k < 3; ++k) {
      const float lo = box.lo[k] - margin - origin_[k], hi = box.hi[k] + margin - origin_[k];
      if (direction_[k] == 0) {
        if (lo > 0 || hi < 0) return false;
        continue;
      }
      const float a = lo / direction_[k], b = hi / direction_[k];
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
    }
    return first <= last + 1e-6f * std::abs(last) + margin;
  }

 private:
  vec3 origin_, direction_;
  float first_, last_;
};

}  // namespace

EmbreeChunks::Resident::~Resident() {
  if (scene) rtcReleaseScene(scene);
}

EmbreeChunks::EmbreeChunks(const Chunks& chunks, size_t budget)
    : chunks_(chunks), cache_(chunks.all().size(), budget), extents_(chunks.all().size()) {}

EmbreeChunks::~EmbreeChunks() {
  if (device_) rtcReleaseDevice(device_);
}

void EmbreeChunks::attach(RTCDevice device, RTCScene to, unsigned id, uint32_t firstInstance,
                          const std::vector<CoarseGroup>& groups, const std::vector<uint32_t>& masks,
                          const std::vector<bool>& opaque) {
  device_ = device;
  firstInstance_ = firstInstance;
  rtcRetainDevice(device);
  for (uint32_t g = 0; g < groups.size(); ++g)
    described_.push_back({opaque[g], groups[g].flipsNormal, 0, {}, groups.data(), {g, 0, 0}});
  std::map<uint32_t, std::vector<uint32_t>> byMask;
  for (uint32_t c = 0; c < chunks_.all().size(); ++c) {
    const auto& [group, level, bound, tiles] = chunks_.all()[c];
    uint32_t mask = 0;
    for (const TessellationLevel ray : {TessellationLevel::Fine, TessellationLevel::Medium, TessellationLevel::Coarse})
      if (chunks_.levelOf(group, ray) == level) mask |= maskAt(masks[group], ray);
    byMask[mask].push_back(c);
  }
  for (auto& [mask, chunks] : byMask) {
    Members& members = members_.emplace_back(Members{this, mask, std::move(chunks)});
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(members.chunks.size()));
    rtcSetGeometryBoundsFunction(geometry, &EmbreeChunks::boundsOf, nullptr);
    rtcSetGeometryIntersectFunction(geometry, &EmbreeChunks::intersect);
    rtcSetGeometryOccludedFunction(geometry, &EmbreeChunks::occluded);
    rtcSetGeometryMask(geometry, mask);
    rtcSetGeometryUserData(geometry, &members);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(to, geometry, id++);
    rtcReleaseGeometry(geometry);
  }
}

void EmbreeChunks::boundsOf(const RTCBoundsFunctionArguments* args) {
  const auto& members = *static_cast<const Members*>(args->geometryUserPtr);
  const Bound3& b = members.owner->chunks_.all()[members.chunks[args->primID]].bound;
  *args->bounds_o = {b.lo.x, b.lo.y, b.lo.z, 0, b.hi.x, b.hi.y, b.hi.z, 0};
}

// Hits of a chunk carry the ID of an instance, which Embree takes over from the context.
void EmbreeChunks::intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto& members = *static_cast<const Members*>(args->geometryUserPtr);
  const uint32_t chunk = members.chunks[args->primID];
  auto* ray = reinterpret_cast<RTCRayHit*>(args->rayhit);
  const auto held = members.owner->met(chunk, ray->ray);
  if (!held) return;
  args->context->instID[0] = members.owner->firstInstance_ + chunk;
  rtcIntersect1(held->scene, args->context, ray);
  args->context->instID[0] = RTC_INVALID_GEOMETRY_ID;
}

void EmbreeChunks::occluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto& members = *static_cast<const Members*>(args->geometryUserPtr);
  const uint32_t chunk = members.chunks[args->primID];
  auto* ray = reinterpret_cast<RTCRay*>(args->ray);
  const auto held = members.owner->met(chunk, *ray);
  if (!held) return;
  args->context->instID[0] = members.owner->firstInstance_ + chunk;
  rtcOccluded1(held->scene, args->context, ray);
  args->context->instID[0] = RTC_INVALID_GEOMETRY_ID;
}

std::shared_ptr<const EmbreeChunks::Resident> EmbreeChunks::met(uint32_t chunk, const RTCRay& r) const {
  const Extent& extent = extents_[chunk];
  if (extent.known.load(std::memory_order_acquire)) {
    const Slabs slabs(r);
    const auto meets = [&](const Bound3& part) { return slabs.meets(part); };
    if (!meets(extent.whole) || std::none_of(extent.parts.begin(), extent.parts.end(), meets)) return nullptr;
  }
  try {
    return resident(chunk);
  } catch (const std::bad_alloc&) {
    failed_ = true;
    return nullptr;
  }
}

std::shared_ptr<const EmbreeChunks::Resident> EmbreeChunks::resident(uint32_t chunk) const {
  return cache_.get(chunk, [&] {
    auto made = build(chunk);
    if (!extents_[chunk].known.load(std::memory_order_relaxed)) learnExtent(chunk, made->mesh);
    return made;
  });
}

/// Notes the bounds of a chunk's vertices. The cache makes a slot on one thread at a time.
void EmbreeChunks::learnExtent(uint32_t chunk, const ChunkMesh& mesh) const {
  Extent& out = extents_[chunk];
  const std::vector<PatchTile>& tiles = chunks_.all()[chunk].tiles;
  int held = kPartPolygons;
  for (size_t t = 0; t < tiles.size(); ++t) {
    const auto [nu, nv] = tiles[t].rate;
    for (int v = 0; v < nv; v += kPartEdge)
      for (int u = 0; u < nu; u += kPartEdge) {
        const int u1 = std::min(u + kPartEdge, nu), v1 = std::min(v + kPartEdge, nv), more = (u1 - u) * (v1 - v);
        if (held + more > kPartPolygons) {
          out.parts.emplace_back();
          held = 0;
        }
        held += more;
        for (int j = v; j <= v1; ++j)
          for (int i = u; i <= u1; ++i) {
            const vec3& p = mesh.P[mesh.firstVertex[t] + static_cast<size_t>(j) * static_cast<size_t>(nu + 1) +
                                   static_cast<size_t>(i)];
            if (isFinite(p)) out.parts.back().extend(p);
          }
      }
  }
  out.parts.shrink_to_fit();
  for (const Bound3& part : out.parts) out.whole.extend(part);
  out.known.store(true, std::memory_order_release);
}

std::shared_ptr<const EmbreeChunks::Resident> EmbreeChunks::build(uint32_t chunk) const {
  auto out = std::make_shared<Resident>();
  out->mesh = chunks_.dice(chunk);
  out->scene = rtcNewScene(device_);
  rtcSetSceneFlags(out->scene,
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_GRID);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, out->mesh.P.data(), 0,
                             sizeof(vec3), out->mesh.P.size());
  const std::vector<PatchTile>& tiles = chunks_.all()[chunk].tiles;
  auto* grids = static_cast<RTCGrid*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), tiles.size()));
  for (size_t t = 0; grids && t < tiles.size(); ++t) {
    const auto [nu, nv] = tiles[t].rate;
    grids[t] = {out->mesh.firstVertex[t], static_cast<unsigned>(nu + 1), static_cast<uint16_t>(nu + 1),
                static_cast<uint16_t>(nv + 1)};
    out->sceneBytes += kPolygonBytes * static_cast<size_t>(nu) * static_cast<size_t>(nv);
  }
  rtcSetGeometryUserData(geometry, const_cast<Geometry*>(&described_[chunks_.all()[chunk].group]));
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(out->scene, geometry, 0);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(out->scene);
  if (rtcGetDeviceError(device_) == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  out->sceneBytes += kSceneBytes;
  return out;
}

vec3 EmbreeChunks::normal(const PolygonHit& hit) const {
  const auto chunk = static_cast<uint32_t>(hit.chunk);
  return chunks_.normal(resident(chunk)->mesh, chunk, hit.quad, hit.u, hit.v);
}

}  // namespace tomales
