// Private to gi: sight along a surface, which the walls that stand on it end. Space: world. Threads: pure.
#pragma once
#include "gi/photons/irradiance.h"
#include "raytrace/trace.h"

namespace tomales {

constexpr float kSightLift = 0.1f;  ///< Height over the surface of the rays along it, as a share of their length.

/// Sees walls: what stands on a surface at more than 60 degrees. `rays` must outlive the result.
SightAlongSurface sightAlongSurfaces(const RayScene& rays);

}  // namespace tomales
