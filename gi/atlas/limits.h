// Private to gi: warns where photon maps reach their limits on the scene at hand. docs/chart.md shows what happens
// beyond the limits. Each warning names an object of the worst map, with file and line. The result does not depend on
// threads.
#pragma once
#include "gi/atlas_files.h"

namespace tomales {

/// Figures of one map. All photons have about the same power.
struct MapFigures {
  std::string map;
  uint64_t photons = 0;
  EstimateFigures estimates;
};

/// Tells what the eye sees of disks in world space, in front of everything else. `rays` must outlive the result.
ShownDisk shownBy(const RayScene& rays);

/// Warns if more than a quarter of the shown estimates has few photons. Warns if most estimates of some map are
/// unreliable; maps with less than a per cent of all photons do not count there.
void warnOfEstimates(const Scene& scene, const MapNames& names, const std::vector<MapFigures>& maps, Log& log);

}  // namespace tomales
