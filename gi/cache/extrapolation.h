// Private to gi/irradiance_cache: extrapolates the E/pi of records to other places.
#pragma once
#include "gi/cache/irradiance_record.h"

namespace tomales {

/// The change of E/pi that the gradients of a record or a share predict, for a step from the record's position and a
/// turn, the cross product of the record's normal and the other one.
template <class Light>
vec3 changeBy(const Light& r, const vec3& step, const vec3& turn) {
  vec3 change;
  for (int c = 0; c < 3; ++c) change[c] = dot(turn, r.rotationGradient[c]) + dot(step, r.translationGradient[c]);
  return change;
}

inline vec3 extrapolate(const IrradianceRecord& r, const vec3& x, const vec3& n) {
  return glm::max(vec3(0.0f), r.E + changeBy(r, x - r.position, cross(r.normal, n)));
}

/// Returns step^T H step of each channel. The step may be the mean step of records that are valid farther; it is
/// shortened to `reach`, beyond which this record's H is not known. H is that of the record or of a share.
template <class Light>
vec3 bentBy(const IrradianceRecord& r, const Light& light, const vec3& step, float reach) {
  const vec3 known = step * std::min(1.0f, reach / std::max(glm::length(step), 1e-30f));
  const float a = dot(known, r.tangent), b = dot(known, cross(r.normal, r.tangent));
  return a * a * light.hessian[0] + 2 * a * b * light.hessian[1] + b * b * light.hessian[2];
}

/// Mean of records that are all extrapolated to one place, with what it needs to be corrected to the second order. A
/// record at a distance s is off by -s H s / 2 after extrapolation by its gradient, and gradients so far apart differ
/// by H s. So the mean over the records is off by half the covariance of gradient and step, which needs no second
/// derivative, and by -s H s / 2 of the mean step, which is small where records lie on all sides. This holds where the
/// light changes smoothly. At a shadow's edge between records, their values disagree, and a parabola through them would
/// light the dark side.
class MeanExtrapolation {
 public:
  MeanExtrapolation(const vec3& x, const vec3& n) : x_(x), n_(n) {}

  /// Adds extrapolate() of the record with this weight, and returns it.
  vec3 add(const IrradianceRecord& r, float weight) {
    const vec3 E = glm::max(vec3(0.0f), r.E + addLight(r, r, weight));
    E_ += weight * E;
    square_ += weight * E * E;
    return E;
  }
  /// The same for a share of the record's light. A channel counts where that of the whole does (`whole`, which is what
  /// another mean's add() returned), so that shares add up to it. agreement() is not to be asked.
  vec3 addShare(const IrradianceRecord& r, const LightShare& share, float weight, const vec3& whole) {
    const vec3 E = share.E + addLight(r, share, weight);
    return vec3(glm::greaterThan(whole, vec3(0.0f))) * E;
  }
  // Pre: add() has been called.
  vec3 step() const { return step_ / weight_; }
  vec3 covariance() const {
    vec3 out = change_;
    for (int c = 0; c < 3; ++c) out[c] -= (dot(turn_, rotation_[c]) + dot(step_, translation_[c])) / weight_;
    return out / weight_;
  }
  /// Returns 1 where all records agree and 0 where they differ by kApart of their mean (rms): the second order is to be
  /// trusted so far.
  vec3 agreement() const {
    constexpr float kApart = 0.3f, kLeast = 1e-30f;
    const vec3 mean = E_ / weight_, variance = square_ / weight_ - mean * mean;
    return glm::clamp(1.0f - variance / glm::max(kApart * kApart * mean * mean, kLeast), 0.0f, 1.0f);
  }

 private:
  template <class Light>
  vec3 addLight(const IrradianceRecord& r, const Light& light, float weight) {
    const vec3 turn = cross(r.normal, n_), step = x_ - r.position, change = changeBy(light, step, turn);
    weight_ += weight;
    step_ += weight * step;
    turn_ += weight * turn;
    change_ += weight * change;
    for (int c = 0; c < 3; ++c)
      translation_[c] += weight * light.translationGradient[c], rotation_[c] += weight * light.rotationGradient[c];
    return change;
  }

  const vec3 x_, n_;
  float weight_ = 0;
  vec3 step_{0.0f}, turn_{0.0f}, change_{0.0f}, E_{0.0f}, square_{0.0f};
  vec3 translation_[3] = {vec3(0), vec3(0), vec3(0)}, rotation_[3] = {vec3(0), vec3(0), vec3(0)};
};

/// Derivatives hold near the record alone, so each may at most double or extinguish E over the validity radius. Those
/// of shares are shortened as those of the whole are.
inline void limitDerivatives(IrradianceRecord& r, float radius) {
  const auto scale = [](vec3& v, float numerator, float by) { v = by < kInfinity ? v * (numerator / by) : vec3(0.0f); };
  for (int c = 0; c < 3; ++c) {
    vec3& gradient = r.translationGradient[c];
    const float change = glm::length(gradient) * radius;
    if (!(change <= r.E[c])) {
      scale(gradient, r.E[c], change);
      for (LightShare& share : r.shares) scale(share.translationGradient[c], r.E[c], change);
    }
    const float xx = r.hessian[0][c], xy = r.hessian[1][c], yy = r.hessian[2][c];
    const float bend = 0.5f * radius * radius * std::sqrt(xx * xx + 2 * xy * xy + yy * yy);
    if (bend <= r.E[c]) continue;
    const auto shorten = [&](float& second) { second = bend < kInfinity ? second * r.E[c] / bend : 0.0f; };
    for (vec3& second : r.hessian) shorten(second[c]);
    for (LightShare& share : r.shares)
      for (vec3& second : share.hessian) shorten(second[c]);
  }
}

}  // namespace tomales
