// The cone of lights that shine along an axis (RISpec 3.2, appendix A, spotlight).
#pragma once
#include "reyes/shader/shadeops.h"

/// Shares of the light, 0..1: what the soft edge lets through, and what the falloff from the axis leaves.
struct ConeShare {
  float edge, beam;

  /// `cosine` is that of the direction with the axis. Angles are half angles in radians.
  static ConeShare at(float cosine, float coneangle, float conedeltaangle, float beamdistribution) {
    const float outer = std::cos(coneangle);
    if (!(cosine > outer)) return {0, 0};
    const float inner = std::cos(std::max(0.0f, coneangle - conedeltaangle));
    return {rsl::smoothstep(outer, inner, cosine), std::pow(std::max(0.0f, cosine), beamdistribution)};
  }
};
