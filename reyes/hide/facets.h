// Private to the hider: visible micropolygons become facets and points to shade, grid by grid in order of first use.
#pragma once
#include <map>
#include <span>

#include "reyes/hide/sides.h"

namespace tomales {

class FacetTable {
 public:
  FacetTable(const Scene& scene, const Camera& camera, const GridTable& grids, const SampleBuffer& samples,
             DeepTile& tile);
  /// Marks a cell that some sample sees.
  void see(uint32_t cell) { seen_[cell] = 1; }
  /// Makes the facets of all marked cells and of the cells `unseen`, and the points to shade. Before the call the tile
  /// has no facets, and its fragments name cells, each of them marked; after it they name facets. A facet depends on
  /// its grid and on the side that is seen. A cell that may be seen from both sides gets a facet for each side that a
  /// fragment sees; if no fragment sees it, it gets one for the front. diagnostics: may be null.
  void make(std::span<const uint32_t> unseen, HideDiagnostics* diagnostics);

 private:
  /// A point to be made, at the centre of a cell or at a vertex.
  struct PointRequest {
    uint32_t entry;  ///< Index into the entries of the GridTable.
    int index;       ///< Index of the cell or vertex.
    Side side;       ///< The side that is seen.
  };
  struct PointRequests {
    int group;
    std::vector<PointRequest> list;
  };
  void makeFacets(const GridTable::Entry& entry);
  /// Returns the side on which a fragment sees its cell.
  Side sideOf(uint32_t fragment) const;
  /// Returns the facet of a side of a cell that may be seen from both.
  uint32_t facetOfFolded(uint32_t cell, Side side);
  void countTurns(const GridTable::Entry& entry, HideDiagnostics& diagnostics);
  int batchOf(int group);
  void fill(const PointRequests& requests, ShadePoints& points) const;
  void addSteps(std::span<const PointRequest> requests, ShadePoints& points, int first) const;
  /// Returns the number of requests from the first on for cells that follow each other in a row of a grid.
  static int runLength(const Grid& g, std::span<const PointRequest> requests);

  static constexpr uint32_t kNotMade = ~0U, kFolded = ~0U - 1;

  const Scene& scene_;
  const Camera& camera_;
  const float facingSign_;
  const GridTable& grids_;
  const SampleBuffer& samples_;
  DeepTile& tile_;
  std::vector<uint8_t> seen_;            ///< Indexed by cell.
  std::vector<uint32_t> facetOf_;        ///< Indexed by cell; kNotMade before it is made; kFolded if it is in folded_.
  std::vector<int> batchOf_;             ///< Indexed by group; -1 before it is made.
  std::vector<PointRequests> requests_;  ///< Indexed by batch.
  std::vector<int32_t> turning_;         ///< Indexed by vertex of a grid.
  std::vector<int32_t> sides_;           ///< The result of findSides().
  std::vector<int> corners_;  ///< Two points for each vertex of a grid, Front and Back; -1 before they are made.
  std::map<std::pair<uint32_t, Side>, uint32_t> folded_;  ///< Facets of cells that may be seen from both sides.
};

}  // namespace tomales
