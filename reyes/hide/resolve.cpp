#include "reyes/hide/resolve.h"

#include <tuple>

#include "reyes/base/check.h"
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
      : camera_(camera), grids_(grids), samples_(samples), facets_(scene, camera, grids, tile_), scene_(scene) {}

  DeepTile build() {
    tile_.rect = samples_.rect;
    const size_t count = samples_.far.size();
    tile_.pixels.reserve(count);
    std::sort(samples_.layers.begin(), samples_.layers.end(),
              [](const Layer& a, const Layer& b) { return std::tie(a.sample, a.cell) < std::tie(b.sample, b.cell); });
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
    tile_.pixels.push_back({static_cast<uint32_t>(tile_.fragments.size()), static_cast<uint32_t>(sights_.size())});
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
    for (; nextLayer_ < samples_.layers.size() && samples_.layers[nextLayer_].sample < first + lanes; ++nextLayer_) {
      const Layer& l = samples_.layers[nextLayer_];
      const float d = samples_.depth[l.sample];
      if (l.d < d || (l.d == d && grids_.precedes(l.cell, samples_.cell[l.sample])))
        sightings_.push_back({l.cell, l.sample - static_cast<uint32_t>(first), l.d});
    }
    std::sort(sightings_.begin(), sightings_.end(),
              [](const Sighting& a, const Sighting& b) { return std::tie(a.cell, a.lane) < std::tie(b.cell, b.lane); });
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
    const std::vector<float> times = shutterTimes(scene_, entry.grid());
    const int width = samples_.rect.width(), p = samples_.patternOf[pixel];
    const vec2 corner(samples_.rect.x0 + static_cast<int>(pixel) % width, samples_.rect.y0 + static_cast<int>(pixel) / width);
    vec2 sum(0);
    for (size_t i = begin; i < end; ++i) {
      const uint32_t s = sightings_[i].lane;
      const vec2 at = corner + vec2(samples_.pattern.x(p)[s], samples_.pattern.y(p)[s]);
      sum += positionOnCell(*entry.raster, times, static_cast<int>(sightings_[i].cell - entry.firstCell), at,
                            samples_.pattern.time(p)[s]);
    }
    const vec2 mean = sum * (255.0f / static_cast<float>(end - begin));
    fragment.u = static_cast<uint8_t>(std::lround(mean.x)), fragment.v = static_cast<uint8_t>(std::lround(mean.y));
  }

  const Camera& camera_;
  const GridTable& grids_;
  SampleBuffer& samples_;
  DeepTile tile_;
  FacetTable facets_;
  const Scene& scene_;
  size_t nextLayer_ = 0;
  std::vector<Sighting> sightings_;
  std::vector<Sight> sights_;
};

}  // namespace

DeepTile resolveTile(const Scene& scene, const Camera& camera, const GridTable& grids, SampleBuffer& samples) {
  return TileBuilder(scene, camera, grids, samples).build();
}

std::vector<float> shutterTimes(const Scene& scene, const Grid& grid) {
  if (grid.keyCount == 1) return {0};
  std::vector<float> times = scene.objects[static_cast<size_t>(grid.object)].keyTimes;
  CHECK_EQ(static_cast<int>(times.size()), grid.keyCount);
  const float open = scene.options.shutterOpen, length = scene.options.shutterClose - open;
  for (float& t : times) t = (t - open) / length;
  return times;
}

namespace {

/// (u,v) of a point in triangle p q r whose corners have parameters at[0..2]; outside, the nearest is up to the caller.
vec2 inTriangle(const vec2 p[3], const vec2 at[3], const vec2& x) {
  const vec2 e = p[1] - p[0], f = p[2] - p[0], g = x - p[0];
  const float area = e.x * f.y - e.y * f.x;
  if (area == 0) return (at[0] + at[1] + at[2]) / 3.0f;
  const float b = (g.x * f.y - g.y * f.x) / area, c = (e.x * g.y - e.y * g.x) / area;
  return at[0] + (at[1] - at[0]) * b + (at[2] - at[0]) * c;
}

}  // namespace

vec2 positionOnCell(const RasterGrid& raster, const std::vector<float>& keyTimes, int cell, vec2 at, float time) {
  const Grid& g = *raster.grid;
  const int row = g.nu + 1, a = cell / g.nu * row + cell % g.nu;
  size_t key = 0;
  while (key + 2 < keyTimes.size() && time >= keyTimes[key + 1]) ++key;
  const size_t next = std::min(key + 1, keyTimes.size() - 1), stride = static_cast<size_t>(g.stride());
  const float t = next > key ? (time - keyTimes[key]) / (keyTimes[next] - keyTimes[key]) : 0;
  const auto corner = [&](int v) {
    const size_t from = key * stride + static_cast<size_t>(v), to = next * stride + static_cast<size_t>(v);
    return vec2(lerp(raster.x[from], raster.x[to], t), lerp(raster.y[from], raster.y[to], t));
  };
  const vec2 pa = corner(a), pb = corner(a + 1), pc = corner(a + row), pd = corner(a + row + 1);
  const vec2 abc[3] = {pa, pb, pc}, abcUv[3] = {{0, 0}, {1, 0}, {0, 1}};
  const vec2 dcb[3] = {pd, pc, pb}, dcbUv[3] = {{1, 1}, {0, 1}, {1, 0}};
  vec2 uv = inTriangle(abc, abcUv, at);
  if (uv.x + uv.y > 1) uv = inTriangle(dcb, dcbUv, at);
  return glm::clamp(uv, vec2(0), vec2(1));
}

}  // namespace tomales
