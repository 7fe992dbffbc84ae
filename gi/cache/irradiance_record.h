// Noun: the irradiance that arrives at one point, and how it changes around it. It needs reyes/base alone. Irradiance:
// E here is irradiance / pi (the RSL convention). Space: that of the caller.
#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

/// The part of a record's light that one group of lights brings, by any number of bounces. Its fields are those of the
/// record, and the fields of all shares add up to those of the record.
struct LightShare {
  vec3 E{0.0f};
  vec3 rotationGradient[3] = {vec3(0), vec3(0), vec3(0)};
  vec3 translationGradient[3] = {vec3(0), vec3(0), vec3(0)};
  vec3 hessian[3] = {vec3(0), vec3(0), vec3(0)};

  void add(const LightShare& other, const vec3& gain) {
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
  vec3 E;                 ///< E/pi per channel
  /// One for each channel; E(n) ~ E + dot(cross(ni, n), gradient) (Ward and Heckbert 1992).
  vec3 rotationGradient[3];
  vec3 translationGradient[3];  ///< One for each channel; E(x) ~ E + dot(x - xi, gradient).
  vec3 tangent;                 ///< Unit vector; with cross(normal, tangent) it spans the axes of hessian.
  /// Second derivatives of E along those axes: xx, xy, yy (ErrorFunction::Hessian alone).
  vec3 hessian[3];
  vec3 dominant[3];    ///< Unit directions of the dominant light of red, green and blue (eq. 7).
  float harmonicMean;  ///< Harmonic mean of the distances to the hits; Ward's R.
  float closest;       ///< Least distance to a hit; the paper's R_i.
  float smoothRadius;  ///< E is nearly linear within it (ErrorFunction::Hessian alone)
  float noise;         ///< Upper bound of the standard error of the luminance of E.
  /// Greatest validity radius: beyond it a neighbour disagrees, or it is the height of an occluder over the record.
  float limit = kInfinity;
  float pixelSize;                 ///< Root of the projected pixel area at the record, for R+ and R- (eq. 3).
  float unseenDisplacement = 0;    ///< Greatest distance from the surface that its rays see to the displaced one.
  std::vector<LightShare> shares;  ///< One for each group of lights that was asked for; empty: not known.
};

/// Returns the record as it would be if each share were brighter by its gain. Pre: there are as many gains as shares.
inline IrradianceRecord withGains(IrradianceRecord record, std::span<const vec3> gains) {
  LightShare sum;
  float most = 1;
  for (size_t g = 0; g < gains.size(); ++g) {
    LightShare scaled;
    scaled.add(record.shares[g], gains[g]);
    record.shares[g] = scaled;
    sum.add(scaled, vec3(1.0f));
    most = std::max({most, gains[g].x, gains[g].y, gains[g].z});
  }
  record.E = sum.E;
  record.noise *= most;  // the noise is an upper bound
  std::ranges::copy(sum.rotationGradient, record.rotationGradient);
  std::ranges::copy(sum.translationGradient, record.translationGradient);
  std::ranges::copy(sum.hessian, record.hessian);
  return record;
}

}  // namespace tomales
