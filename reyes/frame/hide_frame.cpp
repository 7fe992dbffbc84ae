#include "reyes/base/parallel.h"
#include "reyes/frame.h"
#include "reyes/frame/hide_node.h"
#include "reyes/frame/sampling.h"

namespace tomales {
namespace {

DeepFrame layOut(const Scene& scene, const Camera& camera) {
  const Options& o = scene.options;
  const vec2 reach = filterReach(o);
  const int reachX = static_cast<int>(reach.x), reachY = static_cast<int>(reach.y);
  DeepFrame frame;
  frame.crop = camera.crop();
  // Samples beyond the crop window are computed too, so that crops join into the full frame (RISpec 3.2 section 4.1.1).
  frame.padded = {frame.crop.x0 - reachX, frame.crop.y0 - reachY, frame.crop.x1 + reachX, frame.crop.y1 + reachY};
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

DeepTile hideBucket(size_t bucket, const PixelRect& rect, const NodeList& nodes, const HideContext& context,
                    const SamplePattern& pattern) {
  Hider hider(context.scene, context.camera, pattern, rect);
  NodeQueue queue;
  for (HideNode* node : nodes.in(bucket)) queue.push(node);
  while (HideNode* node = queue.pop())
    if (!hider.hidden(node->raster(), node->zMin())) node->visit(bucket, queue, hider);
  DeepTile tile = hider.resolve();
  for (HideNode* node : nodes.in(bucket)) node->release(bucket);
  return tile;
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

  const BucketGrid buckets(frame);
  HideContext context{scene, camera, shading, buckets, stats, log};
  const NodeList nodes(nodesOfScene(context), buckets.all(), buckets);
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
      tile = hideBucket(i, rect, nodes, context, pattern);
      stats.geometry.micropolygonsVisible += static_cast<int64_t>(tile.facets.size());
      stats.memoryBytes.deepFrame += static_cast<int64_t>(tile.bytes());
      if (control.progress) control.progress(static_cast<float>(++done) / static_cast<float>(frame.tiles.size()));
    }
  });
  frame.complete = !skipped;
  return frame;
}

}  // namespace tomales
