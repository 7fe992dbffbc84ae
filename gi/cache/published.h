// Private to gi/irradiance_cache: how far a record may be used, as it was published, and nothing else. What this
// renderer adds is in gi/cache/amendments.h. `position`: the distance to the record over its radius; `angle`:
// sqrt(1 - n.ni).
#pragma once
#include "gi/cache/irradiance_record.h"
#include "gi/irradiance_cache.h"

namespace tomales {

constexpr float kMaxAngleTerm = 0.0151922470f;  ///< 1 - cos(alpha+), alpha+ = 10 degrees (approximate-gi eq. 4).

/// The size of a record, from which its radius follows.
inline float sizeOf(const IrradianceRecord& r, const ErrorFunctionInfo& info, float kappa) {
  if (info.splitSphere) return r.harmonicMean;                             // Ward et al. 1988
  if (info.curvature) return std::min(r.smoothRadius, r.closest * kappa);  // Schwarzhaupt et al. 2012
  return r.closest * 0.5f;                                                 // approximate-gi eq. 3
}

/// The distance at which the error reaches 1: the denominator of eq. 3 over kappa. The split sphere as it was published
/// has no limits in pixels.
inline float radiusOf(float size, const CacheSettings& settings, float pixelSize) {
  return std::max(std::min(size, settings.maxPixels * pixelSize), settings.minPixels * pixelSize) / settings.kappa;
}

/// approximate-gi eq. 2, 4 and 5. `hessian` has the same weight with another radius.
inline float screenWeight(float position, float angle, float kappa) {
  return std::max(0.0f, 1 - std::max(position, kappa * angle / std::sqrt(kMaxAngleTerm)));
}

/// Ward et al. 1988, less 1, so that it falls to 0 where the record ends.
inline float splitSphereWeight(float position, float angle, float kappa) {
  return std::max(0.0f, 1 / std::max(position + kappa * angle, 1e-4f) - 1);
}

/// Least cosine between normals that has a weight.
inline float leastCosine(const ErrorFunctionInfo& info, float kappa) {
  return 1 - (info.splitSphere ? 1.0f : kMaxAngleTerm) / (kappa * kappa);
}

}  // namespace tomales
