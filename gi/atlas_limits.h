// Private to gi: where photon maps come to their limits on the scene at hand, as warnings. The laboratory of docs/chart.md shows what happens beyond.
// Each names an object of the map, with file and line. Deterministic.
#pragma once
#include "gi/atlas.h"

namespace tomales {

/// Most estimates of a map stand on weak ground.
void warnOfEstimates(const Scene& scene, const MapNames& names, const std::string& map, const EstimateFigures& figures, Log& log);

}  // namespace tomales
