// Private to gi: what the rays of one stratified hemisphere say about a point. Arrays in, record out; no
// scene, no tracing.
#pragma once
#include <span>

#include "gi/gather.h"

namespace tomales {

/// Of the luminances that several rays add to one cell.
struct CellSpread {
  int rays = 0;
  float sum = 0, squares = 0;
  void add(float part) { ++rays, sum += part, squares += part * part; }
  bool known() const { return rays > 1; }
  float variance() const {
    const float n = static_cast<float>(rays);
    return std::max(0.0f, squares - sum * sum / n) * n / (n - 1);
  }
};

/// Of every cell, sample j * sectors + k. Directions: unit, in the space of the record.
struct HemisphereSamples {
  HemisphereCells cells;
  vec3 tangent, bitangent, normal;  ///< directions = hemisphereDirection() in this frame
  std::span<const vec3> directions;
  std::span<const vec3> radiance;
  std::span<const float> distances;      ///< infinite: missed
  std::span<const CellSpread> spread{};  ///< Of cells with several rays; may be empty.
};

/// Fills E, noise, gradients, dominant directions, harmonicMean, closest and normal; position and pixelSize are the
/// caller's.
IrradianceRecord summarize(const HemisphereSamples& samples);

}  // namespace tomales
