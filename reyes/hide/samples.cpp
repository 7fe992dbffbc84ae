#include "reyes/hide/samples.h"

#include <tuple>

#include "reyes/hide/subpixel.h"

namespace tomales {

const GridTable::Entry& GridTable::add(const std::shared_ptr<const RasterGrid>& raster, std::vector<float> keyTimes) {
  const uint32_t first = cellCount(), cells = static_cast<uint32_t>(raster->grid->cellNumbers());
  entryOfPage_.resize(entryOfPage_.size() + (cells + kPage - 1) / kPage, static_cast<uint32_t>(entries_.size()));
  entries_.push_back({first, raster, std::move(keyTimes)});
  ++held_;
  anySmooth_ |= raster->smooth;
  return entries_.back();
}

void GridTable::keepOnly(const std::vector<uint32_t>& cells) {
  for (Entry& e : entries_) {
    if (!e.raster) continue;
    const auto first = std::lower_bound(cells.begin(), cells.end(), e.firstCell);
    if (first != cells.end() && *first < e.firstCell + static_cast<uint32_t>(e.grid().cellNumbers())) continue;
    e.raster.reset();
    --held_;
  }
}

bool GridTable::precedes(uint32_t a, uint32_t b) const {
  const auto rank = [this](uint32_t cell) {
    const Entry& e = of(cell);
    const Grid& g = e.grid();
    const int number = static_cast<int>(cell - e.firstCell);
    const Grid::Piece& p = g.pieces[static_cast<size_t>(g.pieceOfCell(number))];
    return std::make_tuple(p.sampleKey, g.object, p.patch, p.rect.u0, p.rect.v0, g.cellInPiece(number));
  };
  return rank(a) < rank(b);
}

namespace {

size_t countOf(const PixelRect& pixels) {
  return static_cast<size_t>(pixels.width()) * static_cast<size_t>(pixels.height());
}

/// Places the samples of a row of pixels, from the pattern of each.
TOMALES_HOT void placeRow(const SamplePattern& pattern, const int* patternAt, const PixelRect& rect, int row, int lanes,
                          const vec2& origin, float* __restrict x, float* __restrict y, int32_t* __restrict xy) {
  for (int column = rect.x0; column < rect.x1; ++column, ++patternAt) {
    const float *fromX = pattern.x(*patternAt), *fromY = pattern.y(*patternAt), byX = static_cast<float>(column),
                byY = static_cast<float>(row);
    for (int k = 0; k < lanes; k += kLanes, x += kLanes, y += kLanes, xy += kLanes)
#pragma GCC ivdep
      for (int i = 0; i < kLanes; ++i) {
        x[i] = byX + fromX[k + i];
        y[i] = byY + fromY[k + i];
        const auto latticeX = static_cast<int32_t>((x[i] - origin.x) * kSubpixels),
                   latticeY = static_cast<int32_t>((y[i] - origin.y) * kSubpixels);
        xy[i] =
            static_cast<int32_t>(static_cast<uint32_t>(latticeY) << 16 | (static_cast<uint32_t>(latticeX) & 0xffffU));
      }
  }
}

}  // namespace

SampleBuffer::SampleBuffer(const SamplePattern& pattern, const Camera& camera, const PixelRect& pixels)
    : rect(pixels),
      lanes(pattern.padded()),
      origin(rect.x0 + kHalf_px, rect.y0 + kHalf_px),
      layers(countOf(pixels), static_cast<size_t>(lanes)),
      crossings(countOf(pixels), static_cast<size_t>(lanes)),
      pattern_(pattern),
      lens_(camera.lens()) {
  const size_t count = countOf(rect);
  const size_t width = static_cast<size_t>(lanes), samples = static_cast<size_t>(pattern.count());
  x.resize(count * width);
  y.resize(count * width);
  xy.resize(count * width);
  depth.assign(count * width, kNothing);
  cell.assign(count * width, kNoCell);
  far.assign(count, kNothing);
  nearer.assign(count, 0);
  patternAt_.reserve(count);
  pixelOf.resize(count * width / kLanes);
  for (size_t p = 0, k = 0; p < count; ++p)
    for (const size_t end = k + width / kLanes; k < end; ++k) pixelOf[k] = static_cast<uint32_t>(p);
  for (int row = rect.y0; row < rect.y1; ++row) {
    const size_t first = patternAt_.size();
    for (int column = rect.x0; column < rect.x1; ++column) patternAt_.push_back(pattern.patternOf(column, row));
    placeRow(pattern, patternAt_.data() + first, rect, row, lanes, origin, x.data() + first * width,
             y.data() + first * width, xy.data() + first * width);
  }
  for (size_t p = 0; p < count && samples < width; ++p)
    std::fill_n(depth.data() + p * width + samples, width - samples, -kInfinity);
}

void SampleBuffer::addTimesAndLens() {
  if (!time.empty()) return;
  time.resize(x.size());
  lensX.resize(x.size());
  lensY.resize(x.size());
  const size_t width = static_cast<size_t>(lanes);
  for (size_t p = 0; p < patternAt_.size(); ++p) {
    const int at = patternAt_[p];
    std::copy_n(pattern_.time(at), width, time.data() + p * width);
    for (size_t s = 0; s < width; ++s) {
      lensX[p * width + s] = pattern_.lensX(at)[s] * lens_.x;
      lensY[p * width + s] = pattern_.lensY(at)[s] * lens_.y;
    }
  }
}

std::vector<uint32_t> SampleBuffer::seen() const {
  std::vector<uint32_t> out;
  std::copy_if(cell.begin(), cell.end(), std::back_inserter(out), [](uint32_t c) { return c != kNoCell; });
  for (const TransparentLayers* covered : {&layers, &crossings})
    for (size_t k = 0, end = covered->count() * covered->width(); k < end; ++k)
      if (const uint32_t c = covered->cells(0)[k]; c != kNoCell && (out.empty() || out.back() != c)) out.push_back(c);
  std::sort(out.begin(), out.end());
  return out;
}

bool SampleBuffer::hides(const Bound2& bound, float d) const {
  const PixelRect pixels = touched(bound.lo, bound.hi);
  if (pixels.width() * pixels.height() > kFew_px) return hides(pixels, d);
  const size_t width = static_cast<size_t>(lanes);
  for (int row = pixels.y0; row < pixels.y1; ++row)
    for (int column = pixels.x0; column < pixels.x1; ++column) {
      const size_t pixel = pixelIndex(column, row), first = pixel * width;
      if (far[pixel] < d) continue;
      int seeing = 0;
      for (size_t i = first; i < first + width; ++i)
        seeing |=
            (x[i] >= bound.lo.x) & (x[i] <= bound.hi.x) & (y[i] >= bound.lo.y) & (y[i] <= bound.hi.y) & (depth[i] >= d);
      if (seeing) return false;
    }
  return true;
}

}  // namespace tomales
