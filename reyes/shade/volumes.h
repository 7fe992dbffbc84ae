// Applies the volume shaders of Interior and Exterior to the results of rays from a surface (RISpec 3.2 section 4.2.5).
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

/// Runs the volume shader of the side on which each ray leaves its surface, over `distance`, on the colour and opacity
/// of what the ray met. Rays that met nothing, and rays without a volume on their side, keep their values.
void crossVolumes(Batch& batch, const TmGrid* g, TmConstVec3 origin, TmConstVec3 direction, const float* distance,
                  TmVec3 color, TmVec3 opacity);

}  // namespace tomales
