#include "reyes/base/parallel.h"
#include "reyes/frame.h"
#include "reyes/frame/grid_store.h"
#include "reyes/frame/sampling.h"

namespace tomales {
namespace {

DeepFrame layOut(const Scene& scene, const Camera& camera) {
  const Options& o = scene.options;
  const PixelFilter filter(o.filter, o.xFilterWidth, o.yFilterWidth);
  DeepFrame frame;
  frame.crop = camera.crop();
  // Samples beyond the crop window are computed too, so that crops join into the full frame (RISpec 3.2 section 4.1.1).
  frame.padded = {frame.crop.x0 - filter.reachX(), frame.crop.y0 - filter.reachY(), frame.crop.x1 + filter.reachX(),
                  frame.crop.y1 + filter.reachY()};
  frame.bucketWidth = std::max(1, o.bucketWidth);
  frame.bucketHeight = std::max(1, o.bucketHeight);
  frame.columns = (frame.padded.width() + frame.bucketWidth - 1) / frame.bucketWidth;
  frame.rows = (frame.padded.height() + frame.bucketHeight - 1) / frame.bucketHeight;
  frame.tiles.resize(static_cast<size_t>(frame.columns) * static_cast<size_t>(frame.rows));
  for (int row = 0; row < frame.rows; ++row)
    for (int column = 0; column < frame.columns; ++column) {
      PixelRect& r = frame.tiles[static_cast<size_t>(row * frame.columns + column)].rect;
      r.x0 = frame.padded.x0 + column * frame.bucketWidth;
      r.y0 = frame.padded.y0 + row * frame.bucketHeight;
      r.x1 = std::min(r.x0 + frame.bucketWidth, frame.padded.x1);
      r.y1 = std::min(r.y0 + frame.bucketHeight, frame.padded.y1);
    }
  return frame;
}

/// For every bucket, the pieces whose raster bound touches it, nearest first.
std::vector<std::vector<uint32_t>> sortIntoBuckets(const DeepFrame& frame, GridStore& store) {
  std::vector<std::vector<uint32_t>> buckets(frame.tiles.size());
  const auto index = [](float raster, int origin, int size, int count) {
    const float i = std::floor((raster - static_cast<float>(origin)) / static_cast<float>(size));
    return static_cast<int>(std::clamp(i, 0.0f, static_cast<float>(count - 1)));
  };
  for (uint32_t i = 0; i < store.size(); ++i) {
    const Bound2& b = store.piece(i).raster;
    if (b.hi.x < static_cast<float>(frame.padded.x0) || b.hi.y < static_cast<float>(frame.padded.y0) ||
        b.lo.x > static_cast<float>(frame.padded.x1) || b.lo.y > static_cast<float>(frame.padded.y1))
      continue;
    const int c0 = index(b.lo.x, frame.padded.x0, frame.bucketWidth, frame.columns);
    const int c1 = index(b.hi.x, frame.padded.x0, frame.bucketWidth, frame.columns);
    const int r0 = index(b.lo.y, frame.padded.y0, frame.bucketHeight, frame.rows);
    const int r1 = index(b.hi.y, frame.padded.y0, frame.bucketHeight, frame.rows);
    for (int r = r0; r <= r1; ++r)
      for (int c = c0; c <= c1; ++c) {
        buckets[static_cast<size_t>(r * frame.columns + c)].push_back(i);
        store.addUser(i);
      }
  }
  for (auto& bucket : buckets)
    std::stable_sort(bucket.begin(), bucket.end(),
                     [&](uint32_t a, uint32_t b) { return store.piece(a).zMin < store.piece(b).zMin; });
  return buckets;
}

DeepTile hideBucket(const PixelRect& rect, const std::vector<uint32_t>& pieces, GridStore& store, const Scene& scene,
                    const Camera& camera, const SamplePattern& pattern) {
  Hider hider(scene, camera, pattern, rect);
  for (const uint32_t i : pieces) {
    const SubPatch& piece = store.piece(i);
    if (!hider.hidden(piece.raster, piece.zMin))
      if (const auto grid = store.acquire(i)) hider.insert(grid);
    store.release(i);
  }
  return hider.resolve();
}

}  // namespace

DeepFrame hideFrame(const Scene& scene, const ShadingSystem& shading, const FrameControl& control, Stats& stats, Log& log) {
  const Camera camera(scene.options);
  if (scene.options.fStop < kInfinity && !camera.perspective())
    log.report(Severity::Warning, "defocus-orthographic", scene.where,
               "DepthOfField needs a perspective projection: all is in focus");
  DeepFrame frame = layOut(scene, camera);
  const SamplePattern pattern = samplePattern(scene.options, control.seed);
  frame.samplesPerPixel = pattern.count();

  GridStore store(splitScene(scene, camera, frame.padded, stats, log), scene, camera, shading, stats, log);
  const auto buckets = sortIntoBuckets(frame, store);
  std::atomic<size_t> done{0};
  std::atomic<bool> skipped{false};
  parallelFor(frame.tiles.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      DeepTile& tile = frame.tiles[i];
      const PixelRect rect = tile.rect;
      if (control.cancelled && *control.cancelled) {
        skipped = true;
        tile.pixels.resize(static_cast<size_t>(rect.width() * rect.height()));
        continue;
      }
      tile = hideBucket(rect, buckets[i], store, scene, camera, pattern);
      stats.geometry.micropolygonsVisible += static_cast<int64_t>(tile.facets.size());
      stats.memoryBytes.deepFrame += static_cast<int64_t>(tile.bytes());
      if (control.progress) control.progress(static_cast<float>(++done) / static_cast<float>(frame.tiles.size()));
    }
  });
  frame.complete = !skipped;
  return frame;
}

}  // namespace tomales
