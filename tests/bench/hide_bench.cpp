// One core: a million micropolygons of about one pixel at 4 x 4 samples, in grids of 256 and buckets of 16
// x 16.
#include <benchmark/benchmark.h>

#include "tests/unit/hide/fixture.h"

namespace tomales::test {
namespace {

constexpr int kSize_px = 1024, kBucket = 16, kBuckets = kSize_px / kBucket;

struct Frame {
  World world{rasterOptions(kSize_px)};
  std::vector<std::shared_ptr<const Grid>> grids;

  Frame(int keys, ShadingInterpolation interpolation) {
    world.scene.options.shutterClose = 1;
    Attributes a;
    a.interpolation = interpolation;
    world.add(a);
    world.freeze();
    if (keys > 1) world.scene.objects[0].keyTimes = {0, 1};
    for (int k = 0; k < kBuckets * kBuckets; ++k) {
      const float x = static_cast<float>(k % kBuckets * kBucket), y = static_cast<float>(k / kBuckets * kBucket);
      const Surface tilted = [=](float u, float v, int key) {
        const float across = x + 16 * u, down = y + 16 * v, shift = 4.0f * static_cast<float>(key);
        return at(across + 0.1f * down + 0.37f + shift, down - 0.1f * across + 0.21f, 10 + 0.01f * across);
      };
      grids.push_back(makeGrid(0, static_cast<uint32_t>(k), 16, 16, tilted, keys));
    }
  }
};

double cells(const Frame& f) { return static_cast<double>(f.grids.size()) * 256; }

using Rasters = std::vector<std::shared_ptr<const RasterGrid>>;

Rasters projected(const Frame& f, bool opaque) {
  const Camera camera(f.world.scene.options);
  Rasters out;
  for (const auto& g : f.grids) out.push_back(project(g, f.world.scene, camera, opaque));
  return out;
}

std::vector<Rasters> perBucket(const Rasters& rasters) {
  std::vector<Rasters> out(kBuckets * kBuckets);
  for (const auto& r : rasters)
    for (int y = 0; y < kBuckets; ++y)
      for (int x = 0; x < kBuckets; ++x) {
        const vec2 lo(x * kBucket, y * kBucket), hi = lo + vec2(kBucket);
        if (r->bound.lo.x < hi.x && r->bound.hi.x >= lo.x && r->bound.lo.y < hi.y && r->bound.hi.y >= lo.y)
          out[static_cast<size_t>(y * kBuckets + x)].push_back(r);
      }
  return out;
}

void projectGrids(benchmark::State& state) {
  const Frame frame(1, ShadingInterpolation::Constant);
  for (auto _ : state) benchmark::DoNotOptimize(projected(frame, true));
  state.counters["cells/s"] = benchmark::Counter(cells(frame), benchmark::Counter::kIsIterationInvariantRate);
}

void hide(benchmark::State& state, int keys, bool opaque, bool resolve, ShadingInterpolation interpolation) {
  const Frame frame(keys, interpolation);
  const std::vector<Rasters> buckets = perBucket(projected(frame, opaque));
  const Camera camera(frame.world.scene.options);
  const SamplePattern pattern(4, 4, true, 0);
  for (auto _ : state)
    for (size_t b = 0; b < buckets.size(); ++b) {
      const int x = static_cast<int>(b) % kBuckets * kBucket, y = static_cast<int>(b) / kBuckets * kBucket;
      Hider hider(frame.world.scene, camera, pattern, {x, y, x + kBucket, y + kBucket});
      for (const auto& r : buckets[b]) hider.insert(r);
      if (resolve) benchmark::DoNotOptimize(hider.resolve());
    }
  state.counters["cells/s"] = benchmark::Counter(cells(frame), benchmark::Counter::kIsIterationInvariantRate);
}

constexpr auto kConstant = ShadingInterpolation::Constant, kSmooth = ShadingInterpolation::Smooth;

BENCHMARK(projectGrids)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(hide, still_opaque, 1, true, false, kConstant)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(hide, still_transparent, 1, false, false, kConstant)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(hide, moving_opaque, 2, true, false, kConstant)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(hide, still_opaque_and_resolve, 1, true, true, kConstant)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(hide, still_opaque_smooth_and_resolve, 1, true, true, kSmooth)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(hide, still_transparent_and_resolve, 1, false, true, kConstant)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tomales::test
