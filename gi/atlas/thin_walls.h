// Private to gi: walls through which irradiance estimates reach, because the surface that they stand on goes on behind
// them. The result does not depend on threads.
#pragma once
#include "gi/atlas.h"

namespace tomales {

/// Sees walls in world space: what stands on a surface at more than 60 degrees. `rays` must outlive the result.
SightAlongSurface sightAlongSurfaces(const RayScene& rays);

/// Warns where there is more light behind a wall than before it. It tests places of the global maps in `folder`, by
/// area, with short rays along the surface. Throws FileError.
void warnOfThinWalls(const std::filesystem::path& folder, const Scene& scene, const RayScene& rays,
                     const MapNames& names, Log& log);

}  // namespace tomales
