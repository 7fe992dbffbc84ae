// Runs the volume shaders of Interior and Exterior over what rays bring back to a surface (RISpec 3.2 section 4.2.5).
#pragma once
#include "reyes/shade/batch.h"

namespace tomales {

/// Lets the shader of the side on which each ray leaves its surface change the colour and the opacity of what the ray
/// met at a distance. Rays that met nothing, and those whose side has no volume, keep theirs.
void crossVolumes(Batch& batch, const TmGrid* g, TmConstVec3 origin, TmConstVec3 direction, const float* distance,
                  TmVec3 color, TmVec3 opacity);

}  // namespace tomales
