// Private to the hider: how the borders of pieces are closed (docs/decisions/0003).
#pragma once
#include "reyes/hide.h"
#include "reyes/hide/subpixel.h"

namespace tomales {

constexpr float kLeastReach_px = 2 / kSubpixels;  ///< Least distance by which a border reaches out.

/// Decides for each border of a still grid's pieces whether it ends at a line, reaches out, or neither, and sets
/// RasterGrid::lines and RasterGrid::reaching. Pre: `grid` and `inSolid` are set.
void planBorders(RasterGrid& raster, const Object& object, const Camera& camera);

/// Pushes the borders that reach out, at one motion key. A displaced border may lie anywhere within a micropolygon,
/// because its neighbour samples the displacement at other places: `mostOfDisplaced_px` limits how far it reaches; 0 if
/// the grid is not displaced. facing: RasterGrid::facing of a one-sided surface.
void pushBorders(const RasterGrid& raster, float mostOfDisplaced_px, float facing, float* x, float* y);

/// Returns how far the surface may lie from the grid's cells, in pixels: the sagitta along u and v, and the fold of a
/// twisted cell.
float deviation_px(const Grid& grid, const float* x, const float* y);

}  // namespace tomales
