// How many polygons stand for a patch in the eyes of rays.
// Rate: polygons of about 8 pixels (x sqrt(ShadingRate) / trace:tessellation) where the camera can see the object, and a turn of the
// normal of at most 15 degrees (/ trace:tessellation) everywhere, as long as polygons are larger than 1.5 pixels; flat patches are
// one exact quad. Threads: const members may be called concurrently.
#pragma once
#include "reyes/camera.h"
#include "reyes/scene.h"

namespace tomales {

bool displacesForRays(const Object& object);

class TessellationRate {
 public:
  struct Counts {
    int nu, nv;
  };
  /// All must outlive this.
  TessellationRate(const Scene& scene, const Camera& camera, Log& log) : scene_(scene), camera_(camera), log_(log) {}

  Counts coarse(int object, uint32_t patch) const;

 private:
  Counts limited(int object, double nu, double nv) const;

  const Scene& scene_;
  const Camera& camera_;
  Log& log_;
};

}  // namespace tomales
