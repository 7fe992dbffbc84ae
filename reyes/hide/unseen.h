// Private to the hider: micropolygons that are shaded although no sample sees them (Attribute "cull"), for what their
// shaders bake.
#pragma once
#include "reyes/hide/samples.h"

namespace tomales {

/// Adds the cells of a grid whose middle lies in `rect` when the shutter opens, so that each belongs to one bucket.
/// Cells of one-sided surfaces that face away are left out if cullBackfacing.
void addUnseen(const GridTable::Entry& entry, bool cullBackfacing, const PixelRect& rect, std::vector<uint32_t>& cells);

}  // namespace tomales
