// How the error of light in a picture, and what it costs, depend on the settings. A few trials on the scene
// itself decide the model's constants. It knows neither scene nor renderer.
#pragma once
#include <optional>
#include <string>

namespace tomales {

/// The settings that decide how right gathered light and the light of lamps are.
struct LightQuality {
  int samples = 0;       ///< Rays of a record, or paths at a point of the reference; 0: as the scene asks.
  float maxError = -1;   ///< How far records reach; negative: as the scene asks, or there are no records.
  int lightSamples = 0;  ///< Samples of each area light, where the eye looks; 0: as the light asks.
  bool operator==(const LightQuality&) const = default;
};

/// As options of the command line.
std::string optionsOf(const LightQuality&);

/// What was seen of a frame that had this quality. Errors are mean relative ones, as audits state them.
struct QualityTrial {
  LightQuality quality;
  double indirect = 0, direct = 0;
  double gatherCost = 0;  ///< What the whole frame takes before it is shaded,
  double shadeCost = 0;   ///< and while it is shaded, in rays or in seconds.
};

/// The square of the indirect error is the noise of rays, which falls with their number, plus the square of what
/// interpolation errs, a power of maxError. The direct error and the costs are powers. A power is taken from
/// two trials and kept within what is known of it, so that the chance of a trial does not run away with the model.
class ErrorModel {
 public:
  /// `finer` has more rays and light samples than `base`. `wider` has a larger maxError than `base`, and is empty where
  /// there are no records.
  ErrorModel(const QualityTrial& base, const QualityTrial& finer, const std::optional<QualityTrial>& wider);

  double indirectError(const LightQuality&) const;
  double directError(const LightQuality&) const;
  double error(const LightQuality&) const;  ///< Both together, which are independent.
  double gatherCost(const LightQuality&) const;
  double shadeCost(const LightQuality&) const;
  double cost(const LightQuality& q) const { return gatherCost(q) + shadeCost(q); }

  /// Scales the errors to those that a picture of this quality has had.
  void correct(const LightQuality&, double indirect, double direct);

  /// The quality that reaches the target at the least cost. If none does within the range in which the model may be
  /// believed, the one of the least error.
  LightQuality cheapest(double target) const;
  /// The quality of the least error that costs no more. If none does, the cheapest one.
  LightQuality best(double most) const;
  /// The same with the rays and records of `given`: only light samples are chosen, for the cost of shading.
  LightQuality bestLamps(const LightQuality& given, double most) const;

 private:
  template <class Better>
  LightQuality search(const Better& better) const;

  int lightSamplesAt(int step) const;

  QualityTrial base_;
  double noise_ = 0, bias_ = 0, biasPower_ = 0;  ///< Squares of errors at the base, and power over maxError.
  double directPower_ = 0, raysPower_ = 0, recordsPower_ = 0, shadowsPower_ = 0;
  double indirectScale_ = 1, directScale_ = 1;
};

}  // namespace tomales
