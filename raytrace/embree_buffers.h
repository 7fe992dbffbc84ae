// Gives Embree the quads of a geometry: the buffers of one group, or copies of several groups' quads.
#pragma once
#include "raytrace/embree_filters.h"

namespace tomales {

/// Sets vertices and indices of one run; its group must outlive the geometry.
void shareBuffers(RTCGeometry geometry, const CoarseGroup& g, const Geometry::Run& run);

/// Copies the quads of runs of out.meshes one after the other, and notes in `out` where each came from. If memory runs
/// out, some quads are left out, and the device has an error.
void copyBuffers(RTCGeometry geometry, std::vector<Geometry::Run> runs, Geometry& out);

/// Sets the filter that rejects hits that trim curves have cut away, and levels of detail that the ray does not see.
void filterAbsent(RTCGeometry geometry);

}  // namespace tomales
