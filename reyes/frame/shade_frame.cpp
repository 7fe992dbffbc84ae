#include "reyes/base/parallel.h"
#include "reyes/frame.h"
#include "reyes/frame/sampling.h"
#include "reyes/output.h"

namespace tomales {
namespace {

/// Camera rays see the radiance of an area light added to what its surface reflects (docs/gi.md).
void addVisibleEmission(const ShadePoints& points, const vec3& emission, ShadedPoints& out) {
  for (int i = 0; i < points.count(); ++i) {
    if (dot(points.get3(kIx, i), points.get3(kNgx, i)) >= 0) continue;
    for (int c = 0; c < 3; ++c) out.Ci[c][static_cast<size_t>(i)] += emission[c];
  }
}

/// Opaque and black: what needs no shader.
void leaveBlack(int count, ShadedPoints& out) {
  out.resize(count);
  for (auto& o : out.Oi) std::fill(o.begin(), o.end(), 1.0f);
}

void shadeTile(DeepTile& tile, const Scene& scene, const ShadingSystem& shading, const ShadeContext& context,
               bool wantsColor) {
  tile.shaded.resize(tile.batches.size());
  for (size_t b = 0; b < tile.batches.size(); ++b) {
    const ShadePoints& points = tile.batches[b];
    ShadedPoints& out = tile.shaded[b];
    // A holdout is opaque to the hider and black in the picture; filtering gives it no alpha.
    const bool matte = scene.groups[static_cast<size_t>(points.group())].attributes->matte;
    if (matte || (!wantsColor && shading.opaque(points.group()))) {
      leaveBlack(points.count(), out);
      continue;
    }
    shading.shade(points, context, out);
    const vec3 emission = shading.visibleEmission(points.group());
    if (maxComponent(emission) > 0) addVisibleEmission(points, emission, out);
    shading.atmosphere(points, out);
  }
}

}  // namespace

void shadeFrame(DeepFrame& frame, const Scene& scene, const ShadingSystem& shading, const ShadeContext& context,
                const FrameControl& control, Stats&) {
  std::atomic<size_t> done{0};
  std::atomic<bool> skipped{false};
  const bool wantsColor = outputOf(scene.options).shades;
  ShadeContext stored = context;
  stored.variables = true;
  parallelFor(frame.tiles.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      DeepTile& tile = frame.tiles[i];
      if (control.cancelled && *control.cancelled) {
        skipped = true;
        std::fill(tile.pixels.begin(), tile.pixels.end(), DeepPixel{});
        continue;
      }
      shadeTile(tile, scene, shading, stored, wantsColor);
      if (control.progress) control.progress(static_cast<float>(++done) / static_cast<float>(frame.tiles.size()));
    }
  });
  if (skipped) frame.complete = false;
}

Image imageOf(const DeepFrame& frame, const Scene& scene, const FrameControl& control, Stats&) {
  const SamplePattern pattern = samplePattern(scene.options, control.seed);
  return filterFrame(frame, scene.options, sampleOffsets(pattern));
}

}  // namespace tomales
