#include "reyes/base/crash_note.h"
#include "reyes/base/parallel.h"
#include "reyes/frame.h"
#include "reyes/frame/bucket_order.h"
#include "reyes/frame/hide_node.h"
#include "reyes/frame/hide_warnings.h"
#include "reyes/frame/sampling.h"

namespace tomales {
namespace {

/// Hides one bucket. Returns nothing if it was stopped.
std::optional<DeepTile> hideBucket(size_t bucket, const PixelRect& rect, const NodeList& nodes,
                                   const HideContext& context, const SamplePattern& pattern, HideWarnings& warnings) {
  Hider hider(context.scene, context.camera, pattern, rect);
  NodeQueue queue;
  for (HideNode* node : nodes.in(bucket)) queue.push(node);
  while (const auto node = context.stop.requested() ? nullptr : queue.pop())
    if (!hider.hidden(node->raster(), node->zMin())) node->visit(bucket, queue, hider);
  if (context.stop.requested()) return {};
  HideDiagnostics diagnostics;
  DeepTile tile = hider.resolve(&diagnostics);
  warnings.add(diagnostics, context.scene);
  return tile;
}

// A bucket holds all its samples, and in dense scenes about a grid for each sample. Larger buckets than these limits
// are halved, which does not change the picture.
constexpr int64_t kMostSamplesOfBucket = 1 << 22;
constexpr double kMostPatchesOfBucket = 1 << 19;

double patchesPerPixel(const Scene& scene) {
  double patches = 0;
  for (const Object& o : scene.objects)
    if (!o.shapes.empty()) patches += o.shape().patchCount();  // objects of a shot from a file have none
  return patches / (static_cast<double>(scene.options.xResolution) * scene.options.yResolution);
}

void limitBuckets(DeepFrame& frame, double patchesPerPixel) {
  int &width = frame.bucketWidth, &height = frame.bucketHeight;
  const auto isTooLarge = [&] {
    const int64_t pixels = int64_t{width} * height;
    return pixels > 1 && (pixels * frame.samplesPerPixel > kMostSamplesOfBucket ||
                          static_cast<double>(pixels) * patchesPerPixel > kMostPatchesOfBucket);
  };
  while (isTooLarge()) {
    int& side = width > height ? width : height;
    side = (side + 1) / 2;
  }
}

}  // namespace

DeepFrame layOutFrame(const Scene& scene) {
  const Options& o = scene.options;
  DeepFrame frame;
  frame.crop = Camera(o).crop();
  // Samples beyond the crop window are computed too, so that crops join into the full frame (RISpec 3.2 section 4.1.1).
  frame.padded = grownByFilter(frame.crop, o);
  frame.bucketWidth = o.bucketWidth;
  frame.bucketHeight = o.bucketHeight;
  frame.samplesPerPixel = samplePattern(o, 0).count();
  limitBuckets(frame, patchesPerPixel(scene));
  frame.columns = (frame.padded.width() + frame.bucketWidth - 1) / frame.bucketWidth;
  frame.rows = (frame.padded.height() + frame.bucketHeight - 1) / frame.bucketHeight;
  return frame;
}

struct FrameHider::Impl {
  Impl(const DeepFrame& frame, Scene& scene, ShadingSystem& shading, const FrameControl& c, Stats& stats, Log& log)
      : layout(frame),
        control(c),
        camera(scene.options),
        pattern(samplePattern(scene.options, c.seed)),
        buckets(frame),
        context{scene, camera, shading, buckets, stats, log, c.stop},
        nodes(nodesOfScene(context), buckets.all(), buckets) {
    markSteps(scene, shading, 0);
  }

  /// Returns false if stopped.
  bool hide(size_t index, const TileSink& sink) {
    if (!sink.has || !sink.has(index)) {
      std::optional<DeepTile> tile;
      if (sink.find && !context.stop.requested()) tile = sink.find(index);
      if (!tile) {
        const PixelRect rect = layout.rectOf(index);
        const CrashBucket here(rect.x0, rect.y0, rect.x1, rect.y1);
        tile = hideBucket(index, rect, nodes, context, pattern, warnings);
      }
      if (!tile) return false;
      context.stats.geometry.micropolygonsVisible += static_cast<int64_t>(tile->facets.size());
      context.stats.memoryBytes.deepFrame += static_cast<int64_t>(tile->bytes());
      sink.take(index, std::move(*tile));
    }
    for (HideNode* node : nodes.in(index)) node->release(index);
    if (control.progress) control.progress(static_cast<float>(++done) / static_cast<float>(layout.tileCount()));
    return true;
  }

  const DeepFrame& layout;
  const FrameControl control;
  const Camera camera;
  const SamplePattern pattern;
  const BucketGrid buckets;
  HideContext context;
  const NodeList nodes;
  HideWarnings warnings;
  std::atomic<size_t> done{0};
};

FrameHider::FrameHider(const DeepFrame& layout, Scene& scene, ShadingSystem& shading, const FrameControl& control,
                       Stats& stats, Log& log)
    : impl_(new Impl(layout, scene, shading, control, stats, log)) {
  if (scene.options.fStop < kInfinity && !impl_->camera.perspective())
    log.report(Severity::Warning, "defocus-orthographic", scene.where,
               "DepthOfField needs a perspective projection: all is in focus");
}
// Warnings are about the frame as a whole, which may be hidden in parts.
FrameHider::~FrameHider() { impl_->warnings.report(impl_->context.log); }

bool FrameHider::hide(std::span<const uint32_t> tiles, const TileSink& sink) {
  std::atomic<bool> skipped{false};
  parallelFor(tiles.size(), 1, [&](size_t i, size_t) {
    if (!impl_->hide(tiles[i], sink)) skipped = true;
  });
  return !skipped;
}

bool hideTiles(const DeepFrame& layout, Scene& scene, ShadingSystem& shading, const FrameControl& control, Stats& stats,
               Log& log, const TileSink& sink) {
  // The frame is hidden in parts, because all geometry between finished and unfinished buckets stays in memory.
  constexpr size_t kTilesOfThread = 64;
  const std::vector<uint32_t> order = bucketOrder(scene.options.bucketOrder, layout.columns, layout.rows);
  const size_t part = kTilesOfThread * static_cast<size_t>(threadCount());
  FrameHider hider(layout, scene, shading, control, stats, log);
  bool complete = true;
  for (size_t first = 0; first < order.size(); first += part)
    complete = hider.hide(std::span(order).subspan(first, std::min(part, order.size() - first)), sink) && complete;
  return complete;
}

DeepFrame hideFrame(Scene& scene, ShadingSystem& shading, const FrameControl& control, Stats& stats, Log& log) {
  const DeepFrame layout = layOutFrame(scene);
  DeepFrame frame = layout;
  frame.holdAll();
  const TileSink sink{{}, [&](size_t i, DeepTile&& tile) { frame.tiles[i] = std::move(tile); }, {}};
  frame.complete = hideTiles(layout, scene, shading, control, stats, log, sink);
  return frame;
}

}  // namespace tomales
