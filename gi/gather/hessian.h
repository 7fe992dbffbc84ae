// Private to gi: the second derivatives of irradiance as a point moves in its tangent plane. They take account of
// occlusion. Source: Schwarzhaupt, Jensen, Jarosz 2012, "Practical Hessian-Based Error Control for Irradiance Caching".
// The hits of neighbouring rays are joined by triangles, each with the radiance of its farthest corner: a nearer
// surface ends at its own hit, and the surface behind it appears. The irradiance of such a mesh is a sum over its
// edges, and so are its derivatives. Limit: the surface that appears behind an edge is taken to have one radiance.
// Where the edge of a far surface passes behind that of a near one, the mixed derivative is up to a half too small,
// however many rays there are.
#pragma once
#include "gi/gather/hemisphere.h"

namespace tomales {

/// Second derivatives of E/pi, per channel, along the tangent and the bitangent of the samples.
struct IrradianceCurvature {
  vec3 xx{0.0f}, xy{0.0f}, yy{0.0f};
};

IrradianceCurvature curvatureOf(const HemisphereSamples& samples);

/// Returns the radius of the disk over which a record may be extrapolated linearly: the error, summed over the disk in
/// units of squared pixels, is `tolerance` times the luminance of E.
float hessianRadius(const IrradianceCurvature& curvature, float luminanceOfE, float pixelSize, float tolerance);

/// Returns the radius within which linear extrapolation is off by no more than `variation`.
float variationRadius(const IrradianceCurvature& curvature, float variation);

}  // namespace tomales
