#include "reyes/app/frame/audit_samples.h"

#include <algorithm>
#include <mutex>
#include <tuple>

#include "reyes/base/parallel.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/frame.h"

namespace tomales {
namespace {

constexpr size_t kMostAuditLayers = 16;
constexpr size_t kSamplesPerSlice = 4;

auto placeOf(const AuditSample& s) { return std::tuple(s.order, s.y, s.x); }
bool isEarlier(const AuditSample& a, const AuditSample& b) { return placeOf(a) < placeOf(b); }

/// Keeps the `count` samples of the least order.
void keepFirst(std::vector<AuditSample>& samples, size_t count) {
  if (samples.size() <= count) return;
  std::nth_element(samples.begin(), samples.begin() + static_cast<ptrdiff_t>(count), samples.end(), isEarlier);
  samples.erase(samples.begin() + static_cast<ptrdiff_t>(count), samples.end());
}

ShadePoints pointOf(const ShadePoints& batch, int i) {
  ShadePoints out(batch.group(), batch.primvarFloats(), batch.hasSteps());
  out.assign(batch, i, i + 1);
  return out;
}

/// Smooth shading interpolates the corners of a facet; the nearest one stands for them here.
int nearestCorner(const Fragment& f) { return (f.u >= 128 ? 1 : 0) + (f.v >= 128 ? 2 : 0); }

std::vector<AuditSample::Layer> layersOf(const DeepTile& tile, int x, int y, int sample) {
  std::vector<AuditSample::Layer> out;
  const DeepPixel& pixel = tile.pixel(x, y);
  for (uint32_t f = pixel.first; f < pixel.first + pixel.count && out.size() < kMostAuditLayers; ++f) {
    const Fragment& fragment = tile.fragments[f];
    if (fragment.word != sample / 64 || !(fragment.samples >> sample % 64 & 1)) continue;
    const Facet& facet = tile.facets[fragment.facet];
    const ShadePoints& batch = tile.batches[static_cast<size_t>(facet.batch)];
    out.push_back({pointOf(batch, facet.point[nearestCorner(fragment)]), facet.matte});
  }
  return out;
}

std::vector<AuditSample> samplesOfTile(const DeepTile& tile, const PixelRect& seen, int samplesPerPixel, size_t count,
                                       uint32_t seed) {
  std::vector<AuditSample> pixels;
  for (int y = std::max(seen.y0, tile.rect.y0); y < std::min(seen.y1, tile.rect.y1); ++y)
    for (int x = std::max(seen.x0, tile.rect.x0); x < std::min(seen.x1, tile.rect.x1); ++x)
      if (tile.pixel(x, y).count > 0)
        pixels.push_back(
            {hashCombine(static_cast<uint32_t>(x), static_cast<uint32_t>(y), seed, randomStream("audi")), x, y, {}});
  std::sort(pixels.begin(), pixels.end(), isEarlier);
  std::vector<AuditSample> out;
  for (AuditSample& s : pixels) {
    if (out.size() == count) break;
    const int sample = static_cast<int>(hash32(s.order) % static_cast<uint32_t>(samplesPerPixel));
    s.layers = layersOf(tile, s.x, s.y, sample);
    if (!s.layers.empty()) out.push_back(std::move(s));
  }
  return out;
}

void append(const ShadePoints& point, DeepTile& tile) {
  auto batch = std::find_if(tile.batches.begin(), tile.batches.end(), [&](const ShadePoints& b) {
    return b.group() == point.group() && b.channelCount() == point.channelCount();
  });
  if (batch == tile.batches.end())
    batch = tile.batches.insert(batch, ShadePoints(point.group(), point.primvarFloats(), point.hasSteps()));
  const int i = batch->add(point.name(0));
  for (int c = 0; c < point.channelCount(); ++c) batch->channel(c)[i] = point.channel(c)[0];
  tile.facets.push_back({static_cast<int>(batch - tile.batches.begin()), {i, i, i, i}});
}

}  // namespace

std::vector<AuditSample> chooseSamples(const DeepFrame& layout, const TileReader& tiles, size_t count, uint32_t seed,
                                       const std::atomic<bool>& cancelled) {
  std::vector<AuditSample> out;
  std::mutex merging;
  parallelFor(layout.tileCount(), 1, [&](size_t t, size_t) {
    const PixelRect r = layout.rectOf(t), &crop = layout.crop;
    const bool seen = r.x0 < crop.x1 && r.x1 > crop.x0 && r.y0 < crop.y1 && r.y1 > crop.y0;
    const auto tile = seen && !cancelled ? tiles(t) : nullptr;
    if (!tile) return;
    std::vector<AuditSample> here = samplesOfTile(*tile, crop, layout.samplesPerPixel, count, seed);
    const std::lock_guard lock(merging);
    std::move(here.begin(), here.end(), std::back_inserter(out));
    keepFirst(out, count);
  });
  std::sort(out.begin(), out.end(),
            [](const AuditSample& a, const AuditSample& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  return out;
}

std::vector<vec3> shadeSamples(const std::vector<AuditSample>& samples, const Scene& scene,
                               const ShadingSystem& shading, const ShadeContext& context) {
  std::vector<vec3> out(samples.size(), vec3(0.0f));
  parallelFor(samples.size(), kSamplesPerSlice, [&](size_t begin, size_t end) {
    DeepTile tile;
    for (size_t s = begin; s < end; ++s)
      for (const AuditSample::Layer& layer : samples[s].layers) append(layer.point, tile);
    shadeTile(tile, scene, shading, context);
    auto facet = tile.facets.begin();
    for (size_t s = begin; s < end; ++s) {
      vec3 clear(1.0f);
      for (const AuditSample::Layer& layer : samples[s].layers) {
        const ShadedPoints& shaded = tile.shaded[static_cast<size_t>(facet->batch)];
        if (!layer.matte) out[s] += clear * shaded.color(facet->point[0]);
        clear *= vec3(1.0f) - shaded.opacity(facet->point[0]);
        ++facet;
      }
    }
  });
  return out;
}

}  // namespace tomales
