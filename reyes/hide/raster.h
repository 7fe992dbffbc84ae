// Private to the hider: coverage of samples by micropolygons.
// A micropolygon abcd (a b over c d in (u,v)) is the triangles abc and bdc: the diagonal bc is fixed. A sample is
// inside a triangle if it lies on the inner side of each edge. Every edge is evaluated from its lexicographically
// smaller end, so both neighbours get the same value with opposite signs. The value zero belongs to the right of the
// edge seen from that end: as if every sample were moved by (e^2, -e) for an infinitesimal e. Vertices of still grids
// and samples lie on a lattice (kSubpixels). There the values of micropolygons up to 3.5 px are whole numbers
// (reyes/hide/quad.h), which floats hold exactly, so that a fan around a vertex neither misses a sample nor hits it
// twice.
#pragma once
#include "reyes/hide/depth_error.h"
#include "reyes/hide/samples.h"

namespace tomales {

/// The arguments of the loops over a grid.
struct RasterJob {
  const RasterGrid& raster;
  const GridTable& grids;
  uint32_t firstCell;
  const std::vector<float>& keyTimes;  ///< Fractions of the shutter.
  const Camera& camera;
  SampleBuffer& out;
};

/// Rasterises a grid with one motion key, in focus.
void rasterizeStill(const RasterJob& job);
/// Does the same for a grid of round cells: Grid::round.
void rasterizeRound(const RasterJob& job);
/// Rasterises a grid that moves or is out of focus: a sample meets the vertices where they are at its time, seen
/// through its point of the lens.
void rasterizeBlurred(const RasterJob& job);

/// Tells whether trim curves, clipping and levels of detail keep all of the job's grid.
inline bool keepsAll(const RasterJob& job) {
  return job.raster.grid->kept.empty() && !job.raster.clipped && job.raster.detail.whole();
}
/// Returns the part of a cell that trim curves, clipping and levels of detail keep.
inline Kept keptOf(const RasterJob& job, int cell) {
  const std::vector<Kept>& given = job.raster.grid->kept;
  const Kept kept = given.empty() ? Kept::All : given[static_cast<size_t>(cell)];
  return kept == Kept::All && (job.raster.clipped || !job.raster.detail.whole()) ? Kept::Part : kept;
}
/// Tells whether they keep the point of a cell that a sample meets. Pre: the cell covers the sample.
bool keepsSample(const RasterJob& job, uint32_t cell, size_t lane);
/// Tests the same for the lanes of a mask that counts from `firstLane`.
uint64_t keptLanes(const RasterJob& job, uint32_t cell, size_t firstLane, uint64_t lanes);

/// Gives samples in a mask with equal depths to the cell whose name comes first.
void settleTies(const RasterJob& job, size_t firstLane, uint64_t lanes, uint32_t cell);

/// Notes a depth conflict for samples in a mask that see another object so close to the cell that depth errors decide
/// between them.
void noteDepthConflict(const RasterJob& job, size_t firstLane, uint64_t lanes, float depthError);

}  // namespace tomales
