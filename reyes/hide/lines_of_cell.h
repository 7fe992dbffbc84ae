// Private to the hider: the lines that replace edges of a cell (RasterGrid::lines).
#pragma once
#include "reyes/hide.h"

namespace tomales {

/// The lines at which a cell ends, in the order of PatchEdge. Pre: the grid has lines.
class LinesOfCell {
 public:
  LinesOfCell(const RasterGrid& r, int cell) {
    const Grid& g = *r.grid;
    const int inPiece = g.cellInPiece(cell), i = inPiece % g.nu, j = inPiece / g.nu;
    lines_ = &r.lines[4 * static_cast<size_t>(g.pieceOfCell(cell))];
    const bool at[4] = {i == 0, i == g.nu - 1, j == 0, j == g.nv - 1};
    for (int e = 0; e < 4; ++e) ends_[e] = at[e] && !lines_[e].none();
  }
  const BorderLine* at(int edge) const { return ends_[edge] ? lines_ + edge : nullptr; }
  bool any() const { return ends_[0] || ends_[1] || ends_[2] || ends_[3]; }

 private:
  const BorderLine* lines_;
  bool ends_[4];
};

}  // namespace tomales
