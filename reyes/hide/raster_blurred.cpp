// Rasterises micropolygons that move or are out of focus: every sample meets the vertices where they are at its time,
// seen through its point of the lens. A box around many micropolygons, at that time and through that point, is no
// larger than for a still, sharp grid. So the samples of a bucket are tested against the box of the grid, of its
// quarters, and so on down to micropolygons, where few samples miss.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reyes/hide/raster_blurred.cpp"
#include "reyes/base/vector.h"  // Includes this file again for each target.

#include <bit>

#include "reyes/hide/blur_bounds.h"
#include "reyes/hide/blurred_quad.h"
#include "reyes/hide/sample_list.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

/// Part of the shutter between two motion keys.
struct Interval {
  float begin, end;
};

using Numbers = hn::Vec<decltype(kU)>;

template <class B>
HWY_INLINE SampleVector loadSamples(const SampleList& s, size_t i) {
  const auto at = [&](SampleList::Array a) { return hn::BitCast(kF, hn::LoadU(kU, s.array(a) + i)); };
  SampleVector v;
  v.x = at(SampleList::kX);
  v.y = at(SampleList::kY);
  v.t = B::kMoves ? at(SampleList::kT) : all(0);
  v.lensX = B::kDefocuses ? at(SampleList::kLensX) : all(0);
  v.lensY = B::kDefocuses ? at(SampleList::kLensY) : all(0);
  return v;
}

/// A BlurBox, ready to be tested.
template <class B>
struct Box {
  Floats x, y, d, xStep, yStep, dStep, xReach, yReach, xSlant, ySlant;

  Box(const BlurBox& b, const vec2& slant, float focus)
      : x(all(b.x)),
        y(all(b.y)),
        d(all(b.d - focus)),
        xStep(all(b.xStep)),
        yStep(all(b.yStep)),
        dStep(all(b.dStep)),
        xReach(all(b.xReach)),
        yReach(all(b.yReach)),
        xSlant(all(slant.x)),
        ySlant(all(slant.y)) {}

  HWY_INLINE Mask holds(const SampleVector& s) const {
    Floats cx = x, cy = y, cd = d;
    if constexpr (B::kMoves) {
      cx = hn::Add(cx, hn::Mul(xStep, s.t));
      cy = hn::Add(cy, hn::Mul(yStep, s.t));
      if constexpr (B::kDefocuses) cd = hn::Add(cd, hn::Mul(dStep, s.t));
    }
    if constexpr (B::kDefocuses) {
      cx = hn::Add(cx, hn::Mul(s.lensX, cd));
      cy = hn::Add(cy, hn::Mul(s.lensY, cd));
    }
    const Floats dx = hn::Sub(s.x, cx), dy = hn::Sub(s.y, cy);
    return hn::And(hn::Le(hn::Abs(hn::Add(dx, hn::Mul(xSlant, dy))), xReach),
                   hn::Le(hn::Abs(hn::Add(dy, hn::Mul(ySlant, dx))), yReach));
  }
};

/// Writes the lanes of a mask to the end of a list, and up to a vector beyond. Returns the new end.
template <class B>
HWY_INLINE uint32_t* keep(const SampleVector& s, Numbers lane, Mask mask, uint32_t* end, size_t stride) {
  const auto put = [&](SampleList::Array a, Numbers v) {
    hn::StoreU(hn::Compress(v, hn::RebindMask(kU, mask)), kU, end + a * stride);
  };
  put(SampleList::kX, hn::BitCast(kU, s.x)), put(SampleList::kY, hn::BitCast(kU, s.y));
  put(SampleList::kLane, lane);
  if constexpr (B::kMoves) put(SampleList::kT, hn::BitCast(kU, s.t));
  if constexpr (B::kDefocuses)
    put(SampleList::kLensX, hn::BitCast(kU, s.lensX)), put(SampleList::kLensY, hn::BitCast(kU, s.lensY));
  return end + hn::CountTrue(kF, mask);
}

/// Distributes the samples of a list among four boxes, to the list of each box that contains them. One loop for all
/// four has a single mispredicted end, and reads no list that has just been written.
template <class B>
HWY_INLINE void cullSamples(const Box<B>& a, const Box<B>& b, const Box<B>& c, const Box<B>& d, const SampleList& from,
                            SampleList (&to)[4]) {
  const size_t width = hn::Lanes(kF), stride = to[0].stride;
  uint32_t *endA = to[0].first, *endB = to[1].first, *endC = to[2].first, *endD = to[3].first;
  for (size_t i = 0; i < from.count; i += width) {
    const SampleVector s = loadSamples<B>(from, i);
    const Numbers lane = hn::LoadU(kU, from.array(SampleList::kLane) + i);
    const Mask on = hn::FirstN(kF, from.count - i);
    endA = keep<B>(s, lane, hn::And(a.holds(s), on), endA, stride);
    endB = keep<B>(s, lane, hn::And(b.holds(s), on), endB, stride);
    endC = keep<B>(s, lane, hn::And(c.holds(s), on), endC, stride);
    endD = keep<B>(s, lane, hn::And(d.holds(s), on), endD, stride);
  }
  to[0].count = static_cast<size_t>(endA - to[0].first);
  to[1].count = static_cast<size_t>(endB - to[1].first);
  to[2].count = static_cast<size_t>(endC - to[2].first);
  to[3].count = static_cast<size_t>(endD - to[3].first);
}

/// Collects the samples of the bucket inside a box, whose time is in the segment and that see nothing nearer yet.
template <class B>
HWY_INLINE void cullBucketSamples(const SampleBuffer& out, const PixelRect& pixels, const Interval& when,
                                  const Box<B>& box, float dMin, SampleList& to) {
  const size_t width = hn::Lanes(kF), lanes = static_cast<size_t>(out.lanes);
  const Numbers first = hn::Iota(kU, 0);
  const Floats begin = all(when.begin), end = all(when.end), inverse = all(1.0f / (when.end - when.begin));
  uint32_t* listEnd = to.first;
  for (int y = pixels.y0; y < pixels.y1; ++y)
    for (size_t pixel = out.pixelIndex(pixels.x0, y), last = pixel + static_cast<size_t>(pixels.width()); pixel < last;
         ++pixel) {
      if (out.far[pixel] < dMin) continue;
      for (size_t i = pixel * lanes; i < (pixel + 1) * lanes; i += width) {
        const Mask open = hn::Ge(hn::Load(kF, out.depth.data() + i), all(dMin));
        SampleVector s;
        s.x = hn::Load(kF, out.x.data() + i);
        s.y = hn::Load(kF, out.y.data() + i);
        const Floats time = hn::Load(kF, out.time.data() + i);
        s.t = hn::Mul(hn::Sub(time, begin), inverse);
        s.lensX = hn::Load(kF, out.lensX.data() + i);
        s.lensY = hn::Load(kF, out.lensY.data() + i);
        Mask in = hn::And(open, box.holds(s));
        if constexpr (B::kMoves) in = hn::And(in, hn::And(hn::Ge(time, begin), hn::Lt(time, end)));
        if (!hn::AllFalse(kF, in))
          listEnd = keep<B>(s, hn::Add(first, hn::Set(kU, static_cast<uint32_t>(i))), in, listEnd, to.stride);
      }
    }
  to.count = static_cast<size_t>(listEnd - to.first);
}

/// Descends the boxes of one grid between two motion keys.
template <class B>
class Descent {
 public:
  Descent(const RasterJob& job, int key)
      : job_(job),
        bounds_(*job.raster.blur),
        key_(key),
        segment_(bounds_.segments[static_cast<size_t>(key)]),
        focus_(job.camera.focusKey()) {}

  /// It works in bands of pixel rows, so that lists stay short in large buckets.
  void run(const Interval& when) {
    const PixelRect pixels = job_.out.touched(job_.raster.bound.lo, job_.raster.bound.hi);
    const int rowLanes = std::max(1, pixels.width() * job_.out.lanes), rows = std::max(1, kMostLanes / rowLanes);
    for (int y = pixels.y0; y < pixels.y1; y += rows)
      runBand(when, {pixels.x0, y, pixels.x1, std::min(y + rows, pixels.y1)});
  }

 private:
  static constexpr int kMostLanes = 1 << 16;

  void runBand(const Interval& when, const PixelRect& pixels) {
    const size_t top = bounds_.levels.size() - 1,
                 most = static_cast<size_t>(pixels.width() * pixels.height() * job_.out.lanes);
    const BlurBox& box = bounds_.box(key_, bounds_.levels[top], 0, 0);
    stack_ = &SampleListStack::ofThread(4 * bounds_.levels.size(), most);
    SampleList list = stack_->push(most);
    cullBucketSamples<B>(job_.out, pixels, when, Box<B>(box, segment_.slant, focus_),
                         job_.raster.inSolid ? job_.raster.dMin : segment_.dMin, list);
    descend(top, 0, 0, list);
    stack_->pop(most);
  }

  void descend(size_t level, int i, int j, const SampleList& samples) {
    if (samples.count == 0) return;
    if (level == 0) return meet(i, j, samples);
    const BlurBounds::Level& fine = bounds_.levels[level - 1];
    if (level > 1) fetch(bounds_.levels[level - 2], 4 * i, 4 * j);
    const int x0 = 2 * i, y0 = 2 * j, x1 = std::min(x0 + 1, fine.columns - 1), y1 = std::min(y0 + 1, fine.rows - 1);
    const auto boxAt = [&](int x, int y) { return Box<B>(bounds_.box(key_, fine, x, y), segment_.slant, focus_); };
    SampleList quarters[4];
    for (SampleList& q : quarters) q = stack_->push(samples.count);
    cullSamples<B>(boxAt(x0, y0), boxAt(x1, y0), boxAt(x0, y1), boxAt(x1, y1), samples, quarters);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) descend(level - 1, x, y, quarters[2 * (y - y0) + x - x0]);
    stack_->pop(samples.count, 4);
  }

  /// Prefetches boxes that are tested next, which are not in the cache if another bucket tested them last.
  void fetch(const BlurBounds::Level& level, int i, int j) const {
    for (int y = j; y < std::min(j + 4, level.rows); ++y) {
      const BlurBox* box = &bounds_.box(key_, level, i, y);
      __builtin_prefetch(box);
      __builtin_prefetch(box + 2);
    }
  }

  void meet(int i, int j, const SampleList& samples) {
    const Grid& g = *job_.raster.grid;
    const int a = j * (g.nu + 1) + i;
    const Kept kept = keptOf(job_, j * g.nu + i);
    if (kept == Kept::None) return;
    const bool opaque = job_.raster.opaque && !job_.raster.inSolid;
    const BlurredQuad<B> quad(job_.raster, key_, a);
    const uint32_t cell = job_.firstCell + static_cast<uint32_t>(j * g.nu + i);
    const uint32_t* lanes = samples.array(SampleList::kLane);
    for (size_t k = 0; k < samples.count; k += hn::Lanes(kF)) {
      Floats depth;
      const Mask in = hn::And(covers(quad, loadSamples<B>(samples, k), all(focus_), job_.raster.facing, depth),
                              hn::FirstN(kF, samples.count - k));
      HWY_ALIGN float depths[kLanes];
      hn::Store(depth, kF, depths);
      if (opaque && kept == Kept::All) {
        giveOpaque(lanes + k, depths, bitsOf(in), cell);
        continue;
      }
      for (uint64_t left = bitsOf(in); left; left &= left - 1) {
        const size_t s = static_cast<size_t>(std::countr_zero(left));
        if (kept == Kept::All || keepsSample(job_, cell, lanes[k + s])) give(lanes[k + s], depths[s], cell);
      }
    }
    job_.out.layersOf(job_.raster).flush();
  }

  void give(uint32_t lane, float depth, uint32_t cell) {
    SampleBuffer& out = job_.out;
    float& before = out.depth[lane];
    if (depth > before && !job_.raster.inSolid) return;
    const uint32_t pixel = out.pixelOf[lane / kLanes];
    if (!job_.raster.opaque || job_.raster.inSolid) {
      const uint32_t s = lane - pixel * static_cast<uint32_t>(out.lanes);
      return out.layersOf(job_.raster).add(out.wordOf(pixel, s), s % 64, cell, depth);
    }
    if (depth == before) return settleTies(job_, lane, 1, cell);
    before = depth;
    out.cell[lane] = cell;
    out.nearer[pixel] = 1;
  }

  /// Does the same for opaque cells. Its pointers are locals, because writing a flag may alias any member, which would
  /// be read again.
  HWY_INLINE void giveOpaque(const uint32_t* lanes, const float* depths, uint64_t samples, uint32_t cell) {
    float* depth = job_.out.depth.data();
    uint32_t* cells = job_.out.cell.data();
    const uint32_t* pixelOf = job_.out.pixelOf.data();
    uint8_t* nearer = job_.out.nearer.data();
    for (; samples; samples &= samples - 1) {
      const size_t s = static_cast<size_t>(std::countr_zero(samples));
      const uint32_t lane = lanes[s];
      if (depths[s] == depth[lane]) settleTies(job_, lane, 1, cell);
      if (depths[s] >= depth[lane]) continue;
      depth[lane] = depths[s];
      cells[lane] = cell;
      nearer[pixelOf[lane / kLanes]] = 1;
    }
  }

  const RasterJob& job_;
  const BlurBounds& bounds_;
  const int key_;
  const BlurBounds::Segment& segment_;
  const float focus_;
  SampleListStack* stack_ = nullptr;
};

void rasterize(const RasterJob& job) {
  const bool moves = job.raster.grid->keyCount > 1;
  for (int key = 0; key + 1 < std::max(2, job.raster.grid->keyCount); ++key) {
    const size_t k = static_cast<size_t>(key);
    job.out.layersOf(job.raster).beginGrid();  // the layers of a cell belong to one interval, whatever hides it
    const Interval when = moves ? Interval{job.keyTimes[k], job.keyTimes[k + 1]} : Interval{0, 1};
    if (!moves)
      Descent<Blur<false, true>>(job, key).run(when);
    else if (job.raster.defocused)
      Descent<Blur<true, true>>(job, key).run(when);
    else
      Descent<Blur<true, false>>(job, key).run(when);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tomales {
HWY_EXPORT(rasterize);
void rasterizeBlurred(const RasterJob& job) { HWY_DYNAMIC_DISPATCH(rasterize)(job); }
}  // namespace tomales
#endif
