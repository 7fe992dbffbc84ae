// Finds the samples of each cell in a list of lanes: it repeatedly takes all lanes that see the same cell as the first
// remaining lane.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reyes/hide/cell_coverage.cpp"
#include "reyes/base/vector.h"  // Includes this file again for each target.

#include <utility>

#include "reyes/hide/cell_coverage.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

/// Returns the mask of the lanes, up to 64, whose cell is `cell`, and sets the least of their depths.
HWY_INLINE uint64_t lanesOf(const uint32_t* cells, const float* depths, size_t lanes, uint32_t cell, float& nearest) {
  uint64_t bits = 0;
  Floats least = all(kInfinity);
  for (size_t g = 0; g < lanes; g += hn::Lanes(kF)) {
    const auto same = hn::RebindMask(kF, hn::Eq(hn::Load(kU, cells + g), hn::Set(kU, cell)));
    bits |= bitsOf(same) << g;
    least = hn::Min(least, hn::IfThenElse(same, hn::Load(kF, depths + g), all(kInfinity)));
  }
  nearest = hn::GetLane(hn::MinOfLanes(kF, least));
  return bits;
}

/// Collects the coverages of the lanes of the mask `left`.
HWY_INLINE void collect(const uint32_t* cells, const float* depths, size_t lanes, uint64_t left, uint32_t word,
                        float farthest, std::vector<CellCoverage>& coverages) {
  while (left) {
    CellCoverage& coverage =
        coverages.emplace_back();  // made in place: copying it would wait for its parts to be written
    coverage.cell = cells[std::countr_zero(left)];
    coverage.word = word;
    coverage.depths = depths;
    coverage.far = farthest;
    coverage.samples = lanesOf(cells, depths, lanes, coverage.cell, coverage.d);
    left &= ~coverage.samples;
  }
}

void opaque(const SampleBuffer& samples, size_t pixel, std::vector<CellCoverage>& coverages) {
  const size_t lanes = static_cast<size_t>(samples.lanes);
  for (size_t first = 0; first < lanes; first += 64) {
    const size_t here = std::min<size_t>(64, lanes - first);
    const uint32_t* cells = samples.cell.data() + pixel * lanes + first;
    const float* depths = samples.depth.data() + pixel * lanes + first;
    float nearest;
    uint64_t left = ~lanesOf(cells, depths, here, kNoCell, nearest);
    if (here < 64) left &= (uint64_t{1} << here) - 1;
    collect(cells, depths, here, left, static_cast<uint32_t>(first / 64), kInfinity, coverages);
  }
}

/// Up to 64 lanes, and a mask of those that are left.
struct Lanes {
  const uint32_t* cells;
  const float* depths;
  uint64_t left;
};

/// Sorts coverages without a branch on depths: the place of each is the number of nearer ones. nearest: their depths,
/// followed by infinity.
HWY_INLINE int order(const RankedCoverage* found, const float* nearest, int count, RankedCoverage* out) {
  uint64_t taken = 0;
  for (int i = 0; i < count; ++i) {
    size_t nearer = 0;
    for (size_t g = 0; g < kMostRanked; g += hn::Lanes(kF))
      nearer += hn::CountTrue(kF, hn::Lt(hn::Load(kF, nearest + g), all(found[i].d)));
    out[nearer] = found[i];
    taken |= uint64_t{1} << nearer;
  }
  return taken == (uint64_t{1} << count) - 1 ? count : -1;
}

/// Several pixels advance in turn, because the next cell of a pixel depends on all lanes of its last one; the processor
/// works on other pixels meanwhile.
HWY_INLINE void rank(Lanes* pixels, size_t count, size_t lanes, RankedCoverages* out) {
  RankedCoverage found[kRankedTogether][kMostRanked];
  HWY_ALIGN float nearest[kRankedTogether][kMostRanked];
  uint32_t active[kRankedTogether];
  size_t actives = 0;
  for (size_t p = 0; p < count; ++p) {
    std::fill_n(nearest[p], kMostRanked, kInfinity);
    out[p].count = 0;
    active[actives] = static_cast<uint32_t>(p);
    actives += pixels[p].left != 0;
  }
  for (int round = 0; round < kMostRanked && actives > 0; ++round) {
    const size_t before = std::exchange(actives, 0);
    for (size_t k = 0; k < before; ++k) {
      const uint32_t p = active[k];
      Lanes& pixel = pixels[p];
      RankedCoverage& s = found[p][round];
      s.cell = pixel.cells[std::countr_zero(pixel.left)];
      s.samples = lanesOf(pixel.cells, pixel.depths, lanes, s.cell, s.d);
      nearest[p][round] = s.d;
      pixel.left &= ~s.samples;
      out[p].count = round + 1;
      active[actives] = p;
      actives += pixel.left != 0;
    }
  }
  for (size_t p = 0; p < count; ++p)
    out[p].count = pixels[p].left ? -1 : order(found[p], nearest[p], out[p].count, out[p].coverages);
}

void opaqueRanked(const SampleBuffer& samples, std::span<const uint32_t> pixels, RankedCoverages* out) {
  const size_t lanes = static_cast<size_t>(samples.lanes);
  Lanes ofPixels[kRankedTogether];
  for (size_t k = 0; k < pixels.size(); ++k) {
    const size_t first = pixels[k] * lanes;
    ofPixels[k] = {samples.cell.data() + first, samples.depth.data() + first, 0};
    float unused;
    ofPixels[k].left = ~lanesOf(ofPixels[k].cells, ofPixels[k].depths, lanes, kNoCell, unused);
    if (lanes < 64) ofPixels[k].left &= (uint64_t{1} << lanes) - 1;
  }
  rank(ofPixels, pixels.size(), lanes, out);
}

void layerRanked(const TransparentLayers& layers, size_t layer, RankedCoverages* out) {
  Lanes ofPixel{layers.cells(layer), layers.depths(layer), layers.layer(layer).samples};
  rank(&ofPixel, 1, layers.width(), out);
}

LayerExtent cull(SampleBuffer& samples, const GridTable& grids, size_t index) {
  TransparentLayers& layers = samples.layers;
  TransparentLayer& layer = layers.layer(index);
  const size_t lanes = static_cast<size_t>(samples.lanes), words = layers.wordsOfPixel(), word = layer.word % words;
  const size_t first = layer.word / words * lanes + 64 * word, here = std::min(layers.width(), lanes - 64 * word);
  float* depths = layers.depths(index);
  uint32_t* cells = layers.cells(index);
  Floats nearest = all(kInfinity), farthest = all(-kInfinity);
  for (size_t g = 0; g < here; g += hn::Lanes(kF)) {
    const Floats d = hn::Load(kF, depths + g), before = hn::Load(kF, samples.depth.data() + first + g);
    Mask on = hn::RebindMask(kF, hn::Ne(hn::Load(kU, cells + g), hn::Set(kU, kNoCell)));
    Mask kept = hn::And(on, hn::Le(d, before));
    if (const Mask ties = hn::And(kept, hn::Eq(d, before)); HWY_UNLIKELY(!hn::AllFalse(kF, ties))) {
      uint64_t lost = 0;
      for (uint64_t left = bitsOf(ties); left; left &= left - 1) {
        const auto s = g + static_cast<size_t>(std::countr_zero(left));
        if (!grids.precedes(cells[s], samples.cell[first + s])) lost |= left & (~left + 1);
      }
      kept = hn::AndNot(hn::LoadMaskBits(kF, reinterpret_cast<const uint8_t*>(&lost)), kept);
    }
    nearest = hn::Min(nearest, hn::IfThenElse(kept, d, all(kInfinity)));
    farthest = hn::Max(farthest, hn::IfThenElse(kept, d, all(-kInfinity)));
    if (const uint64_t hidden = bitsOf(hn::AndNot(kept, on)); hidden) {
      layer.samples &= ~(hidden << g);
      hn::Store(hn::IfThenElse(hn::RebindMask(kU, kept), hn::Load(kU, cells + g), hn::Set(kU, kNoCell)), kU, cells + g);
    }
  }
  return {hn::GetLane(hn::MinOfLanes(kF, nearest)), hn::GetLane(hn::MaxOfLanes(kF, farthest))};
}

void ofLayer(const TransparentLayers& layers, size_t index, float farthest, std::vector<CellCoverage>& coverages) {
  const TransparentLayer& layer = layers.layer(index);
  const auto word = static_cast<uint32_t>(layer.word % layers.wordsOfPixel());
  collect(layers.cells(index), layers.depths(index), layers.width(), layer.samples, word, farthest, coverages);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tomales {
HWY_EXPORT(opaque);
HWY_EXPORT(opaqueRanked);
HWY_EXPORT(layerRanked);
HWY_EXPORT(cull);
HWY_EXPORT(ofLayer);
void collectOpaque(const SampleBuffer& samples, size_t pixel, std::vector<CellCoverage>& coverages) {
  HWY_DYNAMIC_DISPATCH(opaque)(samples, pixel, coverages);
}
void rankOpaque(const SampleBuffer& samples, std::span<const uint32_t> pixels, RankedCoverages* out) {
  if (samples.lanes <= 64)
    HWY_DYNAMIC_DISPATCH(opaqueRanked)(samples, pixels, out);
  else
    for (size_t k = 0; k < pixels.size(); ++k) out[k].count = -1;
}
void rankLayer(const TransparentLayers& layers, size_t layer, RankedCoverages& out) {
  HWY_DYNAMIC_DISPATCH(layerRanked)(layers, layer, &out);
}
LayerExtent cullLayer(SampleBuffer& samples, const GridTable& grids, size_t layer) {
  return HWY_DYNAMIC_DISPATCH(cull)(samples, grids, layer);
}
void collectLayer(const TransparentLayers& layers, size_t layer, float farthest, std::vector<CellCoverage>& coverages) {
  HWY_DYNAMIC_DISPATCH(ofLayer)(layers, layer, farthest, coverages);
}
}  // namespace tomales
#endif
