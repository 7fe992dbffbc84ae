// Tests micropolygons that stand still and are in focus against the samples of the pixels that they touch: kLanes
// samples of a pixel at a time. The file is compiled for several vector widths, and one is chosen when it is first
// called (docs/decisions/0011). The operations are the same in all of them, and none is fused, so the bits are the same
// too.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reyes/hide/raster_still.cpp"
#include "reyes/base/vector.h"  // Includes this file again for each target.

#include <bit>
#include <cstring>

#include "reyes/hide/cell_setup.h"
#include "reyes/hide/lines_of_cell.h"
#include "reyes/hide/sample_cell.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

bool endAtLines(const RasterGrid& r, const Corners& q, uint64_t cells) {
  for (; cells; cells &= cells - 1)
    if (LinesOfCell(r, q.cell[std::countr_zero(cells)]).any()) return true;
  return false;
}

void setLines(const RasterGrid&, const Corners&, uint64_t, Triangles<SubpixelEdges>&) {}
/// Replaces edges of cells by the lines at which the cells end.
void setLines(const RasterGrid& r, const Corners& q, uint64_t cells, Triangles<FloatEdges>& t) {
  if (r.lines.empty()) return;
  for (; cells; cells &= cells - 1) {
    const int i = std::countr_zero(cells);
    const LinesOfCell lines(r, q.cell[i]);
    if (const BorderLine* l = lines.at(0)) t.ca.setLine(i, l->to, l->from, turnsLeft(q, i, 0, 1, 2));
    if (const BorderLine* l = lines.at(1)) t.bd.setLine(i, l->from, l->to, turnsLeft(q, i, 1, 3, 2));
    if (const BorderLine* l = lines.at(2)) t.ab.setLine(i, l->from, l->to, turnsLeft(q, i, 0, 1, 2));
    if (const BorderLine* l = lines.at(3)) t.dc.setLine(i, l->to, l->from, turnsLeft(q, i, 1, 3, 2));
  }
}

/// Tells whether edges of some cells are short enough for the lattice.
HWY_INLINE bool fitLattice(const RasterGrid& r, const Corners& q, uint64_t cells, const SampleBuffer& samples) {
  uint64_t large = 0;
  for (size_t g = 0; g < kLanes; g += hn::Lanes(kF)) {
    const Floats width = hn::Sub(hn::Load(kF, q.xMax + g), hn::Load(kF, q.xMin + g)),
                 height = hn::Sub(hn::Load(kF, q.yMax + g), hn::Load(kF, q.yMin + g));
    large |= bitsOf(hn::Gt(hn::Max(width, height), all(SubpixelEdges::kMost_px))) << g;
  }
  return samples.fitsLattice() && (large & cells) == 0 && (r.lines.empty() || !endAtLines(r, q, cells));
}

/// Lists pairs of a pixel and a cell to be tested, without pixels whose samples are all nearer. It takes as many cells
/// as make the list long enough.
size_t listPixelTests(SampleBuffer& out, const Corners& q, uint64_t& cells) {
  constexpr size_t kLong = 1024;
  const size_t width = static_cast<size_t>(out.rect.width());
  const float* far = out.far.data();
  size_t count = 0;
  for (; cells && count < kLong; cells &= cells - 1) {
    const int i = std::countr_zero(cells);
    const size_t columns = static_cast<size_t>(q.x1[i] - q.x0[i]), rows = static_cast<size_t>(q.y1[i] - q.y0[i]);
    if (out.pixelTests.size() < count + columns * rows) out.pixelTests.resize(2 * (count + columns * rows));
    PixelTest* pixelTests = out.pixelTests.data();
    size_t first = out.pixelIndex(q.x0[i], q.y0[i]);
    for (size_t y = 0; y < rows; ++y, first += width)
      for (size_t pixel = first; pixel < first + columns; ++pixel) {
        pixelTests[count] = {static_cast<uint32_t>(pixel), i};
        count += q.dMin[i] <= far[pixel];
      }
  }
  return count;
}

/// Tests cell by cell, so that the cell stays in registers for all of its pixels.
template <class Edges>
HWY_INLINE void runPixelTests(const RasterJob& job, const Corners& q, const Triangles<Edges>& triangles, size_t count) {
  SampleBuffer& out = job.out;
  const size_t lanes = static_cast<size_t>(out.lanes);
  const PixelTest* pixelTests = out.pixelTests.data();
  const bool whole = keepsAll(job);
  for (size_t k = 0; k < count;) {
    const int i = pixelTests[k].cell;
    const Kept kept = whole ? Kept::All : keptOf(job, q.cell[i]);
    const Quad<Edges> quad(q, triangles, i);
    const uint32_t cell = job.firstCell + static_cast<uint32_t>(q.cell[i]);
    do {
      const size_t pixel = pixelTests[k].pixel;
      for (size_t g = 0; g < lanes; g += hn::Lanes(kF)) depthTest(job, quad, pixel * lanes + g, cell, kept);
      out.nearer[pixel] = 1;
    } while (++k < count && pixelTests[k].cell == i);
  }
}

/// A small cell covers few pixels, and branches on which ones would be mispredicted. So one list holds the pixels of
/// many cells (docs/decisions/0102).
template <class Edges>
void depthTestCells(const RasterJob& job, const Corners& q, uint64_t cells) {
  const uint64_t all = cells;
  size_t count = listPixelTests(job.out, q, cells);
  if (count == 0 && cells == 0) return;
  Triangles<Edges> triangles;
  triangles.set(q, job.raster.facing);
  setLines(job.raster, q, all, triangles);
  for (; count > 0 || cells; count = listPixelTests(job.out, q, cells)) runPixelTests(job, q, triangles, count);
}

/// The version for transparent grids and for solids.
template <class Edges>
void layerCells(const RasterJob& job, const Corners& q, uint64_t cells) {
  const RasterGrid& r = job.raster;
  Triangles<Edges> triangles;
  triangles.set(q, r.facing);
  setLines(r, q, cells, triangles);
  for (uint64_t left = cells; left; left &= left - 1) {
    const int i = std::countr_zero(left);
    const Kept kept = keptOf(job, q.cell[i]);
    const uint32_t cell = job.firstCell + static_cast<uint32_t>(q.cell[i]);
    const PixelRect pixels{q.x0[i], q.y0[i], q.x1[i], q.y1[i]};
    const auto quad = [&] { return Quad<Edges>(q, triangles, i); };
    sampleCell<false>(job, pixels, r.inSolid ? r.dMin : q.dMin[i], cell, kept, quad);
  }
}

/// Removes the cells that are trimmed away.
HWY_INLINE uint64_t keptCells(const RasterJob& job, const Corners& q, uint64_t cells) {
  if (keepsAll(job)) return cells;
  for (uint64_t left = cells; left; left &= left - 1)
    if (keptOf(job, q.cell[std::countr_zero(left)]) == Kept::None) cells &= ~(left & (~left + 1));
  return cells;
}

template <class Edges>
void sampleCells(const RasterJob& job, const Corners& q, uint64_t cells) {
  if (job.raster.opaque && !job.raster.inSolid)
    depthTestCells<Edges>(job, q, cells);
  else
    layerCells<Edges>(job, q, cells);
}

/// Rasterises the micropolygons whose first vertices are `first` to `end` - 1.
void rasterizeRun(const RasterJob& job, int first, int end, Corners& q) {
  const CellNumbers numbers(*job.raster.grid);
  for (int k = first; k < end; k += kLanes) {
    const uint64_t cells = keptCells(job, q, setUp(q, job.raster, numbers, k, end, job.out.rect));
    if (cells == 0) continue;
    if (fitLattice(job.raster, q, cells, job.out)) {
      setLattice(q.x, job.out.origin.x, q.latticeX);
      setLattice(q.y, job.out.origin.y, q.latticeY);
      sampleCells<SubpixelEdges>(job, q, cells);
    } else {
      sampleCells<FloatEdges>(job, q, cells);
    }
  }
}

/// Pieces that only other buckets see, and those that are hidden here, are skipped.
void rasterize(const RasterJob& job) {
  const Grid& g = *job.raster.grid;
  const auto& pieces = job.raster.ofPiece;
  const int ofPiece = g.verticesOfPiece(), withoutCells = g.nu + 1;
  const vec2 lo(job.out.rect.x0, job.out.rect.y0), hi(job.out.rect.x1, job.out.rect.y1);
  const auto seen = [&](size_t p) {
    const RasterExtent& e = pieces[p];
    const bool touches =
        (e.bound.lo.x < hi.x) & (e.bound.hi.x >= lo.x) & (e.bound.lo.y < hi.y) & (e.bound.hi.y >= lo.y);
    return touches && !job.out.hides(e.bound, e.dMin);
  };
  Corners q;
  if (pieces.empty()) return rasterizeRun(job, 0, ofPiece - withoutCells, q);
  for (size_t p = 0; p < pieces.size(); ++p) {
    const size_t first = p;
    while (p < pieces.size() && seen(p)) ++p;
    if (p > first)
      rasterizeRun(job, static_cast<int>(first) * ofPiece, static_cast<int>(p) * ofPiece - withoutCells, q);
  }
}

/// Tests whether one of eight flags is set.
HWY_INLINE bool anyOfEight(const uint8_t* flags) {
  uint64_t eight;
  std::memcpy(&eight, flags, sizeof eight);
  return eight != 0;
}

void settlePixels(SampleBuffer& s, const PixelRect& pixels) {
  const size_t lanes = static_cast<size_t>(s.lanes);
  for (int y = pixels.y0; y < pixels.y1; ++y)
    for (int x = pixels.x0; x < pixels.x1;) {
      const size_t pixel = s.pixelIndex(x, y);
      // A bucket often sees little of the bound of a stack.
      if (x + 8 <= pixels.x1 && !anyOfEight(&s.nearer[pixel])) {
        x += 8;
        continue;
      }
      ++x;
      if (!s.nearer[pixel]) continue;
      Floats most = all(-kInfinity);
      for (size_t g = 0; g < lanes; g += hn::Lanes(kF))
        most = hn::Max(most, hn::Load(kF, s.depth.data() + pixel * lanes + g));
      s.far[pixel] = hn::GetLane(hn::MaxOfLanes(kF, most));
      s.nearer[pixel] = 0;
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tomales {
HWY_EXPORT(rasterize);
HWY_EXPORT(settlePixels);
void rasterizeStill(const RasterJob& job) { HWY_DYNAMIC_DISPATCH(rasterize)(job); }
void SampleBuffer::settle(const PixelRect& pixels) { HWY_DYNAMIC_DISPATCH(settlePixels)(*this, pixels); }
}  // namespace tomales
#endif
