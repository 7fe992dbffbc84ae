// Private to gi: the passes in which photons are sent that are counted (measurement.h).
#pragma once
#include <cstdint>
#include <vector>

namespace tomales {

struct PhotonPass {
  int64_t photons;
  float scale;     ///< Radius of the disks on which they count, over that of the points' micropolygons.
  bool endsRound;  ///< Even and odd passes are alike up to here, so that their difference tells the noise.
};

/// Returns passes of `photons` photons together. A round of passes sends as many as all rounds before it, and has one
/// scale. So rays look for edges only once a round. The noise too is looked at only once a round: if it were looked at
/// often, it would at some time be low by chance. `shrinks`: disks shrink from round to round. Otherwise the scale is
/// 1.
std::vector<PhotonPass> photonPasses(int64_t photons, bool shrinks);

}  // namespace tomales
