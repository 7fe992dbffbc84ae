// Samples that a cell of a still, sharp grid covers, kLanes of a pixel at a time. Private to the hider; included once for each vector width, after
// reyes/base/vector.h. A Shape has covers(x, y, depth): which of some samples lie in it, and their depth keys; and vague(): how far those
// may be off.
#include "reyes/hide/raster.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

/// A vector of samples that a cell covers, no farther than what is opaque there.
struct Reach {
  Mask mask;
  Floats depth, before;  ///< Depth keys of the cell, and of what was nearest.
};

template <class Shape>
HWY_INLINE Reach reachOf(const RasterJob& job, const Shape& shape, size_t lane, uint32_t cell, Kept kept) {
  const SampleBuffer& out = job.out;
  Reach r;
  const Mask in = shape.covers(hn::Load(kF, out.x.data() + lane), hn::Load(kF, out.y.data() + lane), r.depth);
  r.before = hn::Load(kF, out.depth.data() + lane);
  // A solid is decided by all of it; padding still covers nothing.
  const Mask reaches = job.raster.inSolid ? hn::Gt(r.before, all(-kInfinity)) : hn::Le(r.depth, r.before);
  r.mask = hn::And(in, reaches);
  if (HWY_UNLIKELY(kept == Kept::Part) && !hn::AllFalse(kF, r.mask)) {
    const uint64_t left = keptLanes(job, cell, lane, bitsOf(r.mask));
    r.mask = hn::LoadMaskBits(kF, reinterpret_cast<const uint8_t*>(&left));
  }
  return r;
}

/// Gives the samples from `lane` on to an opaque cell that covers them nearer than what they had.
template <class Shape>
HWY_INLINE bool claim(const RasterJob& job, const Shape& shape, size_t lane, uint32_t cell, Kept kept) {
  SampleBuffer& out = job.out;
  const Reach r = reachOf(job, shape, lane, cell, kept);
  if (hn::AllFalse(kF, r.mask)) return false;
  const Mask tight = hn::And(r.mask, hn::Lt(hn::Sub(r.before, r.depth), all(shape.vague())));
  if (HWY_UNLIKELY(!hn::AllFalse(kF, tight))) {
    noteContest(job, lane, bitsOf(tight));
    if (const Mask ties = hn::And(r.mask, hn::Eq(r.depth, r.before)); !hn::AllFalse(kF, ties)) settleTies(job, lane, bitsOf(ties), cell);
  }
  const Mask won = hn::And(r.mask, hn::Lt(r.depth, r.before));
  uint32_t* cells = out.cell.data() + lane;
  // Whole vectors: the next cell reads them back, and could not from a masked store that is still on its way.
  hn::Store(hn::IfThenElse(won, r.depth, r.before), kF, out.depth.data() + lane);
  hn::Store(hn::IfThenElse(hn::RebindMask(kU, won), hn::Set(kU, cell), hn::Load(kU, cells)), kU, cells);
  return true;
}

/// Notes which samples of a pixel a transparent cell covers in front of what is opaque.
template <class Shape>
HWY_INLINE void film(const RasterJob& job, const Shape& shape, size_t pixel, uint32_t cell, Kept kept) {
  SampleBuffer& out = job.out;
  Films& films = out.filmsOf(job.raster);
  const size_t first = pixel * static_cast<size_t>(out.lanes), lanes = static_cast<size_t>(out.lanes);
  for (size_t g = 0; g < lanes; g += hn::Lanes(kF)) {
    const Reach r = reachOf(job, shape, first + g, cell, kept);
    if (hn::AllFalse(kF, r.mask)) continue;
    hn::StoreU(hn::Compress(r.depth, r.mask), kF, films.next());
    const float nearest = hn::GetLane(hn::MinOfLanes(kF, hn::IfThenElse(r.mask, r.depth, all(kInfinity))));
    const float farthest = hn::GetLane(hn::MaxOfLanes(kF, hn::IfThenElse(r.mask, r.depth, all(-kInfinity))));
    films.add(static_cast<uint32_t>(pixel), cell, static_cast<uint32_t>(g / 64), bitsOf(r.mask) << (g % 64), nearest, farthest);
  }
}

/// Asks the samples of the pixels that a cell may touch. make(): its shape, once it is known that not everything hides it.
template <bool kOpaque, class Make>
HWY_INLINE void sampleCell(const RasterJob& job, const PixelRect& pixels, float dMin, uint32_t cell, Kept kept, const Make& make) {
  SampleBuffer& out = job.out;
  const size_t lanes = static_cast<size_t>(out.lanes);
  if (out.hides(pixels, dMin)) return;
  const auto shape = make();
  for (int y = pixels.y0; y < pixels.y1; ++y)
    for (int x = pixels.x0; x < pixels.x1; ++x) {
      const size_t pixel = out.pixelIndex(x, y);
      if (dMin > out.far[pixel]) continue;
      if constexpr (kOpaque) {
        bool changed = false;
        for (size_t g = 0; g < lanes; g += hn::Lanes(kF)) changed |= claim(job, shape, pixel * lanes + g, cell, kept);
        out.nearer[pixel] |= static_cast<uint8_t>(changed);
      } else {
        film(job, shape, pixel, cell, kept);
      }
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();
