#include "reyes/hide/resolve.h"

#include <bit>
#include <tuple>

#include "reyes/hide/facets.h"

namespace tomales {
namespace {

/// All samples of a pixel, up to 64, that see one cell.
struct Sight {
  uint32_t cell;
  Fragment fragment;
  float d;
};

class TileBuilder {
 public:
  TileBuilder(const Scene& scene, const Camera& camera, const GridTable& grids, SampleBuffer& samples)
      : camera_(camera), grids_(grids), samples_(samples), facets_(scene, camera, grids, tile_) {}

  DeepTile build() {
    tile_.rect = samples_.rect;
    const size_t count = samples_.far.size();
    tile_.pixels.reserve(count);
    // Within a pixel by cell: what a fragment is made of stands together.
    std::sort(samples_.layers.begin(), samples_.layers.end(), [](const Layer& p, const Layer& q) {
      return std::tie(p.pixel, p.cell, p.lane) < std::tie(q.pixel, q.cell, q.lane);
    });
    for (size_t pixel = 0; pixel < count; ++pixel) addPixel(pixel);
    tile_.shrink();
    return std::move(tile_);
  }

 private:
  void addPixel(size_t pixel) {
    sights_.clear();
    seeOpaque(pixel);
    seeLayers(pixel);
    // Nearest first; equal depths in an order that no schedule changes.
    std::sort(sights_.begin(), sights_.end(), [this](const Sight& a, const Sight& b) {
      if (a.d != b.d) return a.d < b.d;
      if (a.cell != b.cell) return grids_.precedes(a.cell, b.cell);
      return a.fragment.word < b.fragment.word;
    });
    tile_.pixels.push_back(
        {static_cast<uint32_t>(tile_.fragments.size()), static_cast<uint32_t>(sights_.size())});
    for (Sight& s : sights_) {
      s.fragment.z = camera_.zFromDepthKey(s.d);
      if (grids_.of(s.cell).raster->smooth) setPosition(s, pixel);
      s.fragment.facet = facets_.facetOf(s.cell);
      tile_.fragments.push_back(s.fragment);
    }
  }

  void seeOpaque(size_t pixel) {
    const size_t first = pixel * static_cast<size_t>(samples_.lanes);
    const uint32_t lanes = static_cast<uint32_t>(samples_.lanes);
    for (uint32_t lane = 0; lane < lanes; ++lane) {
      const uint32_t cell = samples_.cell[first + lane];
      if (cell == kNoCell) continue;
      const auto it = std::find_if(sights_.rbegin(), sights_.rend(), [&](const Sight& s) {
        return s.cell == cell && s.fragment.word == lane / 64;
      });
      see(it != sights_.rend() ? *it : newSight(cell, lane), lane, samples_.depth[first + lane]);
    }
  }

  void seeLayers(size_t pixel) {
    const size_t first = pixel * static_cast<size_t>(samples_.lanes);
    for (; nextLayer_ < samples_.layers.size() && samples_.layers[nextLayer_].pixel == pixel; ++nextLayer_) {
      const Layer& l = samples_.layers[nextLayer_];
      const float d = samples_.depth[first + l.lane];
      if (l.d > d || (l.d == d && !grids_.precedes(l.cell, samples_.cell[first + l.lane]))) continue;
      const bool known =
          !sights_.empty() && sights_.back().cell == l.cell && sights_.back().fragment.word == l.lane / 64;
      see(known ? sights_.back() : newSight(l.cell, l.lane), l.lane, l.d);
    }
  }

  Sight& newSight(uint32_t cell, uint32_t lane) {
    return sights_.emplace_back(Sight{cell, {0, 0, 0, static_cast<uint16_t>(lane / 64)}, kInfinity});
  }

  static void see(Sight& sight, uint32_t lane, float d) {
    sight.fragment.samples |= uint64_t{1} << (lane % 64);
    sight.d = std::min(sight.d, d);
  }

  void setPosition(Sight& sight, size_t pixel) const {
    Fragment& fragment = sight.fragment;
    const GridTable::Entry& entry = grids_.of(sight.cell);
    const int cell = static_cast<int>(sight.cell - entry.firstCell);
    vec2 sum(0);
    for (uint64_t left = fragment.samples; left != 0; left &= left - 1) {
      const auto lane = static_cast<uint32_t>(64 * fragment.word + std::countr_zero(left));
      const vec2 at = positionOnCell(entry, camera_, cell, samplePoint(samples_, pixel, lane));
      sum += glm::clamp(at, vec2(0), vec2(1));
    }
    const vec2 mean = sum * (255.0f / static_cast<float>(std::popcount(fragment.samples)));
    fragment.u = static_cast<uint8_t>(std::lround(mean.x)),
    fragment.v = static_cast<uint8_t>(std::lround(mean.y));
  }

  const Camera& camera_;
  const GridTable& grids_;
  SampleBuffer& samples_;
  DeepTile tile_;
  FacetTable facets_;
  size_t nextLayer_ = 0;
  std::vector<Sight> sights_;
};

}  // namespace

DeepTile resolveTile(const Scene& scene, const Camera& camera, const GridTable& grids,
                     SampleBuffer& samples) {
  return TileBuilder(scene, camera, grids, samples).build();
}

}  // namespace tomales
