// How Embree comes by the quads of a geometry: those of a group where they stand, or copies of several groups'.
#pragma once
#include "raytrace/embree_filters.h"

namespace tomales {

/// Sets vertices and indices of one run; its group must outlive the geometry.
void shareBuffers(RTCGeometry geometry, const CoarseGroup& g, const Geometry::Run& run);

/// Copies the quads of runs of out.meshes behind each other, and notes in `out` where each came from. Without memory
/// for them some are left out, which the device's error tells.
void copyBuffers(RTCGeometry geometry, std::vector<Geometry::Run> runs, Geometry& out);

/// Hits of what trim curves have cut away, or of levels of detail that the ray does not see, do not count.
void filterAbsent(RTCGeometry geometry);

}  // namespace tomales
