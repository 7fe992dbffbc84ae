#include "gi/frame/frame_survey.h"

#include <array>
#include <bit>
#include <mutex>

#include "reyes/base/checksum.h"
#include "reyes/base/parallel.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

/// Returns a hash of the nearest point that a pixel sees.
uint64_t hashOf(int x, int y, int group, const vec3& P) {
  const std::array<uint32_t, 6> seen{static_cast<uint32_t>(x),     static_cast<uint32_t>(y),
                                     static_cast<uint32_t>(group), std::bit_cast<uint32_t>(P.x),
                                     std::bit_cast<uint32_t>(P.y), std::bit_cast<uint32_t>(P.z)};
  return checksum(std::as_bytes(std::span(seen)));
}

/// Returns for each batch the sum of the hashes of the pixels whose nearest point it has.
std::vector<uint64_t> seenOfBatches(const DeepTile& tile) {
  std::vector<uint64_t> seen(tile.batches.size());
  for (int y = tile.rect.y0; y < tile.rect.y1; ++y)
    for (int x = tile.rect.x0; x < tile.rect.x1; ++x) {
      const DeepPixel& pixel = tile.pixel(x, y);
      if (pixel.count == 0) continue;
      const Facet& facet = tile.facets[tile.fragments[pixel.first].facet];
      const auto b = static_cast<size_t>(facet.batch);
      seen[b] += hashOf(x, y, tile.batches[b].group(), tile.batches[b].position(facet.point[0]));
    }
  return seen;
}

}  // namespace

FrameSurvey surveyOf(const DeepFrame& layout, const TileReader& tiles, size_t groups, StopToken stop) {
  FrameSurvey out{{}, std::vector<uint64_t>(groups)};
  std::mutex merging;
  parallelFor(layout.tileCount(), 1, [&](size_t t, size_t) {
    const auto tile = stop.requested() ? nullptr : tiles(t);
    if (!tile) return;
    Bound3 here;
    for (const ShadePoints& batch : tile->batches)
      for (int i = 0; i < batch.count(); ++i) here.extend(batch.position(i));
    const std::vector<uint64_t> seen = seenOfBatches(*tile);
    const std::lock_guard lock(merging);
    out.bound.extend(here);
    for (size_t b = 0; b < seen.size(); ++b) out.seenOfGroup[static_cast<size_t>(tile->batches[b].group())] += seen[b];
  });
  return out;
}

}  // namespace tomales
