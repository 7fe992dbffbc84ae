// What is known of the radiance of surfaces before gather rays meet them, so that no shader runs there.
#pragma once
#include "raytrace/trace.h"

namespace tomales {

class HitRadiance {
 public:
  virtual ~HitRadiance() = default;
  /// Radiance of what a ray has met, towards it. False: it is not known. Threads: may be called concurrently.
  virtual bool lookup(const Ray& ray, const Hit& hit, vec3& radiance) const = 0;
  virtual void report(Stats&) const {}  ///< After the last lookup.
};

}  // namespace tomales
