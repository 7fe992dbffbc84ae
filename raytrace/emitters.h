// Points on area lights: the coarse quads of all objects that emit for a light, in proportion to area.
// Space: current. Threads: const members may be called concurrently.
#pragma once
#include "raytrace/tessellate.h"

namespace tomales {

class Emitters {
 public:
  Emitters(const Scene& scene, const std::vector<CoarseGroup>& groups);

  /// Meaning as ShadeServices::sampleEmitter. Within a quad points are bilinear, so stratified (xi0, xi1)
  /// stay stratified; `area` is the Jacobian over the probability of the quad: the total area wherever quads
  /// are parallelograms.
  bool sample(int light, int count, const float* xi0, const float* xi1, TmVec3 P, TmVec3 N,
              float* area) const;

 private:
  struct Source {
    uint32_t group, quad;
  };
  struct Light {
    std::vector<Source> sources;
    std::vector<double> cumulated_area;  ///< sources.size() + 1 values from 0.
  };
  const std::vector<CoarseGroup>& groups_;
  std::vector<Light> lights_;
};

}  // namespace tomales
