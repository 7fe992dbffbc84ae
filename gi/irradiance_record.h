// Noun: the irradiance that arrives at one point, and how it changes around it. Over reyes/base alone.
// Irradiance: E here is irradiance / pi (the RSL convention). Space: that of the caller.
#pragma once
#include "reyes/base/math.h"

namespace tomales {

struct IrradianceRecord {
  vec3 position, normal;        ///< normal: unit, not bumped (approximate-gi section 4.5)
  vec3 E;                       ///< E/pi per channel
  vec3 rotationGradient[3];     ///< per channel; E(n) ~ E + dot(cross(ni, n), gradient) (Ward and Heckbert 1992)
  vec3 translationGradient[3];  ///< per channel; E(x) ~ E + dot(x - xi, gradient)
  vec3 tangent;                 ///< and cross(normal, tangent), along which
  vec3 hessian[3];              ///< E has these second derivatives: xx, xy, yy (ErrorFunction::Hessian alone)
  vec3 dominant[3];             ///< unit; for red, green, blue (eq. 7)
  float harmonicMean;           ///< of distances to what the rays hit; Ward's R
  float closest;                ///< least of them; the paper's R_i
  float smoothRadius;           ///< within which E is nearly linear (ErrorFunction::Hessian alone)
  float noise;                  ///< standard error of the luminance of E, at most
  float limit = kInfinity;      ///< beyond which neighbours have shown it to be wrong, or a sheet over it ends
  float pixelSize;              ///< root of the projected pixel area at the record, for R+ and R- (eq. 3)
  float relief = 0;             ///< So far from the surface that its rays see lies the true one, at most: bumps.
};

}  // namespace tomales
