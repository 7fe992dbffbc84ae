// Private to gi: the irradiance of photons that lie in bright lines and spots, with darkness beside them. Each photon
// sheds its power on a disk that reaches as far as its own nearest neighbours, and sheds less towards the rim. So the
// light of all photons is their power (a density estimate with a width for each sample and Epanechnikov's kernel;
// Silverman 1986, sections 4.2 and 5.3). An estimate by the photons nearest to the place that is lit would find light
// in the dark too, because there it looks far. Space: that of the photons. Threads: lookups are concurrent.
#pragma once
#include "gi/photons/irradiance.h"
#include "gi/photons/run_boxes.h"
#include "gi/photons/tree.h"

namespace tomales {

class CausticPhotons {
 public:
  /// photons: as for estimateIrradiance(), on surfaces.
  CausticPhotons(PointCloud photons, const PhotonIrradianceSettings& settings);

  /// Returns E in W/m2 on the side of N (unit), averaged over a square around P whose edges are about 2 `radius`.
  /// surface: that of P, as in PhotonTree::nearest().
  vec3 irradiance(const vec3& P, const vec3& N, int surface, float radius) const;

 private:
  PhotonTree tree_;
  int power_;                  ///< Offset of the channel.
  std::vector<float> radius_;  ///< Radius of each photon's disk, in the order of the tree.
  RunBoxes boxes_;             ///< Around the disks.
};

}  // namespace tomales
