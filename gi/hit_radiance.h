// Radiance of surfaces that is known before gather rays meet them, so that no shader runs there. Radiance is a colour
// as a shader returns it. Space: current.
#pragma once
#include "raytrace/trace.h"

namespace tomales {

class HitRadiance {
 public:
  virtual ~HitRadiance() = default;
  /// Finds the radiance that leaves a hit towards the ray's origin. Returns false if it is not known. Threads: may be
  /// called concurrently.
  virtual bool lookup(const Ray& ray, const Hit& hit, vec3& radiance) const = 0;
  virtual void report(Stats&) const {}  ///< Adds statistics; called after the last lookup.
};

}  // namespace tomales
