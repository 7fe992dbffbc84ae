// Visible micropolygons become facets and points to shade, in order of first use. Private to the hider.
#pragma once
#include "reyes/hide/samples.h"

namespace tomales {

class FacetTable {
 public:
  FacetTable(const Scene& scene, const Camera& camera, const GridTable& grids, DeepTile& tile);
  /// The facet of a cell, made at its first use. Everything in it depends on the grid alone.
  uint32_t facetOf(uint32_t cell);

 private:
  struct Stencil;
  Facet makeFacet(const GridTable::Entry& entry, int cell);
  int cornerPoint(const GridTable::Entry& entry, int batch, int vertex);
  int batchOf(int group);
  int addPoint(const Grid& grid, int batch, const Stencil& stencil, uint32_t key);

  const Scene& scene_;
  const Camera& camera_;
  const GridTable& grids_;
  DeepTile& tile_;
  std::vector<uint32_t> facetOf_;  ///< A cell
  std::vector<int> batchOf_;       ///< A group, -1: none yet.
  std::map<uint32_t, std::vector<int>>
      corners_;  ///< Points of a grid's vertices, by its first cell, -1: none yet.
};

}  // namespace tomales
