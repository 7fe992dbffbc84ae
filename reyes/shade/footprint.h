// The extent of a point's micropolygon, and the angle that it sees in a direction: the differentials of lookups and
// rays that leave it.
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

/// Returns half a diagonal of it, so that neighbouring disks overlap; at ray hits the radius of the ray's footprint.
float micropolygonRadius(const ShadePoints&, const TmGrid*, int i);
/// Writes the angle by which a direction turns over the micropolygon of each active point, up to pi: by its derivatives
/// where they are known, else as a mirror would turn it.
void turnOf(Batch&, const TmGrid*, TmConstVec3 direction, float* angle);

}  // namespace tomales
