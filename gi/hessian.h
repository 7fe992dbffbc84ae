// Private to gi: how irradiance changes as a point moves in its tangent plane, to the second order, with occlusion.
// Schwarzhaupt, Jensen, Jarosz 2012, "Practical Hessian-Based Error Control for Irradiance Caching": what neighbouring
// rays hit is joined by triangles, of the radiance of their farthest corner (a nearer surface ends at its own hit, and
// what lies behind appears). The irradiance of such a mesh is a sum over its edges, and so are its derivatives. What
// appears behind an edge is taken to be of one radiance: where the edge of something far passes behind that of
// something near, the mixed derivative is up to a half too small, however many rays there are.
#pragma once
#include "gi/hemisphere.h"

namespace tomales {

/// Second derivatives of E/pi, per channel, along the tangent and the bitangent of the samples.
struct IrradianceCurvature {
  vec3 xx{0.0f}, xy{0.0f}, yy{0.0f};
};

IrradianceCurvature curvatureOf(const HemisphereSamples& samples);

/// Radius of the disk over which a record may be extrapolated linearly: the error, summed over the disk in units of
/// squared pixels, is `tolerance` times the luminance of E.
float hessianRadius(const IrradianceCurvature& curvature, float luminanceOfE, float pixelSize, float tolerance);

/// Radius within which extrapolating linearly is off by no more than `variation`.
float variationRadius(const IrradianceCurvature& curvature, float variation);

}  // namespace tomales
