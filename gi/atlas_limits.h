// Private to gi: where photon maps come to their limits on the scene at hand, as warnings. The laboratory of
// docs/chart.md shows what happens beyond. Each names an object of the worst map, with file and line. Deterministic.
#pragma once
#include "gi/atlas.h"

namespace tomales {

/// Of one map. Photons all have about the same power.
struct MapFigures {
  std::string map;
  uint64_t photons = 0;
  EstimateFigures estimates;
};

/// Most estimates of some map stand on weak ground, of those that have more than a per cent of all photons.
void warnOfEstimates(const Scene& scene, const MapNames& names, const std::vector<MapFigures>& maps, Log& log);

}  // namespace tomales
