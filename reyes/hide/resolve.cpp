#include "reyes/hide/resolve.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "reyes/base/lent.h"
#include "reyes/hide/border_overlap.h"
#include "reyes/hide/cell_coverage.h"
#include "reyes/hide/depth_error.h"
#include "reyes/hide/facets.h"

namespace tomales {
namespace {

/// The part of a transparent layer in front of opaque surfaces, or the opaque surfaces of a pixel.
struct LayerInOrder {
  LayerExtent extent;
  uint32_t layer;
  int object;          ///< TransparentLayer::object
  float depth = 0;     ///< Range of depth keys within a cell of that object here.
  uint64_t twice = 0;  ///< Samples that a neighbour also covers.
  bool operator<(const LayerInOrder& o) const { return extent.nearest < o.extent.nearest; }
};

/// Memory of lists, which outlives a tile.
struct Scratch {
  std::vector<uint32_t> layersOfPixel, firstLayer;
  std::vector<LayerInOrder> ordered;
  std::vector<CellCoverage> coverages, opaque, sorted;
  std::vector<uint64_t> keys;
  PixelLayers layers;
  std::vector<Facet> facets;
  std::vector<Fragment> fragments;
};

class TileBuilder {
  static constexpr size_t kAhead = 24;  ///< Layers that are prefetched ahead of the current one.

 public:
  TileBuilder(const Scene& scene, const Camera& camera, const GridTable& grids, SampleBuffer& samples, Scratch& scratch)
      : camera_(camera),
        grids_(grids),
        samples_(samples),
        scratch_(scratch),
        coverages_(scratch.coverages),
        facets_(scene, camera, grids, samples, tile_) {}

  DeepTile build(std::span<const uint32_t> unseen, HideDiagnostics* diagnostics) {
    tile_.rect = samples_.rect;
    const size_t count = samples_.far.size();
    tile_.pixels.reserve(count);
    sortLayers(count);
    {
      const Lent fragments(tile_.fragments, scratch_.fragments);
      for (size_t first = 0; first < count; first += kRankedTogether)
        addPixels(first, std::min(first + kRankedTogether, count));
    }
    facets_.make(unseen, diagnostics);
    tile_.shrink();
    return std::move(tile_);
  }

 private:
  /// Sorts by pixel, by counting.
  void sortLayers(size_t pixels) {
    const TransparentLayers& layers = samples_.layers;
    const auto words = static_cast<uint32_t>(layers.wordsOfPixel());
    std::vector<uint32_t>& first = scratch_.firstLayer;
    first.assign(pixels + 1, 0);
    const auto count = static_cast<uint32_t>(layers.count());
    for (uint32_t i = 0; i < count; ++i) ++first[layers.layer(i).word / words + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    scratch_.layersOfPixel.resize(count);
    for (uint32_t i = 0; i < count; ++i) scratch_.layersOfPixel[first[layers.layer(i).word / words]++] = i;
    for (size_t p = pixels; p > 0; --p) first[p] = first[p - 1];
    first[0] = 0;
  }

  bool hasLayers(size_t pixel) const { return scratch_.firstLayer[pixel] < scratch_.firstLayer[pixel + 1]; }

  void addPixels(size_t begin, size_t end) {
    uint32_t opaque[kRankedTogether];
    size_t count = 0;
    for (size_t pixel = begin; pixel < end; ++pixel) {
      opaque[count] = static_cast<uint32_t>(pixel);
      count += !hasLayers(pixel);
    }
    RankedCoverages seen[kRankedTogether];
    rankOpaque(samples_, {opaque, count}, seen);
    const RankedCoverages* next = seen;
    for (size_t pixel = begin; pixel < end; ++pixel) {
      const auto first = static_cast<uint32_t>(tile_.fragments.size());
      if (hasLayers(pixel))
        addLayers(pixel);
      else
        addOpaque(pixel, *next++);
      tile_.pixels.push_back({first, static_cast<uint32_t>(tile_.fragments.size()) - first});
    }
  }

  void addOpaque(size_t pixel, const RankedCoverages& seen) {
    if (addRanked(pixel, seen, 0)) return;
    coverages_.clear();
    collectOpaque(samples_, pixel, coverages_);
    addCoverages(pixel, false);
  }

  /// Adds fragments that are already in order, which is the most frequent case. Returns false, and adds nothing, if
  /// there are too many surfaces.
  bool addRanked(size_t pixel, const RankedCoverages& seen, uint32_t word) {
    for (int i = 0; i < seen.count; ++i)
      addFragment(pixel, seen.coverages[i].cell, seen.coverages[i].d, seen.coverages[i].samples, word);
    return seen.count >= 0;
  }
  bool addRanked(size_t pixel, uint32_t layer) {
    RankedCoverages seen;
    rankLayer(samples_.layers, layer, seen);
    return addRanked(pixel, seen,
                     static_cast<uint32_t>(samples_.layers.layer(layer).word % samples_.layers.wordsOfPixel()));
  }

  void addFragment(size_t pixel, uint32_t cell, float d, uint64_t samples, uint32_t word) {
    facets_.see(cell);
    // facets_ replaces the cell by its facet later.
    Fragment& f =
        tile_.fragments.emplace_back(Fragment{cell, camera_.zFromDepthKey(d), samples, static_cast<uint16_t>(word)});
    if (grids_.anySmooth() && grids_.of(cell).raster->smooth) setPosition(f, cell, pixel);
  }

  /// Adds the layers of a pixel. Layers that lie behind all previous ones are sorted separately.
  void addLayers(size_t pixel) {
    findLayers(pixel);
    const std::vector<LayerInOrder>& ordered = scratch_.ordered;
    for (size_t i = 0, end = 0; i < ordered.size(); i = end) {
      const bool alone = ordered[i].layer != TransparentLayers::kNone &&
                         (i + 1 == ordered.size() || ordered[i + 1].extent.nearest > ordered[i].extent.farthest);
      if (alone && addRanked(pixel, ordered[i].layer)) {
        end = i + 1;
        continue;
      }
      coverages_.clear();
      float far = -kInfinity;
      for (; end < ordered.size() && (end == i || ordered[end].extent.nearest <= far); ++end) {
        const LayerInOrder& current = ordered[end];
        far = std::max(far, current.extent.farthest);
        if (current.layer == TransparentLayers::kNone)
          coverages_.insert(coverages_.end(), scratch_.opaque.begin(), scratch_.opaque.end());
        else
          collectLayer(samples_.layers, current.layer, current.extent.farthest, coverages_);
      }
      addCoverages(pixel, end - i > 1);
    }
  }

  /// Finds the layers of a pixel, nearest first.
  void findLayers(size_t pixel) {
    std::vector<LayerInOrder>& ordered = scratch_.ordered;
    std::vector<CellCoverage>& opaque = scratch_.opaque;
    ordered.clear();
    opaque.clear();
    collectOpaque(samples_, pixel, opaque);
    if (!opaque.empty()) {
      const auto nearest = std::min_element(opaque.begin(), opaque.end(),
                                            [](const CellCoverage& a, const CellCoverage& b) { return a.d < b.d; });
      ordered.push_back({{nearest->d, kInfinity}, TransparentLayers::kNone, -1});
    }
    const std::vector<uint32_t>& order = scratch_.layersOfPixel;
    TransparentLayers& layers = samples_.layers;
    for (uint32_t k = scratch_.firstLayer[pixel]; k < scratch_.firstLayer[pixel + 1]; ++k) {
      // Layers of a pixel are scattered over the list, which is larger than a near cache.
      const uint32_t next = order[std::min(size_t{k} + kAhead, order.size() - 1)];
      __builtin_prefetch(layers.depths(next));
      __builtin_prefetch(layers.cells(next));
      __builtin_prefetch(&layers.layer(next));
      const LayerExtent extent = cullLayer(samples_, grids_, order[k]);
      if (layers.layer(order[k]).samples) ordered.push_back({extent, order[k], layers.layer(order[k]).object});
    }
    std::sort(ordered.begin(), ordered.end());
    dropOverlaps();
  }

  /// Removes samples that two neighbours show because they reach over a border.
  void dropOverlaps() {
    std::vector<LayerInOrder>& ordered = scratch_.ordered;
    TransparentLayers& layers = samples_.layers;
    const auto ends = [&](const TransparentLayer& f) {
      return std::popcount(f.samples) <
             std::min(64, samples_.sampleCount() - 64 * static_cast<int>(f.word % layers.wordsOfPixel()));
    };
    // The depth range in a cell is estimated from layers that fill a pixel, because a few samples do not show it.
    float most = 0;
    for (LayerInOrder& s : ordered) {
      if (s.object < 0) continue;
      s.depth = ends(layers.layer(s.layer)) ? depthRangeOfCell(layers, grids_, s.layer)
                                            : s.extent.farthest - s.extent.nearest;
      most = std::max(most, s.depth);
    }
    const auto reachOf = [](const LayerInOrder& a, float other) {
      return a.extent.farthest + 2 * (a.depth + other) + kJoinedDepthError * std::abs(a.extent.farthest);
    };
    for (size_t i = 0; i < ordered.size(); ++i) {
      LayerInOrder& a = ordered[i];
      if (a.object < 0) continue;
      const float reach = reachOf(a, most);
      for (size_t k = i + 1; k < ordered.size() && ordered[k].extent.nearest <= reach; ++k) {
        LayerInOrder& b = ordered[k];
        if (b.object != a.object || b.extent.nearest > reachOf(a, b.depth) ||
            (layers.layer(a.layer).samples & layers.layer(b.layer).samples) == 0)
          continue;
        const BorderOverlap twice = borderOverlap(samples_, grids_, camera_, a.layer, b.layer);
        a.twice |= twice.first;
        b.twice |= twice.second;
      }
    }
    for (const LayerInOrder& current : ordered)
      if (current.twice) layers.drop(current.layer, current.twice);
  }

  /// Adds the coverages; `overlapping` means that a sample may see several of them.
  void addCoverages(size_t pixel, bool overlapping) {
    // They are sorted by depth. Equal depths have an order that does not depend on the schedule of threads.
    const auto nearer = [this](const CellCoverage& a, const CellCoverage& b) {
      if (a.d != b.d) return a.d < b.d;
      if (a.cell != b.cell) return grids_.precedes(a.cell, b.cell);
      return a.word < b.word;
    };
    if (!sortByRank() && !sortByKey()) std::sort(coverages_.begin(), coverages_.end(), nearer);
    if (overlapping) scratch_.layers.order(coverages_, nearer);
    for (const CellCoverage& s : coverages_) addFragment(pixel, s.cell, s.d, s.samples, s.word);
  }

  /// Sorts a few coverages by depth without a branch on depths. Returns false, and does nothing, if they are many or
  /// depths are equal.
  bool sortByRank() {
    constexpr size_t kFew = 12;
    const size_t n = coverages_.size();
    if (n > kFew) return false;
    CellCoverage sorted[kFew];
    uint32_t taken = 0;
    for (size_t i = 0; i < n; ++i) {
      uint32_t rank = 0;
      for (size_t k = 0; k < n; ++k) rank += coverages_[k].d < coverages_[i].d;
      sorted[rank] = coverages_[i];
      taken |= 1U << rank;
    }
    if (taken != (1U << n) - 1) return false;
    std::copy_n(sorted, n, coverages_.begin());
    return true;
  }

  /// Sorts many coverages by depth as integers. Returns false, and does nothing, if depths are equal.
  bool sortByKey() {
    std::vector<uint64_t>& keys = scratch_.keys;
    keys.clear();
    for (uint32_t i = 0; i < coverages_.size(); ++i) {
      const uint32_t bits = std::bit_cast<uint32_t>(coverages_[i].d + 0.0f);  // -0 is 0
      const uint32_t ordered = bits >> 31 ? ~bits : bits | 0x80000000U;
      keys.push_back(uint64_t{ordered} << 32 | i);
    }
    std::sort(keys.begin(), keys.end());
    for (size_t i = 1; i < keys.size(); ++i)
      if (keys[i] >> 32 == keys[i - 1] >> 32) return false;
    scratch_.sorted.clear();
    for (const uint64_t key : keys) scratch_.sorted.push_back(coverages_[key & 0xffffffffU]);
    coverages_.swap(scratch_.sorted);
    return true;
  }

  void setPosition(Fragment& fragment, uint32_t cellNumber, size_t pixel) const {
    const GridTable::Entry& entry = grids_.of(cellNumber);
    const int cell = static_cast<int>(cellNumber - entry.firstCell);
    const size_t first = pixel * static_cast<size_t>(samples_.lanes) + size_t{64} * fragment.word;
    const bool blurred = entry.raster->blur != nullptr;
    // The corners of a still cell in focus are the same for all samples, so one query at their mean place suffices.
    vec2 places(0), positions(0);
    for (uint64_t left = fragment.samples; left != 0; left &= left - 1) {
      const SamplePoint sample = samplePoint(samples_, first + static_cast<size_t>(std::countr_zero(left)));
      places += sample.at;
      if (blurred) positions += glm::clamp(positionOnCell(entry, camera_, cell, sample), vec2(0), vec2(1));
    }
    const float share = 1 / static_cast<float>(std::popcount(fragment.samples));
    if (!blurred)
      positions = glm::clamp(positionOnCell(entry, camera_, cell, {places * share, 0, vec2(0)}), vec2(0), vec2(1));
    fragment.setPosition(blurred ? positions * share : positions);
  }

  const Camera& camera_;
  const GridTable& grids_;
  SampleBuffer& samples_;
  Scratch& scratch_;
  std::vector<CellCoverage>& coverages_;
  DeepTile tile_;
  FacetTable facets_;
};

}  // namespace

DeepTile resolveTile(const Scene& scene, const Camera& camera, const GridTable& grids, SampleBuffer& samples,
                     std::span<const uint32_t> unseen, HideDiagnostics* diagnostics) {
  static thread_local Scratch scratch;
  return TileBuilder(scene, camera, grids, samples, scratch).build(unseen, diagnostics);
}

}  // namespace tomales
