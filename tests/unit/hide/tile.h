// Hiding a list of grids, and reading what samples see.
#pragma once
#include <bit>
#include <tuple>

#include "tests/unit/hide/fixture.h"

namespace tomales::test {

using Rasters = std::vector<std::shared_ptr<const RasterGrid>>;

inline DeepTile hide(const World& w, const SamplePattern& pattern, const PixelRect& rect, const Rasters& rasters) {
  Hider hider(w.scene, Camera(w.scene.options), pattern, rect);
  for (const auto& r : rasters) hider.insert(r);
  return hider.resolve();
}

inline std::shared_ptr<const RasterGrid> raster(const World& w, const std::shared_ptr<Grid>& g, bool opaque = true) {
  return project(g, w.scene, Camera(w.scene.options), opaque);
}

inline const Fragment* begin(const DeepTile& t, const DeepPixel& p) { return t.fragments.data() + p.first; }

/// Counts the fragments that sample s of a pixel belongs to.
inline int hits(const DeepTile& t, int x, int y, int s) {
  const DeepPixel& p = t.pixel(x, y);
  int n = 0;
  for (uint32_t k = 0; k < p.count; ++k) {
    const Fragment& f = begin(t, p)[k];
    if (f.word == s / 64 && (f.samples >> (s % 64) & 1U)) ++n;
  }
  return n;
}

/// Fraction of the samples of a pixel that see anything.
inline float coverage(const DeepTile& t, int x, int y, int samples) {
  int n = 0;
  for (int s = 0; s < samples; ++s) n += hits(t, x, y, s) > 0;
  return static_cast<float>(n) / static_cast<float>(samples);
}

/// Calls f(x, y, s, raster position, time) for every sample of a rectangle.
template <class F>
void forSamples(const SamplePattern& p, const PixelRect& rect, const F& f) {
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x)
      for (int s = 0; s < p.count(); ++s) {
        const int k = p.patternOf(x, y);
        f(x, y, s, vec2(static_cast<float>(x) + p.x(k)[s], static_cast<float>(y) + p.y(k)[s]), p.time(k)[s]);
      }
}

/// What a pixel sees, free of tile-wide numbering: fragments in order, each with the keys of its points.
using Seen = std::vector<std::tuple<float, uint64_t, int, int, int, std::vector<uint32_t>>>;
inline Seen seen(const DeepTile& t, int x, int y) {
  Seen out;
  const DeepPixel& p = t.pixel(x, y);
  for (uint32_t k = 0; k < p.count; ++k) {
    const Fragment& f = begin(t, p)[k];
    const Facet& facet = t.facets[f.facet];
    std::vector<uint32_t> keys;
    for (const int point : facet.point) keys.push_back(t.batches[static_cast<size_t>(facet.batch)].key(point));
    out.emplace_back(f.z, f.samples, f.word, f.u, f.v, keys);
  }
  return out;
}

inline int groupOf(const DeepTile& t, const Fragment& f) {
  return t.batches[static_cast<size_t>(t.facets[f.facet].batch)].group();
}

}  // namespace tomales::test
