// Incoherent gather rays against a bare Embree loop over the same rays and polygons, in turn, in one run.
//     bench_rays [repetitions]
// A closed room with 40 spheres; rays leave floor, walls and spheres with the cosine around the normal.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <chrono>
#include <ctime>

#include "gi/gather.h"
#include "raytrace/tessellate.h"
#include "reyes/base/rng.h"
#include "tests/unit/raytrace/world.h"

namespace tomales::test {
namespace {

double cpuSeconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void fill(World& world) {
  world.addRoom({-3, -3, 2}, {3, 3, 9});
  for (uint32_t i = 0; i < 40; ++i) {
    const vec2 a = sobol2(i, 1), b = sobol2(i, 2);
    world.add(sphere(0.2f + 0.4f * b.y), translation({5 * a.x - 2.5f, 5 * a.y - 2.5f, 3 + 5 * b.x}));
  }
}

struct BareScene {
  explicit BareScene(const std::vector<CoarseGroup>& groups) : device(rtcNewDevice(nullptr)), scene(rtcNewScene(device)) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    for (const CoarseGroup& g : groups) {
      if (g.quads.empty()) continue;
      RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
      auto* P = static_cast<vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), g.P.size()));
      auto* quads = static_cast<Quad*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, sizeof(Quad), g.quads.size()));
      std::copy(g.P.begin(), g.P.end(), P);
      std::copy(g.quads.begin(), g.quads.end(), quads);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene, geometry);
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene);
  }
  ~BareScene() { rtcReleaseScene(scene), rtcReleaseDevice(device); }
  RTCDevice device;
  RTCScene scene;
};

int bench(int repetitions) {
  World world;
  fill(world);
  world.build();
  const BareScene bare(tessellate(world.scene, *world.camera, *world.shading, world.log));
  std::vector<Ray> withList, withBias;
  for (uint32_t i = 0; i < 400000; ++i) {
    // From where a first ray meets the room.
    const vec2 a = sobol2(i, 5), b = sobol2(i, 6);
    const float z = 1 - 2 * a.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
    const Hit start = world.rays->closest({{0, 0, 5.5f}, {r * std::cos(2 * kPi * a.y), r * std::sin(2 * kPi * a.y), z}}, kMaskDiffuse);
    if (start.object < 0) continue;
    const vec3 N = start.geometricNormal, d = cosineHemisphere(b);
    vec3 x, y;
    orthonormalBasis(N, x, y);
    Ray ray{start.atOpen, d.x * x + d.y * y + d.z * N};
    world.rays->prepareOrigin(world.rays->groupOf(start), ray.origin, 0, ray);
    ray.offset = slantedOffset(ray.offset, d.z);
    withList.push_back(ray);
    ray.offset = 0;
    withBias.push_back(ray);
  }
  double seconds[3] = {0, 0, 0};
  size_t hits[3] = {0, 0, 0};
  for (int k = 0; k < repetitions; ++k) {
    double start = cpuSeconds();
    for (const Ray& ray : withBias) {
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      RTCRayHit r{};
      r.ray.org_x = ray.origin.x, r.ray.org_y = ray.origin.y, r.ray.org_z = ray.origin.z, r.ray.tnear = ray.bias;
      r.ray.dir_x = ray.direction.x, r.ray.dir_y = ray.direction.y, r.ray.dir_z = ray.direction.z;
      r.ray.tfar = kInfinity, r.ray.mask = ~0U, r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(bare.scene, &context, &r);
      hits[0] += r.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
    seconds[0] += cpuSeconds() - start, start = cpuSeconds();
    for (const Ray& ray : withBias) hits[1] += world.rays->closest(ray, kMaskDiffuse).object >= 0;
    seconds[1] += cpuSeconds() - start, start = cpuSeconds();
    for (const Ray& ray : withList) hits[2] += world.rays->closest(ray, kMaskDiffuse).object >= 0;
    seconds[2] += cpuSeconds() - start;
  }
  const char* names[3] = {"bare Embree loop", "closest() by bias", "closest() by hit list"};
  const auto rays = static_cast<double>(withList.size()) * repetitions;
  for (int m = 0; m < 3; ++m)
    fmt::print("{}: {:.2f} million rays a CPU second, {:.0f} % of the bare loop; {:.2f} % hit\n", names[m], rays / seconds[m] / 1e6,
               100 * seconds[0] / seconds[m], 100 * static_cast<double>(hits[m]) / rays);
  return 0;
}

}  // namespace
}  // namespace tomales::test

int main(int argc, char** argv) { return tomales::test::bench(argc > 1 ? std::max(1, std::atoi(argv[1])) : 5); }
