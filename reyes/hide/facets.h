// Visible micropolygons become facets and points to shade, in order of first use. Private to the hider.
#pragma once
#include "reyes/hide/samples.h"

namespace tomales {

class FacetTable {
 public:
  FacetTable(const Scene& scene, const Camera& camera, const GridTable& grids, DeepTile& tile);
  /// The facet of a cell, made at its first use. Everything in it depends on the grid alone.
  uint32_t facetOf(uint32_t cell);
  /// Fills the points of all facets; before, the tile has no batches.
  void makePoints();

 private:
  /// A point to be made: at the centre of a cell, or at a vertex.
  struct Wish {
    uint32_t entry;  ///< In GridTable::entries.
    int index;       ///< Of the cell or vertex.
    bool vertex;
  };
  struct Wishes {
    int group;
    std::vector<Wish> list;
  };
  Facet makeFacet(const GridTable::Entry& entry, int cell);
  int cornerPoint(const GridTable::Entry& entry, int batch, int vertex);
  int batchOf(int group);
  int wish(int batch, const GridTable::Entry& entry, int index, bool vertex);
  void fill(const Wishes& wishes, ShadePoints& points) const;

  const Scene& scene_;
  const Camera& camera_;
  const GridTable& grids_;
  DeepTile& tile_;
  std::vector<uint32_t> facetOf_;  ///< A cell
  std::vector<int> batchOf_;       ///< A group, -1: none yet.
  std::vector<Wishes> wishes_;     ///< A batch
  std::map<uint32_t, std::vector<int>>
      corners_;  ///< Points of a grid's vertices, by its first cell, -1: none yet.
};

}  // namespace tomales
