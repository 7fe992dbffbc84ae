// Samples -> DeepTile. Private to the hider.
#pragma once
#include "reyes/hide/samples.h"

namespace tomales {

DeepTile resolveTile(const Scene& scene, const Camera& camera, const GridTable& grids, SampleBuffer& samples);

/// Where on a cell (its own (u,v), 0..1) a raster position lies at a time of the shutter, 0..1.
vec2 positionOnCell(const GridTable::Entry& entry, int cell, vec2 at, float time);

}  // namespace tomales
