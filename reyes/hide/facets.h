// Visible micropolygons become facets and points to shade, in the order of their grids. Private to the hider.
#pragma once
#include "reyes/hide/samples.h"

namespace tomales {

class FacetTable {
 public:
  FacetTable(const Scene& scene, const Camera& camera, const GridTable& grids, DeepTile& tile);
  /// A cell that some sample sees.
  void see(uint32_t cell) { seen_[cell] = 1; }
  /// Makes the facets of all cells that are seen, and their points; before, the tile has none. Everything in them depends on the
  /// grid alone.
  void make();
  /// Pre: the cell is seen, and make() was called.
  uint32_t facetOf(uint32_t cell) const { return facetOf_[cell]; }

 private:
  /// A point to be made: at the centre of a cell, or at a vertex.
  struct Wish {
    uint32_t entry;  ///< In GridTable::entries.
    int index;       ///< Of the cell or vertex.
  };
  struct Wishes {
    int group;
    std::vector<Wish> list;
  };
  void makeFacets(uint32_t entry);
  int batchOf(int group);
  void fill(const Wishes& wishes, ShadePoints& points) const;

  const Scene& scene_;
  const Camera& camera_;
  const GridTable& grids_;
  DeepTile& tile_;
  std::vector<uint8_t> seen_;      ///< A cell
  std::vector<uint32_t> facetOf_;  ///< A cell
  std::vector<int> batchOf_;       ///< A group, -1: none yet.
  std::vector<Wishes> wishes_;     ///< A batch
  std::vector<int> corners_;       ///< Points of a grid's vertices, -1: none yet.
};

}  // namespace tomales
