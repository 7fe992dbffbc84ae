// Private to gi: what the rays of one stratified hemisphere say about a point. Arrays in, record out; no
// scene, no tracing.
#pragma once
#include <span>

#include "gi/gather.h"

namespace tomales {

/// Of every cell, sample j * sectors + k. Directions: unit, in the space of the record.
struct HemisphereSamples {
  HemisphereCells cells;
  vec3 tangent, bitangent, normal;  ///< directions = hemisphereDirection() in this frame
  std::span<const vec3> directions;
  std::span<const vec3> radiance;
  std::span<const float> distances;  ///< infinite: missed
};

/// Fills E, noise, gradients, dominant directions, harmonicMean, closest and normal; position and pixelSize are the
/// caller's.
IrradianceRecord summarize(const HemisphereSamples& samples);

}  // namespace tomales
