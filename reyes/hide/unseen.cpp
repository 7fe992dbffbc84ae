#include "reyes/hide/unseen.h"

#include "reyes/hide/gathered.h"
#include "reyes/prim.h"

namespace tomales {
namespace {

bool isKept(const RasterGrid& raster, int cell) {
  const Grid& g = *raster.grid;
  const Kept kept = g.kept.empty() ? Kept::All : g.kept[static_cast<size_t>(cell)];
  if (kept != Kept::Part || !raster.trim) return kept != Kept::None;
  const vec2 middle = g.onPatch(cell, vec2(0.5f));
  return raster.trim->keeps(g.pieces[static_cast<size_t>(g.pieceOfCell(cell))].patch, middle.x, middle.y);
}

/// Returns twice the signed area of the cell in raster space.
float areaOf(const RasterGrid& r, const CellSteps& at) {
  const float *x = r.x.data(), *y = r.y.data();
  return at.uStep(x) * at.vStep(y) - at.uStep(y) * at.vStep(x);
}

}  // namespace

void addUnseen(const GridTable::Entry& entry, bool cullBackfacing, const PixelRect& rect,
               std::vector<uint32_t>& cells) {
  const RasterGrid& r = *entry.raster;
  const Grid& g = *r.grid;
  for (int cell = 0, end = g.cellNumbers(); cell < end; ++cell) {
    if (!g.isCell(cell)) continue;
    const CellSteps at(g, cell);
    const float x = at.mean(r.x.data()), y = at.mean(r.y.data());
    const bool inside = x >= static_cast<float>(rect.x0) && x < static_cast<float>(rect.x1) &&
                        y >= static_cast<float>(rect.y0) && y < static_cast<float>(rect.y1);
    if (!inside || !isKept(r, cell)) continue;
    if (cullBackfacing && r.facing * areaOf(r, at) < 0) continue;
    cells.push_back(entry.firstCell + static_cast<uint32_t>(cell));
  }
}

}  // namespace tomales
