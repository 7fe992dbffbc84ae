// Private to gi/cache: two records that disagree about a place, by more than their noise explains, end
// before each other. A point at which its records disagree gets a record of its own. Between such records lies an edge
// of light, or something thinner than they are wide. Without this amendment, twice as many dark pixels behind thin
// walls get light, and the worst windows have a third more error. It costs a twentieth more records and a twentieth
// more time.
#pragma once
#include "gi/cache/irradiance_record.h"
#include "gi/error_function.h"

namespace tomales {

enum class Disagreement { None, Steep, Discontinuous };

class Disagreements {
 public:
  /// So many records at a point disagree by chance: few of their rays have found light, and their noise seems less than
  /// it is. One more record would hardly change their mean.
  static constexpr size_t kCrowd = 32;

  Disagreements(bool on, PublishedEquations equations, float kappa)
      : on_(on),
        tolerance_((equations == PublishedEquations::SplitSphere ? kSplitSphereKappa * kDisagreement : kDisagreement) /
                   kappa),
        kappa_(kappa) {}

  void add(float luminance) {
    luminanceSum_ += luminance;
    ++records_;
  }

  /// Compares two values for one place. noise: the standard error of their difference, or more.
  Disagreement of(const vec3& a, const vec3& b, float noise) const {
    if (!on_) return Disagreement::None;
    const float larger = std::max(luminance(a), luminance(b)),
                off = std::abs(luminance(a) - luminance(b)) - kNoiseMargin * noise;
    const auto dark = static_cast<float>(kDark * luminanceSum_ / static_cast<double>(records_));
    if (!(off > tolerance_ * std::max(larger, dark))) return Disagreement::None;
    return off > kDiscontinuous * std::max(larger, dark) ? Disagreement::Discontinuous : Disagreement::Steep;
  }

  /// Returns how far a record may reach if it disagrees with another one at this distance. Where light is merely steep,
  /// it reaches a pixel at least: records closer than that would follow the noise of single pixels, each at the cost of
  /// a hemisphere. Where two points see different surfaces there is no such limit, since something thinner than a pixel
  /// may lie between them.
  float limit(Disagreement disagreement, float distance, float pixelSize) const {
    if (disagreement == Disagreement::None) return kInfinity;
    return disagreement == Disagreement::Discontinuous ? distance
                                                       : std::max(distance, kFinestPixels * pixelSize / kappa_);
  }

  /// Returns the standard error of an extrapolated value: gradients are as noisy as E over the mean distance of the
  /// hits.
  static float noiseAt(const IrradianceRecord& r, float distance) { return r.noise * (1 + distance / r.harmonicMean); }

 private:
  // Relative difference at kappa 1; 5 % makes more records, no less error.
  static constexpr float kDisagreement = 0.1f;
  static constexpr float kDiscontinuous = 0.5f;  // The same between points that see different surfaces.
  static constexpr float kNoiseMargin = 3;       // Standard errors by which values may differ.
  static constexpr float kDark = 0.1f;           // Share of the mean E; darker values are compared with this.
  static constexpr float kFinestPixels = 1;      // Number of pixels at kappa 1.

  const bool on_;
  const float tolerance_, kappa_;
  double luminanceSum_ = 0;  ///< Sum of the luminances of the records' E.
  size_t records_ = 0;
};

}  // namespace tomales
