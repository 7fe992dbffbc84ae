// Noun: the irradiance that arrives at one point, and how it changes around it. Equations are those of Tabellion and
// Lamorlette 2004. It needs reyes/base alone. Irradiance: E here is irradiance / pi (the RSL convention). Space: that
// of the caller.
#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

/// Irradiance at a record, and its derivatives there. It is the whole light of a record, or the share that one group of
/// lights brings.
struct IrradianceExpansion {
  vec3 E{0.0f};  ///< E/pi per channel
  /// One for each channel; E(n) ~ E + dot(cross(ni, n), gradient) (Ward and Heckbert 1992).
  vec3 rotationGradient[3] = {vec3(0), vec3(0), vec3(0)};
  /// One for each channel; E(x) ~ E + dot(x - xi, gradient).
  vec3 translationGradient[3] = {vec3(0), vec3(0), vec3(0)};
  /// Second derivatives of E along the tangent of the record and cross(normal, tangent): xx, xy, yy
  /// (ErrorFunction::Hessian alone).
  vec3 hessian[3] = {vec3(0), vec3(0), vec3(0)};

  void add(const IrradianceExpansion& other, const vec3& gain) {
    E += gain * other.E;
    for (int c = 0; c < 3; ++c) {
      rotationGradient[c] += gain[c] * other.rotationGradient[c];
      translationGradient[c] += gain[c] * other.translationGradient[c];
      hessian[c] += gain * other.hessian[c];
    }
  }
};

struct IrradianceRecord {
  vec3 position, normal;  ///< normal is a unit vector without bumps (Tabellion and Lamorlette 2004, section 4.5).
  IrradianceExpansion light;
  vec3 tangent;        ///< Unit vector; with cross(normal, tangent) it spans the axes of the Hessians.
  vec3 dominant[3];    ///< Unit directions of the dominant light of red, green and blue (eq. 7).
  float harmonicMean;  ///< Harmonic mean of the distances to the hits; Ward's R.
  float closest;       ///< Least distance to a hit; the paper's R_i.
  float smoothRadius;  ///< E is nearly linear within it (ErrorFunction::Hessian alone)
  float noise;         ///< Upper bound of the standard error of the luminance of E.
  /// Greatest validity radius: beyond it a neighbour disagrees, or it is the height of an occluder over the record.
  float limit = kInfinity;
  float pixelSize;               ///< Root of the projected pixel area at the record, for R+ and R- (eq. 3).
  float unseenDisplacement = 0;  ///< Greatest distance from the surface that its rays see to the displaced one.
  /// The light that each group of lights brings, by any number of bounces, if groups were asked for; else empty. The
  /// shares add up to `light`.
  std::vector<IrradianceExpansion> shares;
};

/// Returns the record as it would be if each share were brighter by its gain. Pre: there are as many gains as shares.
inline IrradianceRecord withGains(IrradianceRecord record, std::span<const vec3> gains) {
  IrradianceExpansion sum;
  float most = 1;
  for (size_t g = 0; g < gains.size(); ++g) {
    IrradianceExpansion scaled;
    scaled.add(record.shares[g], gains[g]);
    record.shares[g] = scaled;
    sum.add(scaled, vec3(1.0f));
    most = std::max({most, gains[g].x, gains[g].y, gains[g].z});
  }
  record.light = sum;
  record.noise *= most;  // the noise is an upper bound
  return record;
}

}  // namespace tomales
