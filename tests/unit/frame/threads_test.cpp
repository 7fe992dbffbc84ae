// Tests which buckets the threads hide at the same time.
#include <gtest/gtest.h>

#include <condition_variable>
#include <cstdlib>
#include <thread>

#include "reyes/base/parallel.h"
#include "reyes/frame.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

/// An empty scene of 16 x 4 buckets whose picture nobody wants.
struct EmptyFrame {
  EmptyFrame() {
    Options& o = scene.options;
    o.xResolution = 16 * o.bucketWidth;
    o.yResolution = 4 * o.bucketHeight;
    o.filter = "box";
    o.xFilterWidth = o.yFilterWidth = 1;
    o.displays = {{}};
    o.displays[0].type = "null";
  }
  Log log{Log::Verbosity::Quiet};
  Stats stats;
  Scene scene;
  ShaderRegistry registry{log};
  ShadingSystem shading{scene, registry, nullptr, log, stats};
};

TEST(Threads, BeginToHideFarFromEachOther) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor";
  const ThreadLimit two(2);
  EmptyFrame f;
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<int> begun;
  const TileSink sink{[&](size_t tile) {
                        std::unique_lock lock(mutex);
                        begun.push_back(static_cast<int>(tile));
                        changed.notify_all();
                        changed.wait_for(lock, std::chrono::seconds(5), [&] { return begun.size() > 1; });
                        return true;
                      },
                      {},
                      {}};
  EXPECT_TRUE(hideTiles(layOutFrame(f.scene), f.scene, f.shading, {}, f.stats, f.log, sink));
  ASSERT_EQ(begun.size(), 64u);
  EXPECT_GE(std::abs(begun[0] - begun[1]), 16) << "a row of buckets";
}

TEST(Threads, FindTheBucketsOfABandColumnByColumn) {
  EmptyFrame f;
  DeepFrame frame = layOutFrame(f.scene);
  std::vector<uint32_t> asked;
  const TileFill fill = [&](std::span<const uint32_t> tiles, const TilePlace&) {
    asked.insert(asked.end(), tiles.begin(), tiles.end());
  };
  writeFrame(frame, fill, {}, f.scene, f.shading, {}, f.stats, f.log);
  ASSERT_EQ(asked.size(), 64u);
  EXPECT_EQ((std::vector<uint32_t>(asked.begin(), asked.begin() + 4)), (std::vector<uint32_t>{0, 16, 1, 17}));
}

}  // namespace
}  // namespace tomales
