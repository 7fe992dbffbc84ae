// Tests micropolygons that stand still and are in focus against the samples of the pixels that they touch: kLanes
// samples of a pixel at a time. The file is compiled for several vector widths, and one is chosen when it is first
// called (docs/decisions/0011). The operations are the same in all of them, and none is fused, so the bits are the same
// too.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reyes/hide/raster_still.cpp"
#include "reyes/base/vector.h"  // Includes this file again for each target.

#include <bit>
#include <cstring>

#include "reyes/hide/lines_of_cell.h"
#include "reyes/hide/quad.h"
#include "reyes/hide/sample_cell.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

HWY_INLINE void loadCorners(float to[4][kLanes], const float* from, int row) {
  std::copy_n(from, kLanes, to[0]);
  std::copy_n(from + 1, kLanes, to[1]);
  std::copy_n(from + row, kLanes, to[2]);
  std::copy_n(from + row + 1, kLanes, to[3]);
}

HWY_INLINE void setLattice(const float from[4][kLanes], float origin, int32_t to[4][kLanes]) {
  const Floats zero = all(origin), scale = all(kLattice), far = all(65536.0f);
  for (int k = 0; k < 4; ++k)
    for (size_t g = 0; g < kLanes; g += hn::Lanes(kF)) {
      const Floats at = hn::Mul(hn::Sub(hn::Load(kF, from[k] + g), zero), scale);
      hn::Store(hn::ConvertTo(kI, hn::Min(hn::Max(at, hn::Neg(far)), far)), kI, to[k] + g);
    }
}

HWY_INLINE void setBounds(const float v[4][kLanes], float* lo, float* hi) {
  for (int i = 0; i < kLanes; ++i) {
    const float lo01 = v[0][i] < v[1][i] ? v[0][i] : v[1][i], lo23 = v[2][i] < v[3][i] ? v[2][i] : v[3][i];
    const float hi01 = v[0][i] < v[1][i] ? v[1][i] : v[0][i], hi23 = v[2][i] < v[3][i] ? v[3][i] : v[2][i];
    lo[i] = lo01 < lo23 ? lo01 : lo23;
    hi[i] = hi01 > hi23 ? hi01 : hi23;
  }
}

/// A cell may be seen outside of its corners up to a line at which it ends.
HWY_INLINE void growBounds(float* lo, float* hi, float by) {
  for (int i = 0; i < kLanes; ++i) lo[i] -= by, hi[i] += by;
}

/// Finds which of kLanes vertices of a grid begin a cell, and its number.
class CellNumbers {
 public:
  explicit CellNumbers(const Grid& g)
      : nu_(g.nu), nv_(g.nv), perRow_(1 / static_cast<float>(nu_ + 1)), perPiece_(1 / static_cast<float>(nv_ + 1)) {}

  HWY_INLINE uint64_t set(Corners& q, int first, int end) const {
    HWY_ALIGN int32_t begins[kLanes];
    for (int i = 0; i < kLanes; ++i) {
      // Adding a half keeps the quotients of whole numbers below 2^21 away from where rounding would matter.
      const int a = first + i, row = static_cast<int>((static_cast<float>(a) + 0.5f) * perRow_);
      const int piece = static_cast<int>((static_cast<float>(row) + 0.5f) * perPiece_), u = a - row * (nu_ + 1);
      q.cell[i] = row * nu_ + u;
      begins[i] = (u != nu_) & (row - piece * (nv_ + 1) != nv_) & (a < end);
    }
    uint64_t bits = 0;
    for (size_t g = 0; g < kLanes; g += hn::Lanes(kI))
      bits |= bitsOf(hn::RebindMask(kF, hn::Ne(hn::Load(kI, begins + g), hn::Zero(kI)))) << g;
    return bits;
  }

 private:
  int nu_, nv_;
  float perRow_, perPiece_;
};

/// Pixels of the bucket that bounds touch, the same as SampleBuffer::touched().
HWY_INLINE void setPixels(const float* lo, const float* hi, int first, int end, int32_t* from, int32_t* to) {
  const float origin = static_cast<float>(first), size = static_cast<float>(end - first);
  for (int i = 0; i < kLanes; ++i) {
    const float a = lo[i] - origin, b = hi[i] - origin;
    const int32_t x0 = static_cast<int32_t>((a < -1     ? -1
                                             : a > size ? size
                                                        : a) +
                                            1) -
                       1,
                  x1 = static_cast<int32_t>((b < -1     ? -1
                                             : b > size ? size
                                                        : b) +
                                            1);
    from[i] = first + (x0 < 0 ? 0 : x0);
    to[i] = x1 < end - first ? first + x1 : end;
  }
}

/// Sets corners, bounds and numbers of the cells from vertex `first` on. Returns which of them touch the bucket.
HWY_INLINE uint64_t setUp(Corners& q, const RasterGrid& r, const CellNumbers& numbers, int first, int end,
                          const PixelRect& bucket) {
  const int row = r.grid->nu + 1;
  loadCorners(q.x, r.x.data() + first, row);
  loadCorners(q.y, r.y.data() + first, row);
  setBounds(q.x, q.xMin, q.xMax);
  setBounds(q.y, q.yMin, q.yMax);
  if (!r.lines.empty()) growBounds(q.xMin, q.xMax, kLineReach_px), growBounds(q.yMin, q.yMax, kLineReach_px);
  const Floats left = all(static_cast<float>(bucket.x0)), right = all(static_cast<float>(bucket.x1));
  const Floats top = all(static_cast<float>(bucket.y0)), bottom = all(static_cast<float>(bucket.y1));
  uint64_t touching = 0;
  for (size_t g = 0; g < kLanes; g += hn::Lanes(kF)) {
    const Mask inX = hn::And(hn::Lt(hn::Load(kF, q.xMin + g), right), hn::Ge(hn::Load(kF, q.xMax + g), left));
    const Mask inY = hn::And(hn::Lt(hn::Load(kF, q.yMin + g), bottom), hn::Ge(hn::Load(kF, q.yMax + g), top));
    touching |= bitsOf(hn::And(inX, inY)) << g;
  }
  if (touching == 0) return 0;
  loadCorners(q.d, r.d.data() + first, row);
  setBounds(q.d, q.dMin, q.dMax);
  setPixels(q.xMin, q.xMax, bucket.x0, bucket.x1, q.x0, q.x1);
  setPixels(q.yMin, q.yMax, bucket.y0, bucket.y1, q.y0, q.y1);
  return touching & numbers.set(q, first, end);
}

bool endAtLines(const RasterGrid& r, const Corners& q, uint64_t cells) {
  for (; cells; cells &= cells - 1)
    if (LinesOfCell(r, q.cell[std::countr_zero(cells)]).any()) return true;
  return false;
}

void setLines(const RasterGrid&, const Corners&, uint64_t, Triangles<LatticeEdges>&) {}
/// Puts lines in the place of the edges of cells that end at them.
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

/// Are edges of some cells short enough for the lattice?
HWY_INLINE bool fitLattice(const RasterGrid& r, const Corners& q, uint64_t cells, const SampleBuffer& samples) {
  uint64_t large = 0;
  for (size_t g = 0; g < kLanes; g += hn::Lanes(kF)) {
    const Floats width = hn::Sub(hn::Load(kF, q.xMax + g), hn::Load(kF, q.xMin + g)),
                 height = hn::Sub(hn::Load(kF, q.yMax + g), hn::Load(kF, q.yMin + g));
    large |= bitsOf(hn::Gt(hn::Max(width, height), all(LatticeEdges::kMost_px))) << g;
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

/// A small cell covers few pixels, and branches on which ones would be mispredicted, so one list holds those of many
/// cells (docs/decisions/0102).
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
      sampleCells<LatticeEdges>(job, q, cells);
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
