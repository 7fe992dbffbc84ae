#include "reyes/hide/border_overlap.h"

#include <bit>

#include "reyes/hide/depth_error.h"
#include "reyes/hide/gathered.h"

namespace tomales {
namespace {

/// Returns the range of the depth keys of the cell that begins at vertex a.
float extentOf(const RasterGrid& raster, int a) {
  const float* d = raster.d.data() + a;
  const int row = raster.grid->nu + 1;
  return std::max({d[0], d[1], d[row], d[row + 1]}) - std::min({d[0], d[1], d[row], d[row + 1]});
}

/// A cell of a still, sharp grid.
class BorderCell {
 public:
  BorderCell(const GridTable::Entry& entry, const Camera& camera, uint32_t number)
      : raster_(*entry.raster),
        grid_(entry.grid()),
        camera_(camera),
        a_(firstVertex(grid_, static_cast<int>(number - entry.firstCell))) {
    const int cell = static_cast<int>(number - entry.firstCell), inPiece = grid_.cellInPiece(cell);
    const int i = inPiece % grid_.nu, j = inPiece / grid_.nu;
    const int at =
        (i == 0) * kEdgeU0 | (i == grid_.nu - 1) * kEdgeU1 | (j == 0) * kEdgeV0 | (j == grid_.nv - 1) * kEdgeV1;
    joined_ = raster_.reaching.empty() ? 0 : at & raster_.reaching[static_cast<size_t>(grid_.pieceOfCell(cell))];
  }

  /// Tells whether the cell lies at a border that joins a neighbour.
  bool joins() const { return joined_ != 0; }
  /// Tells whether a point of the raster is beyond such a border of the cell as it was before it was pushed out.
  bool reachesTo(const vec2& at) const {
    const int b = a_ + 1, c = a_ + grid_.nu + 1, d = c + 1;
    return beyond(kEdgeU0, a_, c, b, at) || beyond(kEdgeU1, b, d, a_, at) || beyond(kEdgeV0, a_, b, c, at) ||
           beyond(kEdgeV1, c, d, a_, at);
  }
  float extent() const { return extentOf(raster_, a_); }

 private:
  vec2 corner(int vertex) const { return camera_.raster(grid_.position(0, vertex)); }
  /// A point on the border belongs to the side to which raster.h moves samples.
  bool beyond(PatchEdge edge, int from, int to, int inside, const vec2& at) const {
    if (!(joined_ & edge)) return false;
    const vec2 p = corner(from), along = corner(to) - p, in = corner(inside) - p, here = at - p;
    float side = along.x * here.y - along.y * here.x;
    if (side == 0) side = along.x != 0 ? -along.x : -along.y;
    return (along.x * in.y - along.y * in.x) * side < 0;
  }

  const RasterGrid& raster_;
  const Grid& grid_;
  const Camera& camera_;
  int a_, joined_;
};

}  // namespace

float depthRangeOfCell(const TransparentLayers& layers, const GridTable& grids, size_t layer) {
  const uint32_t cell = layers.cells(layer)[std::countr_zero(layers.layer(layer).samples)];
  const GridTable::Entry& entry = grids.of(cell);
  return extentOf(*entry.raster, firstVertex(entry.grid(), static_cast<int>(cell - entry.firstCell)));
}

BorderOverlap borderOverlap(const SampleBuffer& samples, const GridTable& grids, const Camera& camera, size_t layer,
                            size_t other) {
  const TransparentLayers& layers = samples.layers;
  const uint64_t common = layers.layer(layer).samples & layers.layer(other).samples;
  BorderOverlap out;
  if (common == 0 || layers.layer(layer).word != layers.layer(other).word) return out;
  const uint32_t *cells = layers.cells(layer), *otherCells = layers.cells(other);
  const GridTable::Entry &entry = grids.of(cells[std::countr_zero(common)]),
                         &otherEntry = grids.of(otherCells[std::countr_zero(common)]);
  const size_t words = layers.wordsOfPixel(), word = layers.layer(layer).word;
  const size_t first = word / words * static_cast<size_t>(samples.lanes) + 64 * (word % words);
  for (uint64_t left = common; left; left &= left - 1) {
    const auto s = static_cast<size_t>(std::countr_zero(left));
    const BorderCell mine(entry, camera, cells[s]), theirs(otherEntry, camera, otherCells[s]);
    if (!mine.joins() || !theirs.joins()) continue;
    const float d = layers.depths(layer)[s], otherD = layers.depths(other)[s];
    if (std::abs(d - otherD) > mine.extent() + theirs.extent() + kJoinedDepthError * std::abs(d)) continue;
    const vec2 at(samples.x[first + s], samples.y[first + s]);
    const bool reaches = mine.reachesTo(at), otherReaches = theirs.reachesTo(at);
    // If both layers reach over the border, the nearer one keeps the sample.
    const bool nearer = d < otherD || (d == otherD && grids.precedes(cells[s], otherCells[s]));
    const uint64_t sample = left & (~left + 1);
    if (reaches && !(otherReaches && nearer)) out.first |= sample;
    if (otherReaches && !(reaches && !nearer)) out.second |= sample;
  }
  return out;
}

}  // namespace tomales
