#include "reyes/hide/samples.h"

#include <tuple>

namespace tomales {

const GridTable::Entry& GridTable::add(const std::shared_ptr<const RasterGrid>& raster,
                                       std::vector<float> keyTimes) {
  entries_.push_back({cells_, raster, std::move(keyTimes)});
  cells_ += static_cast<uint32_t>(raster->grid->cellCount());
  return entries_.back();
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

SampleBuffer::SampleBuffer(const SamplePattern& pattern, const PixelRect& pixels)
    : rect(pixels),
      lanes(pattern.padded()),
      x(pattern.x(0)),
      y(pattern.y(0)),
      time(pattern.time(0)),
      lensX(pattern.lensX(0)),
      lensY(pattern.lensY(0)),
      detail(pattern.detail(0)) {
  const size_t count = static_cast<size_t>(rect.width()) * static_cast<size_t>(rect.height());
  const size_t width = static_cast<size_t>(lanes);
  patternAt.reserve(count);
  for (int row = rect.y0; row < rect.y1; ++row)
    for (int column = rect.x0; column < rect.x1; ++column)
      patternAt.push_back(static_cast<size_t>(pattern.patternOf(column, row)) * width);
  depth.assign(count * width, -kInfinity);
  for (size_t p = 0; p < count; ++p) std::fill_n(depth.data() + p * width, pattern.count(), kNothing);
  cell.assign(count * width, kNoCell);
  far.assign(count, kNothing);
}

bool SampleBuffer::hides(const PixelRect& pixels, float d) const {
  for (int row = pixels.y0; row < pixels.y1; ++row)
    for (int column = pixels.x0; column < pixels.x1; ++column)
      if (!(far[pixelIndex(column, row)] < d)) return false;
  return true;
}

}  // namespace tomales
