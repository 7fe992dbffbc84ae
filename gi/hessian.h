// Private to gi: how irradiance changes as a point moves in its tangent plane, to the second order, with occlusion.
// Schwarzhaupt, Jensen, Jarosz 2012, "Practical Hessian-Based Error Control for Irradiance Caching": what neighbouring rays hit is joined
// by triangles, of the radiance of their farthest corner (a nearer surface ends at its own hit, and what lies behind appears). The
// irradiance of such a mesh is a sum over its edges, and so are its derivatives.
#pragma once
#include "gi/hemisphere.h"

namespace tomales {

/// Derivatives of E/pi along the tangent and the bitangent of the samples.
struct IrradianceCurvature {
  vec3 gradient[3];              ///< Per channel, in the space of the record.
  float xx = 0, xy = 0, yy = 0;  ///< Hessian of the luminance.
};

IrradianceCurvature curvatureOf(const HemisphereSamples& samples);

/// Radius of the disk over which a record may be extrapolated linearly: the error, summed over the disk in units of
/// squared pixels, is `tolerance` times the luminance of E.
float hessianRadius(const IrradianceCurvature& curvature, float luminanceOfE, float pixelSize, float tolerance);

/// Radius within which extrapolating linearly is off by no more than `variation`.
float variationRadius(const IrradianceCurvature& curvature, float variation);

}  // namespace tomales
