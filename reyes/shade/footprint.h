// The extent of a point's micropolygon, and the angle by which a direction turns over it: the differentials of lookups
// and rays from the point.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

/// Returns half the micropolygon's diagonal, so that neighbouring disks overlap; at a ray hit, the radius of the ray's
/// footprint.
float micropolygonRadius(const ShadePoints&, const TmGrid*, int i);
/// Writes the angle by which a direction turns over the micropolygon of each active point, up to pi: by its derivatives
/// if they are known, and otherwise as a mirror would turn it.
void turnOf(Batch&, const TmGrid*, TmConstVec3 direction, float* angle);

}  // namespace tomales
