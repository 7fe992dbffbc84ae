#include "reyes/hide/samples.h"

#include <tuple>

namespace tomales {

uint32_t GridTable::add(const std::shared_ptr<const RasterGrid>& raster) {
  const uint32_t first = cells_;
  entries_.push_back({first, raster});
  cells_ += static_cast<uint32_t>(raster->grid->cellCount());
  return first;
}

const GridTable::Entry& GridTable::of(uint32_t cell) const {
  const auto after = std::upper_bound(entries_.begin(), entries_.end(), cell,
                                      [](uint32_t c, const Entry& e) { return c < e.firstCell; });
  return *(after - 1);
}

bool GridTable::precedes(uint32_t a, uint32_t b) const {
  const auto rank = [this](uint32_t cell) {
    const Entry& e = of(cell);
    const Grid& g = e.grid();
    return std::make_tuple(g.name, g.object, g.patch, g.rect.u0, g.rect.v0, cell - e.firstCell);
  };
  return rank(a) < rank(b);
}

SampleBuffer::SampleBuffer(const SamplePattern& samplePattern, const PixelRect& pixels)
    : rect(pixels), pattern(samplePattern), lanes(samplePattern.padded()) {
  const size_t count = static_cast<size_t>(rect.width()) * static_cast<size_t>(rect.height());
  const size_t width = static_cast<size_t>(lanes);
  patternOf.reserve(count);
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x) patternOf.push_back(pattern.patternOf(x, y));
  depth.assign(count * width, -kInfinity);
  for (size_t p = 0; p < count; ++p) std::fill_n(depth.data() + p * width, pattern.count(), kNothing);
  cell.assign(count * width, kNoCell);
  far.assign(count, kNothing);
}

PixelRect SampleBuffer::touched(const vec2& lo, const vec2& hi) const {
  // Clamped while still float: a vertex near the eye plane may lie farther out than an int can tell.
  const auto pixel = [](float v, int first, int end) {
    return static_cast<int>(std::floor(std::clamp(v, static_cast<float>(first - 1), static_cast<float>(end))));
  };
  const PixelRect r{pixel(lo.x, rect.x0, rect.x1), pixel(lo.y, rect.y0, rect.y1),
                    pixel(hi.x, rect.x0, rect.x1) + 1, pixel(hi.y, rect.y0, rect.y1) + 1};
  return {std::max(r.x0, rect.x0), std::max(r.y0, rect.y0), std::min(r.x1, rect.x1), std::min(r.y1, rect.y1)};
}

bool SampleBuffer::hides(const PixelRect& pixels, float d) const {
  for (int y = pixels.y0; y < pixels.y1; ++y)
    for (int x = pixels.x0; x < pixels.x1; ++x)
      if (!(far[pixelIndex(x, y)] < d)) return false;
  return true;
}

}  // namespace tomales
