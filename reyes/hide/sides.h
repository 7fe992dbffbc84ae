// Which side of a micropolygon samples see: it is lit there. Its mean normal does not say, for at an outline
// one of its triangles may face the eye and the other turn away. Private to the hider.
#pragma once
#include "reyes/hide/resolve.h"

namespace tomales {

/// Sign of the raster area, u before v, of what turns dP/du x dP/dv to the eye. By the shape alone, which is
/// closed where a body is: shading normals of a micropolygon at a fold may point either way, and leave a hole
/// (docs/decisions/0003).
float facingSign(const Camera& camera);

enum class Side : uint8_t {
  Front = 1,  ///< The one that dP/du x dP/dv of the lattice points to.
  Back = 2,
};
/// What may be seen of cells, by their first vertices: bits of Side; both: it depends on the sample. Of what
/// moves, at shutter open, where it is shaded.
void findSides(const RasterGrid& raster, float facingSign, std::vector<int32_t>& sides);
/// What a sample that the cell covers sees of it.
Side sideAt(const GridTable::Entry& entry, const Camera& camera, int cell, const SamplePoint& sample);

}  // namespace tomales
