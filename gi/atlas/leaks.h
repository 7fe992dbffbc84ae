// Private to gi: warns of walls through which irradiance estimates reach, because the surface that they stand on goes
// on behind them. Space: world. The result does not depend on threads.
#pragma once
#include "gi/atlas_files.h"

namespace tomales {

/// Warns where there is more light behind a wall than before it. It tests places of the global maps in `folder`, by
/// area, with short rays along the surface. Throws FileError.
void warnOfLeaks(const std::filesystem::path& folder, const Scene& scene, const RayScene& rays, const MapNames& names,
                 Log& log);

}  // namespace tomales
