// Private to gi: warns where irradiance estimates reach through walls, behind which there is more light than before
// them. The result does not depend on threads.
#pragma once
#include "gi/atlas.h"

namespace tomales {

/// Tests places of the global maps in `folder`, by area, with short rays along the surface. Throws FileError.
void warnOfThinWalls(const std::filesystem::path& folder, const Scene& scene, const RayScene& rays,
                     const MapNames& names, Log& log);

}  // namespace tomales
