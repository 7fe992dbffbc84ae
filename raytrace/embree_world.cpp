#include "raytrace/embree_world.h"

#include <map>
#include <new>
#include <stdexcept>
#include <string>
#include <tuple>

#include "raytrace/embree_buffers.h"

namespace tomales {
namespace {

/// A geometry of its own costs less than copies of this many quads (Geometry in raytrace/embree_filters.h).
constexpr size_t kManyQuads = 4096;

/// Embree returns no device if memory does not suffice.
RTCDevice newDevice() {
  if (const RTCDevice device = rtcNewDevice(nullptr)) return device;
  const RTCError error = rtcGetDeviceError(nullptr);
  if (error == RTC_ERROR_UNSUPPORTED_CPU)
    throw std::runtime_error("rays cannot be traced: Embree does not know this processor");
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw std::runtime_error("rays cannot be traced: Embree does not start (error " + std::to_string(error) +
                           "); is there too little memory?");
}

void attachTo(RTCScene to, RTCGeometry geometry, unsigned id, void* user) {
  rtcSetGeometryUserData(geometry, user);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(to, geometry, id);
  rtcReleaseGeometry(geometry);
}

}  // namespace

EmbreeWorld::EmbreeWorld(const std::vector<CoarseGroup>& g, const SharedShapes& s)
    : groups(g), shapes(s), device(newDevice()) {
  rtcSetDeviceMemoryMonitorFunction(device, &countBytes, this);
  scene = newScene();
}

EmbreeWorld::~EmbreeWorld() {
  chunks.reset();
  if (scene) rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}

bool EmbreeWorld::countBytes(void* self, ssize_t bytes, bool) {
  static_cast<EmbreeWorld*>(self)->bytes += bytes;
  return true;
}

RTCScene EmbreeWorld::newScene() const {
  RTCScene out = rtcNewScene(device);
  rtcSetSceneFlags(out, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  return out;
}

void EmbreeWorld::attach(std::vector<Geometry::Run> runs, uint32_t mask, bool opaque) {
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
  attachTo(scene, geometry, id, &out);
}

RTCScene EmbreeWorld::sceneOf(const CoarseGroup& mesh) {
  RTCScene out = newScene();
  const Geometry::Run whole{0, 0, static_cast<uint32_t>(mesh.quads.size())};
  Geometry& described = masters.emplace_back(Geometry{true, mesh.flipsNormal, 0, {}, &mesh, whole});
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
  shareBuffers(geometry, mesh, whole);
  if (mesh.trimmed) filterAbsent(geometry);
  attachTo(out, geometry, 0, &described);
  rtcCommitScene(out);
  return out;
}

void EmbreeWorld::attachGroups(const RayGroups& all, bool solids) {
  std::map<std::tuple<uint32_t, bool, bool, bool, size_t, float, float, uint32_t>, std::vector<Geometry::Run>> alike;
  for (uint32_t i = 0; i < groups.size(); ++i) {
    const CoarseGroup& g = groups[i];
    fades |= !g.detail.whole();
    if (g.solid != solids) continue;
    const auto plain = static_cast<uint32_t>(g.quads.size() - g.onlyCoarse),
               coarse = static_cast<uint32_t>(g.onlyCoarse);
    for (const auto& [run, mask] :
         {std::pair(Geometry::Run{i, 0, plain}, maskAtAllLevels(all.masks[i])),
          std::pair(Geometry::Run{i, plain, coarse}, maskAt(all.masks[i], TessellationLevel::Coarse))})
      if (run.count > 0)
        alike[{mask, all.opaque[i], g.flipsNormal, g.trimmed, g.laterP.size(), g.detail.lo, g.detail.hi,
               g.quads.size() < kManyQuads ? 0 : i + 1}]
            .push_back(run);
  }
  for (auto& [kind, runs] : alike) attach(std::move(runs), std::get<0>(kind), std::get<1>(kind));
}

void EmbreeWorld::attachInstances(const RayGroups& all) {
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
    attachTo(scene, geometry, instances.firstId + static_cast<uint32_t>(i), nullptr);
    instances.group.push_back(instance.group);
    instances.opaque.push_back(all.opaque[instance.group]);
    instances.mirrors.push_back(glm::determinant(mat3(instance.cameraFromObject)) < 0);
  }
  for (RTCScene s : scenes) rtcReleaseScene(s);  // the instances hold it
  instances.firstChunk = instances.firstId + static_cast<uint32_t>(instances.group.size());
}

void EmbreeWorld::commit(Log& log) {
  rtcCommitScene(scene);
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE)
    log.report(Severity::Missing, "trace-embree", {},
               "Embree could not build the scene for rays: they may miss objects");
}

}  // namespace tomales
