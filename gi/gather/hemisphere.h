// Private to gi: computes a record from the rays of one stratified hemisphere at a point. It knows no scene and traces
// nothing.
#pragma once
#include <span>

#include "gi/gather.h"

namespace tomales {

/// Statistics of the luminances of several rays in one cell.
struct CellSpread {
  int rays = 0;
  float sum = 0, squares = 0;
  void add(float part) {
    ++rays;
    sum += part;
    squares += part * part;
  }
  bool known() const { return rays > 1; }
  float variance() const {
    const float n = static_cast<float>(rays);
    return std::max(0.0f, squares - sum * sum / n) * n / (n - 1);
  }
};

/// The samples of every cell, in the order j * sectors + k. Directions are unit vectors in the space of the record.
struct HemisphereSamples {
  HemisphereCells cells;
  vec3 tangent, bitangent, normal;  ///< The frame in which directions = hemisphereDirection().
  std::span<const vec3> directions;
  std::span<const vec3> radiance;
  std::span<const float> distances;      ///< Infinite where the ray missed.
  std::span<const CellSpread> spread{};  ///< Set if some cells have several rays; otherwise empty.
};

/// Fills E, noise, gradients, dominant directions, harmonicMean, closest and normal. The caller sets position and
/// pixelSize.
IrradianceRecord summarize(const HemisphereSamples& samples);

}  // namespace tomales
