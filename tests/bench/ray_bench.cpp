// Incoherent gather rays against a bare Embree loop over the same rays and polygons, in turn, in one run.
//     bench_rays [repetitions [rays from each origin]]
// A closed room with 40 spheres; rays leave floor, walls and spheres with the cosine around the normal, many from each
// origin as those of a record of the irradiance cache do.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <functional>

#include "gi/gather.h"
#include "raytrace/tessellate.h"
#include "reyes/base/rng.h"
#include "tests/unit/raytrace/world.h"

namespace tomales::test {
namespace {

constexpr uint32_t kRays = 400000, kRaysInTurn = 4000;

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
  explicit BareScene(const std::vector<CoarseGroup>& groups)
      : device(rtcNewDevice(nullptr)), scene(rtcNewScene(device)) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    for (const CoarseGroup& g : groups) {
      if (g.quads.empty()) continue;
      RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
      auto* P = static_cast<vec3*>(
          rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), g.P.size()));
      auto* quads = static_cast<Quad*>(
          rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, sizeof(Quad), g.quads.size()));
      std::copy(g.P.begin(), g.P.end(), P);
      std::copy(g.quads.begin(), g.quads.end(), quads);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene, geometry);
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene);
  }
  ~BareScene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  bool hits(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit r{};
    r.ray.org_x = ray.origin.x;
    r.ray.org_y = ray.origin.y;
    r.ray.org_z = ray.origin.z;
    r.ray.tnear = ray.bias;
    r.ray.dir_x = ray.direction.x;
    r.ray.dir_y = ray.direction.y;
    r.ray.dir_z = ray.direction.z;
    r.ray.tfar = kInfinity;
    r.ray.mask = ~0U;
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &r);
    return r.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }

  RTCDevice device;
  RTCScene scene;
};

/// Rays that leave one origin, with their offsets along the normal and along each.
struct Origin {
  float offset = 0;
  std::vector<Ray> rays;
};

std::vector<Origin> originsOf(const World& world, uint32_t raysOfOrigin) {
  std::vector<Origin> out;
  for (uint32_t i = 0; i < kRays / raysOfOrigin; ++i) {
    // From where a first ray meets the room.
    const vec2 a = sobol2(i, 5);
    const float z = 1 - 2 * a.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
    const Hit start = world.rays->closest({{0, 0, 5.5f}, {r * std::cos(2 * kPi * a.y), r * std::sin(2 * kPi * a.y), z}},
                                          kMaskDiffuse);
    if (start.object < 0) continue;
    const vec3 N = start.geometricNormal;
    vec3 x, y;
    orthonormalBasis(N, x, y);
    Ray ray{start.atOpen, N};
    world.rays->prepareOrigin(world.rays->groupOf(start), ray.origin, 0, ray);
    Origin origin{ray.offset, {}};
    for (uint32_t k = 0; k < raysOfOrigin; ++k) {
      const vec3 d = cosineHemisphere(sobol2(k, hashCombine(6, i)));
      ray.direction = d.x * x + d.y * y + d.z * N;
      ray.offset = slantedOffset(origin.offset, d.z);
      origin.rays.push_back(ray);
    }
    out.push_back(origin);
  }
  return out;
}

int bench(int repetitions, uint32_t raysOfOrigin) {
  World world;
  fill(world);
  world.build();
  const BareScene bare(tessellate(world.scene, *world.camera, *world.shading, world.log));
  const std::vector<Origin> origins = originsOf(world, raysOfOrigin);
  const size_t originsInTurn = std::max(kRaysInTurn / raysOfOrigin, 1u);
  Surroundings surroundings;
  const auto traced = [&](Ray ray, bool list, bool around) {
    if (!list) ray.offset = 0;
    if (around) ray.surroundings = &surroundings;
    return world.rays->closest(ray, kMaskDiffuse).object >= 0;
  };
  struct Way {
    const char* name;
    std::function<size_t(const Origin&)> hits;
    double seconds = 0;
    size_t met = 0;
  };
  const auto count = [](const Origin& origin, const auto& hits) {
    return static_cast<size_t>(std::count_if(origin.rays.begin(), origin.rays.end(), hits));
  };
  Way ways[] = {
      {"bare Embree loop", [&](const Origin& o) { return count(o, [&](const Ray& ray) { return bare.hits(ray); }); }},
      {"closest() by bias",
       [&](const Origin& o) { return count(o, [&](const Ray& ray) { return traced(ray, false, false); }); }},
      {"closest() by hit list",
       [&](const Origin& o) { return count(o, [&](const Ray& ray) { return traced(ray, true, false); }); }},
      {"closest() by hit list, surroundings known",
       [&](const Origin& o) {
         world.rays->lookAround(o.rays.front(), slantedOffset(o.offset, 0), kMaskDiffuse, surroundings);
         return count(o, [&](const Ray& ray) { return traced(ray, true, true); });
       }},
  };
  for (int k = 0; k < repetitions; ++k)
    for (size_t i = 0; i < origins.size(); i += originsInTurn)
      for (Way& way : ways) {
        const double start = cpuSeconds();
        for (size_t j = i; j < std::min(i + originsInTurn, origins.size()); ++j) way.met += way.hits(origins[j]);
        way.seconds += cpuSeconds() - start;
      }
  const auto rays = static_cast<double>(origins.size()) * raysOfOrigin * repetitions;
  for (const Way& way : ways)
    fmt::print("{}: {:.2f} million rays a CPU second, {:.1f} % of the bare loop; {:.0f} ns a ray; {:.2f} % hit\n",
               way.name, rays / way.seconds / 1e6, 100 * ways[0].seconds / way.seconds, 1e9 * way.seconds / rays,
               100 * static_cast<double>(way.met) / rays);
  return 0;
}

}  // namespace
}  // namespace tomales::test

int main(int argc, char** argv) {
  const auto number = [&](int i, int otherwise) { return argc > i ? std::max(1, std::atoi(argv[i])) : otherwise; };
  return tomales::test::bench(number(1, 5), static_cast<uint32_t>(number(2, 200)));
}
