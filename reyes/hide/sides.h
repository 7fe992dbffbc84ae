// Private to the hider: finds the side of a micropolygon that samples see, which is the side that is lit. The mean
// normal does not show it, because at an outline one triangle may face the eye and the other turn away.
#pragma once
#include "reyes/hide/resolve.h"

namespace tomales {

/// Returns the sign of the raster area, u before v, of a micropolygon whose dP/du x dP/dv faces the eye. The shape
/// alone decides the side. Shading normals must not: at a fold they may point either way, which would leave holes in a
/// closed body (docs/decisions/0003).
float facingSign(const Camera& camera);

enum class Side : uint8_t {
  Front = 1,  ///< The side that dP/du x dP/dv of the lattice points to.
  Back = 2,
};
/// Finds the sides of cells that may be seen, by the cells' first vertices: bits of Side. Both are set where the side
/// depends on the sample. Moving cells are judged at shutter open, where they are shaded.
void findSides(const RasterGrid& raster, float facingSign, std::vector<int32_t>& sides);
/// Returns the side that a sample sees of a cell that covers it.
Side sideAt(const GridTable::Entry& entry, const Camera& camera, int cell, const SamplePoint& sample);

}  // namespace tomales
