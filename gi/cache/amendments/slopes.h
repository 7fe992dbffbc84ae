// Private to gi/cache: derivatives hold near the record alone, so each may at most double or extinguish E
// over the validity radius. A ray that meets a surface at a tiny distance gives a gradient of any size: without this,
// corners are millions of times too bright. No cost was measured.
#pragma once
#include "gi/cache/irradiance_record.h"

namespace tomales {

/// The derivatives of shares are shortened as those of the whole are.
inline void limitDerivatives(IrradianceRecord& r, float radius) {
  const auto scale = [](vec3& v, float numerator, float by) { v = by < kInfinity ? v * (numerator / by) : vec3(0.0f); };
  for (int c = 0; c < 3; ++c) {
    vec3& gradient = r.light.translationGradient[c];
    const float change = glm::length(gradient) * radius;
    if (!(change <= r.light.E[c])) {
      scale(gradient, r.light.E[c], change);
      for (IrradianceExpansion& share : r.shares) scale(share.translationGradient[c], r.light.E[c], change);
    }
    const float xx = r.light.hessian[0][c], xy = r.light.hessian[1][c], yy = r.light.hessian[2][c];
    const float bend = 0.5f * radius * radius * std::sqrt(xx * xx + 2 * xy * xy + yy * yy);
    if (bend <= r.light.E[c]) continue;
    const auto shorten = [&](float& second) { second = bend < kInfinity ? second * r.light.E[c] / bend : 0.0f; };
    for (vec3& second : r.light.hessian) shorten(second[c]);
    for (IrradianceExpansion& share : r.shares)
      for (vec3& second : share.hessian) shorten(second[c]);
  }
}

}  // namespace tomales
