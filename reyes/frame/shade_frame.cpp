#include "reyes/base/crash_note.h"
#include "reyes/base/parallel.h"
#include "reyes/frame.h"
#include "reyes/frame/bucket_order.h"
#include "reyes/output.h"

namespace tomales {
namespace {

/// Adds the radiance of area lights to the light that their surfaces reflect, as camera rays see it (docs/gi.md).
void addEmission(const ShadePoints& points, const ShadingSystem& shading, const ShadeContext& context,
                 ShadedPoints& out) {
  std::vector<vec3> emission;
  shading.areaLightRadiance(points, emission, context);
  for (size_t i = 0; i < emission.size(); ++i)
    for (int c = 0; c < 3; ++c) out.Ci[c][i] += emission[i][c];
}

/// Makes the points opaque and black, for which no shader is needed.
void leaveBlack(int count, ShadedPoints& out) {
  out.resize(count);
  for (auto& o : out.Oi) std::fill(o.begin(), o.end(), 1.0f);
}

}  // namespace

void shadeTile(DeepTile& tile, const Scene& scene, const ShadingSystem& shading, const ShadeContext& context) {
  const CrashBucket here(tile.rect.x0, tile.rect.y0, tile.rect.x1, tile.rect.y1);
  const bool wantsColor = outputOf(scene.options).shades;
  tile.shaded.resize(tile.batches.size());
  for (size_t b = 0; b < tile.batches.size(); ++b) {
    const ShadePoints& points = tile.batches[b];
    ShadedPoints& out = tile.shaded[b];
    const bool matte = scene.groups[static_cast<size_t>(points.group())].attributes->matte;
    if ((matte || !wantsColor) && shading.group(points.group()).opaque()) {
      leaveBlack(points.count(), out);
      continue;
    }
    // A holdout only hides, by its opacity. Compositing uses nothing else of it, so no light is needed.
    if (matte) {
      ShadeContext opacityAlone = context;
      opacityAlone.direct = opacityAlone.indirect = false;
      shading.shade(points, opacityAlone, out);
      continue;
    }
    ShadeContext batchContext = context;
    batchContext.variables = true;
    if (b < tile.answers.size()) batchContext.answers = &tile.answers[b];
    shading.shade(points, batchContext, out);
    addEmission(points, shading, context, out);
    shading.atmosphere(points, out, context);
  }
}

bool shadeTiles(std::span<const uint32_t> tiles, const TileAccess& access, const Scene& scene,
                const ShadingSystem& shading, const ShadeContext& context, const FrameControl& control) {
  std::atomic<size_t> done{0};
  std::atomic<bool> skipped{false};
  const auto isStopped = [&] {
    if (!control.stop.requested()) return false;
    skipped = true;
    return true;
  };
  parallelInOrder(tiles.size(), [&](size_t i) {
    if (isStopped()) return;
    DeepTile tile;
    if (access.load(tiles[i], tile)) {
      if (tile.shaded.empty()) shadeTile(tile, scene, shading, context);
      if (isStopped()) return;
      access.take(tiles[i], std::move(tile));
    }
    if (control.progress) control.progress(static_cast<float>(++done) / static_cast<float>(tiles.size()));
  });
  return !skipped;
}

std::vector<uint32_t> tilesOf(const DeepFrame& frame, const Options& options) {
  const PixelRect seen = grownByFilter(frame.crop, options);
  std::vector<uint32_t> out;
  for (const uint32_t i : bucketOrder(options.bucketOrder, frame.columns, frame.rows))
    if (frame.rectOf(i).overlaps(seen)) out.push_back(i);
  return out;
}

}  // namespace tomales
