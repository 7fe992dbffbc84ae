// Private to gi/cache: the published rules of how far a record may be used, and nothing else. The amendments
// of this renderer are in gi/cache/amendments. Each type has the radius of a record, times kappa, before the size of
// pixels limits it; the weight of a record at a point; and the least cosine between normals that has a weight.
// `position`: the distance to the record over its radius; `angle`: sqrt(1 - n.ni).
#pragma once
#include <variant>

#include "gi/cache/irradiance_record.h"
#include "gi/irradiance_cache.h"

namespace tomales {

/// Tabellion and Lamorlette 2004, eq. 2 to 5: the radius is half of the least distance R_i to a hit, between limits
/// that follow from the size of a pixel.
struct Screen {
  static constexpr float kMaxAngleTerm = 0.0151922470f;  ///< 1 - cos(alpha+), alpha+ = 10 degrees (eq. 4).
  float kappa;

  static float unclampedRadius(const IrradianceRecord& r) { return r.closest * 0.5f; }  // eq. 3
  float weight(float position, float angle) const {
    return std::max(0.0f, 1 - std::max(position, kappa * angle / std::sqrt(kMaxAngleTerm)));
  }
  float leastCosine() const { return 1 - kMaxAngleTerm / (kappa * kappa); }
};

/// Ward et al. 1988: the greatest gradient of light from a sphere around the point that is half bright and half dark.
/// One is subtracted from their weight, so that it falls to 0 where the record ends.
struct SplitSphere {
  float kappa;

  static float unclampedRadius(const IrradianceRecord& r) { return r.harmonicMean; }
  float weight(float position, float angle) const {
    return std::max(0.0f, 1 / std::max(position + kappa * angle, 1e-4f) - 1);
  }
  float leastCosine() const { return 1 - 1 / (kappa * kappa); }
};

/// Schwarzhaupt et al. 2012: the radius follows from the second derivatives (gi/gather/hessian.h). All else is as in
/// Screen.
struct Hessian : Screen {
  float unclampedRadius(const IrradianceRecord& r) const { return std::min(r.smoothRadius, r.closest * kappa); }
};

using Published = std::variant<Screen, SplitSphere, Hessian>;

inline Published publishedBy(PublishedEquations equations, float kappa) {
  switch (equations) {
    case PublishedEquations::SplitSphere:
      return SplitSphere{kappa};
    case PublishedEquations::Hessian:
      return Hessian{{kappa}};
    case PublishedEquations::Screen:
      break;
  }
  return Screen{kappa};
}

}  // namespace tomales
