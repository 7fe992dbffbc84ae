// Private to gi: the part of the disk of a measured point that lies on surfaces which photons meet. Example: it is a
// half at the edge of a square. Threads: may be called concurrently.
#pragma once
#include "gi/photons/measurement.h"

namespace tomales {

/// Returns whether a few rays find a surface everywhere on the disk of `scale` times the point's radius.
bool isCovered(const RayScene& rays, const MeasurementPoint& point, float scale);
/// Returns the part of the disk that lies on surfaces, projected along the point's normal, as more rays find it. It is
/// at least that of half a ray.
float coverage(const RayScene& rays, const MeasurementPoint& point, float scale);

}  // namespace tomales
