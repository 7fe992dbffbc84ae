#include "gi/photons/arrivals.h"

#include "reyes/base/morton.h"

namespace tomales {

PhotonArrivals::PhotonArrivals(const std::vector<StoredPhoton>& photons) {
  std::vector<vec3> places;
  for (const StoredPhoton& p : photons) places.push_back(p.P);
  for (const uint32_t i : mortonOrder(places)) photons_.push_back(photons[i]);
  boxes_ = RunBoxes(photons_.size(), [&](size_t i) { return Bound3{photons_[i].P, photons_[i].P}; });
}

}  // namespace tomales
