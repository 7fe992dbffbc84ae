// Private to gi: photons of surfaces that glow, because their shaders add light of their own (TM_EMITS). Gather rays
// see the glow itself, so its photons count as light that a surface sends on. They leave the coarse polygons that
// gather rays see. Space: current. Power: W. Threads: const members may be called concurrently.
#pragma once
#include "gi/photons/emission.h"
#include "raytrace/tessellate.h"
#include "reyes/base/distribution.h"

namespace tomales {

/// Returns the radiance that surfaces send back along rays where no lights shine.
std::vector<vec3> emittedRadiance(const RayScene& rays, const ShadingSystem& shading, const std::vector<Ray>& from,
                                  const std::vector<Hit>& hits, const std::vector<SampleName>& names, uint32_t seed);

class EmissivePhotons : public PhotonSource {
 public:
  /// Samples each object that may glow and that diffuse rays see, to learn how bright it is at which places. Warns of
  /// objects on which no photon can start.
  EmissivePhotons(const RayScene& rays, const ShadingSystem& shading, uint32_t seed, Log& log);

  int light() const override { return -1; }
  double power() const override { return choice_.total(); }
  void emit(uint32_t first, uint32_t seed, std::vector<EmittedPhoton>& out) const override;

 private:
  /// One side of an object.
  struct Surface {
    std::shared_ptr<const CoarseGroup> mesh;
    bool back = false;   ///< The side away from the RISpec normal.
    int columns = 1;     ///< Cells along each edge of a polygon.
    Distribution cells;  ///< Power of the cells of the first polygon, of the second, ...
  };
  struct Start {
    vec3 P;
    Hit hit;      ///< The hit of a ray that meets P.
    vec3 normal;  ///< Unit normal of the polygon on the side that glows.
    float area;   ///< Area for each unit of the pair of numbers that chose the place in its cell; 0: trimmed away.
  };
  void survey(Surface& surface, size_t mostProbes) const;
  static Start startIn(const Surface& surface, size_t cell, vec2 at);
  std::vector<vec3> radianceAlong(const std::vector<Start>& starts, const std::vector<vec3>& directions,
                                  const std::vector<SampleName>& names) const;

  const RayScene& rays_;
  const ShadingSystem& shading_;
  const uint32_t seed_;
  std::vector<Surface> surfaces_;
  Distribution choice_;  ///< Power of each surface.
};

}  // namespace tomales
