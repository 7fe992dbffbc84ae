// Private to gi/cache: each record is extrapolated by its own gradient. Where the light is curved, the mean
// of the records is off, and the differences of their gradients tell by how much. Here the mean is corrected to the
// second order, without any derivative that records do not have. The error of all scenes falls by a fortieth, that at
// thin walls by an eighth. No cost was measured (docs/decisions/0096, docs/decisions/0105).
#pragma once
#include "gi/cache/extrapolation.h"

namespace tomales {

/// Returns step^T H step of each channel. H is that of the record or of a share. It is not known beyond `reach`, so a
/// longer step, such as the mean step of records that are valid farther, is shortened to it.
inline vec3 bentBy(const IrradianceRecord& r, const IrradianceExpansion& light, const vec3& step, float reach) {
  const vec3 known = step * std::min(1.0f, reach / std::max(glm::length(step), 1e-30f));
  const float a = dot(known, r.tangent), b = dot(known, cross(r.normal, r.tangent));
  return a * a * light.hessian[0] + 2 * a * b * light.hessian[1] + b * b * light.hessian[2];
}

/// Mean of records that are all extrapolated to one place, with the sums that its second-order correction needs. A
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
    const vec3 E = glm::max(vec3(0.0f), r.light.E + addLight(r, r.light, weight));
    E_ += weight * E;
    square_ += weight * E * E;
    return E;
  }
  /// Does the same for a share of the record's light. `whole` is what another mean's add() returned for the whole
  /// record. Channels that are 0 there are 0 here too, so that the shares add up to it. agreement() must not be called
  /// then.
  vec3 addShare(const IrradianceRecord& r, const IrradianceExpansion& share, float weight, const vec3& whole) {
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
  /// Returns how far the second order may be trusted: 1 where all records agree, and 0 where they differ by kApart of
  /// their mean (rms).
  vec3 agreement() const {
    constexpr float kApart = 0.3f, kLeast = 1e-30f;
    const vec3 mean = E_ / weight_, variance = square_ / weight_ - mean * mean;
    return glm::clamp(1.0f - variance / glm::max(kApart * kApart * mean * mean, kLeast), 0.0f, 1.0f);
  }

 private:
  vec3 addLight(const IrradianceRecord& r, const IrradianceExpansion& light, float weight) {
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

}  // namespace tomales
