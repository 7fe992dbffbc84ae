#include "reyes/hide/resolve.h"

#include <tuple>

#include "reyes/hide/facets.h"

namespace tomales {
namespace {

/// One sample sees one cell.
struct Sighting {
  uint32_t cell, lane;
  float d;
};

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
    std::sort(samples_.layers.begin(), samples_.layers.end(), [](const Layer& a, const Layer& b) {
      return std::tie(a.sample, a.cell) < std::tie(b.sample, b.cell);
    });
    for (size_t pixel = 0; pixel < count; ++pixel) addPixel(pixel);
    return std::move(tile_);
  }

 private:
  void addPixel(size_t pixel) {
    collectSightings(pixel);
    mergeSightings(pixel);
    // Nearest first; equal depths in an order that no schedule changes.
    std::sort(sights_.begin(), sights_.end(), [this](const Sight& a, const Sight& b) {
      if (a.d != b.d) return a.d < b.d;
      if (a.cell != b.cell) return grids_.precedes(a.cell, b.cell);
      return a.fragment.word < b.fragment.word;
    });
    tile_.pixels.push_back(
        {static_cast<uint32_t>(tile_.fragments.size()), static_cast<uint32_t>(sights_.size())});
    for (Sight& s : sights_) {
      s.fragment.facet = facets_.facetOf(s.cell);
      tile_.fragments.push_back(s.fragment);
    }
  }

  void collectSightings(size_t pixel) {
    sightings_.clear();
    const size_t first = pixel * static_cast<size_t>(samples_.lanes);
    const uint32_t lanes = static_cast<uint32_t>(samples_.lanes);
    for (uint32_t lane = 0; lane < lanes; ++lane)
      if (const uint32_t cell = samples_.cell[first + lane]; cell != kNoCell)
        sightings_.push_back({cell, lane, samples_.depth[first + lane]});
    for (; nextLayer_ < samples_.layers.size() && samples_.layers[nextLayer_].sample < first + lanes;
         ++nextLayer_) {
      const Layer& l = samples_.layers[nextLayer_];
      const float d = samples_.depth[l.sample];
      if (l.d < d || (l.d == d && grids_.precedes(l.cell, samples_.cell[l.sample])))
        sightings_.push_back({l.cell, l.sample - static_cast<uint32_t>(first), l.d});
    }
    std::sort(sightings_.begin(), sightings_.end(), [](const Sighting& a, const Sighting& b) {
      return std::tie(a.cell, a.lane) < std::tie(b.cell, b.lane);
    });
  }

  void mergeSightings(size_t pixel) {
    sights_.clear();
    for (size_t i = 0; i < sightings_.size();) {
      const size_t begin = i;
      const uint32_t cell = sightings_[i].cell, word = sightings_[i].lane / 64;
      Sight sight{cell, {0, 0, 0, static_cast<uint16_t>(word)}, kInfinity};
      for (; i < sightings_.size() && sightings_[i].cell == cell && sightings_[i].lane / 64 == word; ++i) {
        sight.fragment.samples |= uint64_t{1} << (sightings_[i].lane % 64);
        sight.d = std::min(sight.d, sightings_[i].d);
      }
      sight.fragment.z = camera_.zFromDepthKey(sight.d);
      if (grids_.of(cell).raster->smooth) setPosition(sight.fragment, pixel, begin, i);
      sights_.push_back(sight);
    }
  }

  void setPosition(Fragment& fragment, size_t pixel, size_t begin, size_t end) const {
    const GridTable::Entry& entry = grids_.of(sightings_[begin].cell);
    const int width = samples_.rect.width();
    const size_t pattern = samples_.patternAt[pixel];
    const vec2 corner(samples_.rect.x0 + static_cast<int>(pixel) % width,
                      samples_.rect.y0 + static_cast<int>(pixel) / width);
    vec2 sum(0);
    for (size_t i = begin; i < end; ++i) {
      const size_t s = pattern + sightings_[i].lane;
      const vec2 at = corner + vec2(samples_.x[s], samples_.y[s]);
      sum +=
          positionOnCell(entry, static_cast<int>(sightings_[i].cell - entry.firstCell), at, samples_.time[s]);
    }
    const vec2 mean = sum * (255.0f / static_cast<float>(end - begin));
    fragment.u = static_cast<uint8_t>(std::lround(mean.x)),
    fragment.v = static_cast<uint8_t>(std::lround(mean.y));
  }

  const Camera& camera_;
  const GridTable& grids_;
  SampleBuffer& samples_;
  DeepTile tile_;
  FacetTable facets_;
  size_t nextLayer_ = 0;
  std::vector<Sighting> sightings_;
  std::vector<Sight> sights_;
};

}  // namespace

DeepTile resolveTile(const Scene& scene, const Camera& camera, const GridTable& grids,
                     SampleBuffer& samples) {
  return TileBuilder(scene, camera, grids, samples).build();
}

}  // namespace tomales
