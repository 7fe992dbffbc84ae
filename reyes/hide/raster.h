// Micropolygons against samples. Private to the hider.
// A micropolygon abcd (a b over c d in (u,v)) is the triangles abc and bdc: the diagonal bc is fixed.
// A sample is inside a triangle if it lies on the inner side of each edge. Every edge is evaluated from its
// lexicographically smaller end, so both neighbours get the same value with opposite signs, and the value
// zero belongs to the right of the edge seen from that end: as if every sample were moved by (e^2, -e) for an
// infinitesimal e. Vertices of still grids and samples lie on a lattice (kLattice), on which the values of
// micropolygons up to 3.5 px are whole numbers (reyes/hide/quad.h) and exact in float too, so that a fan round a vertex
// neither misses a sample nor hits it twice.
#pragma once
#include "reyes/hide/lattice.h"
#include "reyes/hide/samples.h"

namespace tomales {

/// Far below the distance of two values that an edge function takes: `value > -kTiny` says `value >= 0`, as a
/// number that a vector can choose, and survives threads that flush denormals.
constexpr float kTiny = 1e-30f;

/// What the loops need of a grid besides itself.
struct RasterJob {
  const RasterGrid& raster;
  const GridTable& grids;
  uint32_t firstCell;
  const std::vector<float>& keyTimes;  ///< Fractions of the shutter.
  const Camera& camera;
  SampleBuffer& out;
};

/// Grids with one motion key, in focus.
void rasterizeStill(const RasterJob& job);
/// Such grids of round cells: Grid::round.
void rasterizeRound(const RasterJob& job);
/// Grids that move or are out of focus: a sample meets the vertices where they are at its time through its
/// point of the lens.
void rasterizeBlurred(const RasterJob& job);

/// Do trim curves, clipping and levels of detail leave all of the job's grid?
inline bool keepsAll(const RasterJob& job) {
  return job.raster.grid->kept.empty() && !job.raster.clipped && job.raster.detail.whole();
}
/// What they leave of a cell.
inline Kept keptOf(const RasterJob& job, int cell) {
  const std::vector<Kept>& given = job.raster.grid->kept;
  const Kept kept = given.empty() ? Kept::All : given[static_cast<size_t>(cell)];
  return kept == Kept::All && (job.raster.clipped || !job.raster.detail.whole()) ? Kept::Part : kept;
}
/// Do they leave the part of a cell that a sample meets? Pre: the cell covers it.
bool keepsSample(const RasterJob& job, uint32_t cell, size_t lane);
/// The same for the lanes of a mask that counts from `firstLane`.
uint64_t keptLanes(const RasterJob& job, uint32_t cell, size_t firstLane, uint64_t lanes);

/// Gives samples at equal depths, lane by lane of a mask, to the cell whose name comes first.
void settleTies(const RasterJob& job, size_t firstLane, uint64_t lanes, uint32_t cell);

/// How far a depth key may be off because vertices lie on the lattice and numbers are floats; `slope`: of the depth
/// key, per pixel. Above 0.
inline float vagueDepth(float slope, float depth) { return slope / kLattice + 4e-7f * std::abs(depth) + kTiny; }
/// A cell of the job comes so close to what samples have had, lane by lane of a mask, that vague depths decide: noted
/// if that is of another object.
void noteContest(const RasterJob& job, size_t firstLane, uint64_t lanes, float vague);

}  // namespace tomales
