// Private to the hider: tests a cell of a still, sharp grid against samples, kLanes of a pixel at a time. It is
// included once for each vector width, after reyes/base/vector.h. A Shape has covers(samples, lane), the mask of
// samples inside it; depth(x, y, mask), their depth keys; and depthError(), the error of these keys.
#include "reyes/hide/raster.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

/// The samples of a vector that a cell covers, in front of the nearest opaque surface.
struct VisibleSamples {
  Mask mask;
  Floats depth, before;  ///< Depth keys of the cell, and of the nearest opaque surface so far.
};

/// Returns the samples that trim curves and clipping keep.
inline Mask keptOfMask(const RasterJob& job, uint32_t cell, size_t lane, Mask samples) {
  const uint64_t left = keptLanes(job, cell, lane, bitsOf(samples));
  return hn::LoadMaskBits(kF, reinterpret_cast<const uint8_t*>(&left));
}

template <class Shape>
HWY_INLINE VisibleSamples visibleSamples(const RasterJob& job, const Shape& shape, size_t lane, uint32_t cell,
                                         Kept kept) {
  const SampleBuffer& out = job.out;
  const auto in = shape.covers(out, lane);
  VisibleSamples r{in.mask, all(0.0f), all(0.0f)};
  if (hn::AllFalse(kF, in.mask)) return r;
  r.depth = shape.depth(hn::Load(kF, out.x.data() + lane), hn::Load(kF, out.y.data() + lane), in);
  r.before = hn::Load(kF, out.depth.data() + lane);
  // All surfaces of a solid are needed to resolve it; padding lanes never count.
  const Mask reaches = job.raster.inSolid ? hn::Gt(r.before, all(-kInfinity)) : hn::Le(r.depth, r.before);
  r.mask = hn::And(in.mask, reaches);
  if (HWY_UNLIKELY(kept == Kept::Part)) r.mask = keptOfMask(job, cell, lane, r.mask);
  return r;
}

/// The depth test of an opaque cell: gives it the samples from `lane` on that it covers in front of what they saw so
/// far. There is no branch for samples outside of the cell, because it would be mispredicted.
template <class Shape>
HWY_INLINE void depthTest(const RasterJob& job, const Shape& shape, size_t lane, uint32_t cell, Kept kept) {
  SampleBuffer& out = job.out;
  const auto in = shape.covers(out, lane);
  const Floats depth = shape.depth(hn::Load(kF, out.x.data() + lane), hn::Load(kF, out.y.data() + lane), in);
  const Floats before = hn::Load(kF, out.depth.data() + lane);
  Mask reached = hn::And(in.mask, hn::Le(depth, before));
  if (HWY_UNLIKELY(kept == Kept::Part)) reached = keptOfMask(job, cell, lane, reached);
  const Mask tight = hn::And(reached, hn::Lt(hn::Sub(before, depth), all(shape.depthError())));
  if (HWY_UNLIKELY(!hn::AllFalse(kF, tight))) {
    noteDepthConflict(job, lane, bitsOf(tight), shape.depthError());
    if (const Mask ties = hn::And(reached, hn::Eq(depth, before)); !hn::AllFalse(kF, ties))
      settleTies(job, lane, bitsOf(ties), cell);
    reached = hn::And(reached, hn::Lt(depth, before));
  }
  uint32_t* cells = out.cell.data() + lane;
  // Whole vectors are stored: the next cell reads them back, and would have to wait for a masked store.
  hn::Store(hn::IfThenElse(reached, depth, before), kF, out.depth.data() + lane);
  hn::Store(hn::IfThenElse(hn::RebindMask(kU, reached), hn::Set(kU, cell), hn::Load(kU, cells)), kU, cells);
}

/// Writes the samples that a cell covers to a vector of a transparent layer. Others keep their values, or become empty
/// in a new layer.
HWY_INLINE void write(TransparentLayers& layers, uint32_t layer, bool fresh, size_t first, Mask on, Floats depth,
                      uint32_t cell) {
  float* depths = layers.depths(layer) + first;
  uint32_t* cells = layers.cells(layer) + first;
  Floats otherDepths = all(TransparentLayers::kUncovered_d);
  auto otherCells = hn::Set(kU, kNoCell);
  if (!fresh) {
    otherDepths = hn::Load(kF, depths);
    otherCells = hn::Load(kU, cells);
  }
  hn::Store(hn::IfThenElse(on, depth, otherDepths), kF, depths);
  hn::Store(hn::IfThenElse(hn::RebindMask(kU, on), hn::Set(kU, cell), otherCells), kU, cells);
}

/// Adds the samples of a pixel that a transparent cell covers in front of opaque surfaces to a transparent layer.
template <class Shape>
HWY_INLINE void addToLayer(const RasterJob& job, const Shape& shape, size_t pixel, uint32_t cell, Kept kept) {
  TransparentLayers& layers = job.out.layersOf(job.raster);
  const size_t lanes = static_cast<size_t>(job.out.lanes), first = pixel * lanes;
  if (lanes == hn::Lanes(kF)) {  // Everything can stay in registers.
    const VisibleSamples r = visibleSamples(job, shape, first, cell, kept);
    const uint64_t samples = bitsOf(r.mask);
    if (samples == 0) return;
    const uint32_t to = layers.take(static_cast<uint32_t>(pixel), samples);
    return write(layers, to, layers.layer(to).samples == samples, 0, r.mask, r.depth, cell);
  }
  for (size_t word = 0; word < layers.wordsOfPixel(); ++word) {
    HWY_ALIGN float depths[64];
    uint64_t samples = 0;
    for (size_t g = 0, end = std::min(layers.width(), lanes - 64 * word); g < end; g += hn::Lanes(kF)) {
      const VisibleSamples r = visibleSamples(job, shape, first + 64 * word + g, cell, kept);
      hn::Store(r.depth, kF, depths + g);
      samples |= bitsOf(r.mask) << g;
    }
    if (samples == 0) continue;
    const uint32_t to = layers.take(static_cast<uint32_t>(pixel * layers.wordsOfPixel() + word), samples);
    const bool fresh = layers.layer(to).samples == samples;
    for (size_t g = 0; g < layers.width(); g += hn::Lanes(kF)) {
      const uint64_t here = samples >> g;
      write(layers, to, fresh, g, hn::LoadMaskBits(kF, reinterpret_cast<const uint8_t*>(&here)),
            hn::Load(kF, depths + g), cell);
    }
  }
}

/// Tests the samples of the pixels that a cell may touch. make() returns its shape; it is called only if the cell is
/// not hidden.
template <bool kOpaque, class Make>
HWY_INLINE void sampleCell(const RasterJob& job, const PixelRect& pixels, float dMin, uint32_t cell, Kept kept,
                           const Make& make) {
  SampleBuffer& out = job.out;
  const size_t lanes = static_cast<size_t>(out.lanes);
  if (out.hides(pixels, dMin)) return;
  if constexpr (!kOpaque) {
    TransparentLayers& layers = out.layersOf(job.raster);
    layers.makeRoom(static_cast<size_t>(pixels.width()) * static_cast<size_t>(pixels.height()) * layers.wordsOfPixel());
  }
  const auto shape = make();
  for (int y = pixels.y0; y < pixels.y1; ++y)
    for (int x = pixels.x0; x < pixels.x1; ++x) {
      const size_t pixel = out.pixelIndex(x, y);
      if (dMin > out.far[pixel]) continue;
      if constexpr (kOpaque) {
        for (size_t g = 0; g < lanes; g += hn::Lanes(kF)) depthTest(job, shape, pixel * lanes + g, cell, kept);
        out.nearer[pixel] = 1;
      } else {
        addToLayer(job, shape, pixel, cell, kept);
      }
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();
