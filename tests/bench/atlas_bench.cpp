// The passes of the irradiance atlas after the photons, on photons as even as those of a closed room: CPU seconds of
// one thread.
//     bench_atlas [photons]
#include <fmt/format.h>

#include <ctime>
#include <filesystem>

#include "gi/brick_map.h"
#include "gi/photons/irradiance.h"
#include "gi/point_file.h"
#include "reyes/base/parallel.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

double cpuSeconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Prints the CPU seconds that `work` takes, which does `what` `count` times, and the millions a second.
template <class Work>
void measure(const char* what, double count, const Work& work) {
  const double start = cpuSeconds();
  work();
  const double seconds = cpuSeconds() - start;
  fmt::print("{:24} {:7.3f} s {:8.2f} M/s\n", what, seconds, 1e-6 * count / seconds);
}

/// Returns photons on the inside of a cube and on a ball in it.
PointCloud photonsInARoom(uint32_t count) {
  PointCloud cloud;
  cloud.channels = {{"power", 3}};
  cloud.reserve(count);
  for (uint32_t i = 0; i < count; ++i) {
    const vec2 at = sobol2(i, 7);
    const uint32_t face = hashCombine(i, 3) % 7;
    const vec3 power(1.0f / static_cast<float>(count), 0.5f * (1 + at.x) / static_cast<float>(count),
                     0.2f / static_cast<float>(count));
    if (face == 6) {
      const float z = 1 - 2 * at.x, phi = 2 * kPi * at.y, r = std::sqrt(std::max(0.0f, 1 - z * z));
      const vec3 n(r * std::cos(phi), r * std::sin(phi), z);
      cloud.add(vec3(0.5f) + 0.2f * n, n, 0, &power.x);
      continue;
    }
    vec3 p, n(0.0f);
    const int axis = static_cast<int>(face % 3);
    p[axis] = face < 3 ? 0.0f : 1.0f;
    n[axis] = face < 3 ? 1.0f : -1.0f;
    p[(axis + 1) % 3] = at.x;
    p[(axis + 2) % 3] = at.y;
    cloud.add(p, n, 0, &power.x);
  }
  return cloud;
}

void bench(uint32_t count) {
  const ThreadLimit one(1);
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / "tomales_bench_atlas";
  fs::create_directories(folder);
  const std::string points = (folder / "a.ptc").string(), bricks = (folder / "a.bkm").string();
  const PointCloud photons = photonsInARoom(count);
  PointCloud every4, all;
  measure("irradiance, every 4th", count, [&] { every4 = estimateIrradiance(photons, {}); });
  measure("irradiance, every", count, [&] { all = estimateIrradiance(photons, {.every = 1}); });
  writePointFile(every4, points);
  const PointCloud few = PointFile(points).readAll();
  const float mean = static_cast<float>(PointTiles(PointFile(points)).meanOfData());
  measure("bricks of every 4th", static_cast<double>(few.count()),
          [&] { writeBrickMap(few, {.maxError = 0.03f * mean, .coarseness = 2}, bricks); });
  measure("point file", static_cast<double>(all.count()), [&] { writePointFile(all, points); });
  PointCloud read;
  measure("read again", static_cast<double>(all.count()), [&] { read = PointFile(points).readAll(); });
  for (const float error : {0.0f, 0.03f, 0.3f}) {
    BuiltBricks built;
    measure(fmt::format("bricks, maxerror {}", error).c_str(), static_cast<double>(read.count()),
            [&] { built = writeBrickMap(read, {error * mean}, bricks); });
    fmt::print("  {} bricks, {} left out, {} levels, {} bytes\n", built.tree.nodes.size(), built.eliminated,
               built.tree.deepest + 1, fs::file_size(bricks));
  }
  writeBrickMap(read, {0.03f * mean}, bricks);
  BrickCache cache(size_t{1} << 30);
  const BrickMap map(bricks, cache);
  vec3 E, sum(0.0f);
  const auto lookAll = [&](float radius, size_t step) {
    for (size_t i = 0; i < read.count(); i += step) {
      map.lookup(read.position[i], read.normal[i], radius, &E.x);
      sum += E;
    }
  };
  lookAll(0.002f, 1);
  lookAll(0.02f, 1);
  measure("lookups, coherent, fine", static_cast<double>(read.count()), [&] { lookAll(0.002f, 1); });
  measure("lookups, coherent, wide", static_cast<double>(read.count()), [&] { lookAll(0.02f, 1); });
  measure("lookups, incoherent", static_cast<double>(read.count()), [&] {
    for (size_t i = 0, at = 0; i < read.count(); ++i, at = (at + 7919) % read.count()) {
      map.lookup(read.position[at], read.normal[at], 0.01f, &E.x);
      sum += E;
    }
  });
  fs::remove_all(folder);
}

}  // namespace
}  // namespace tomales

int main(int argc, char** argv) { tomales::bench(argc > 1 ? static_cast<uint32_t>(std::atoi(argv[1])) : 1'000'000); }
