// Models how the error and the cost of light in a picture depend on the settings. A few trials on the scene itself
// decide the model's constants. It knows neither scene nor renderer.
#pragma once
#include <functional>
#include <optional>
#include <string>

namespace tomales {

/// The settings that decide the error of gathered light and of the light of lamps.
struct LightQuality {
  int samples = 0;       ///< Rays of a record, or paths at a point of the reference; 0: as the scene asks.
  float maxError = -1;   ///< Reach of records; negative: as the scene asks, or there are no records.
  int lightSamples = 0;  ///< Samples of each area light, where the eye looks; 0: as the light asks.
  bool operator==(const LightQuality&) const = default;
  /// Returns true if both ask for the same records, which depend on nothing else.
  bool hasRecordsOf(const LightQuality& q) const { return samples == q.samples && maxError == q.maxError; }
};

/// Returns them as options of the command line.
std::string optionsOf(const LightQuality&);

/// The errors and costs of a frame with this quality. Errors are mean relative errors, as audits state them.
struct QualityTrial {
  LightQuality quality;
  double indirect = 0, direct = 0;
  double smudges = 0;  ///< SmudgeEstimate::deviation; 0 if nothing was smooth, or only noise was found.
  // Costs of the whole frame, in rays or in seconds.
  double gatherCost = 0;  ///< Cost of the records of its points.
  double bounceCost = 0;  ///< Cost of the records of further bounces (GiServices::BounceCost).
  double shadeCost = 0;
};

/// The greatest error that a picture may have.
struct ErrorTarget {
  double error = 0;    ///< Mean error.
  double smudges = 0;  ///< Deviation of smudges; 0: any.
  ErrorTarget operator*(double x) const { return {x * error, x * smudges}; }
};

/// Returns the most likely error where a model expects one, and an audit has seen another, with this 90 % interval. It
/// is a mean of their logarithms, in which each has the weight of its certainty.
double likelyError(double expected, double seen, double low, double high);

/// An error of gathered light. Its square is the noise of rays, which falls with their number, plus the square of the
/// error of interpolation, a power of maxError. Its constants are fitted to trials, and kept within the known range of
/// such errors, so that the noise of a trial cannot spoil the model.
class RecordError {
 public:
  RecordError() = default;
  /// The error at one quality. `finer` has more rays and `wider` a larger maxError than `base`.
  struct Seen {
    LightQuality quality;
    double error;
  };
  RecordError(const Seen& base, const Seen& finer, const std::optional<Seen>& wider);
  /// Learns from a trial with a smaller maxError than the base.
  void addNarrower(const Seen& narrower);
  /// Scales the model to the error that a picture of this quality had.
  void correct(const Seen& picture);
  double at(const LightQuality&) const;
  /// Returns true if there is any error of this kind.
  bool any() const { return noise_ + bias_ > 0; }

 private:
  LightQuality base_;
  double noise_ = 0, bias_ = 0;  ///< Squares of errors at the base.
  double power_ = 0, narrowPower_ = 0, scale_ = 1;
};

/// A cost with a fixed part and a part that is proportional to a setting, found from two trials.
class CostLine {
 public:
  CostLine() = default;
  CostLine(double x0, double cost0, double x1, double cost1);
  double at(double x) const;
  /// Learns a cost that was measured at x. If x is far from the trials, and the cost is higher than expected, the line
  /// goes through it from now on: a line that is too flat would find any setting cheap. Otherwise the line is only
  /// scaled.
  void learn(double x, double cost);

 private:
  double x0_ = 0, cost0_ = 0, fixed_ = 1;
};

/// Errors and costs of a frame. The direct error and the costs of records are powers of the settings.
/// Records that are narrower than the base have a power of their own: far fewer of them are as wide as they may be.
class ErrorModel {
 public:
  /// `finer` has more rays and light samples than `base`. `wider` has a larger maxError than `base`, and is empty where
  /// there are no records.
  ErrorModel(const QualityTrial& base, const QualityTrial& finer, const std::optional<QualityTrial>& wider);
  /// Learns from a trial that has the rays of the base and a smaller maxError.
  void addNarrower(const QualityTrial& narrower);

  double indirectError(const LightQuality& q) const { return indirect_.at(q); }
  double directError(const LightQuality&) const;
  double error(const LightQuality&) const;  ///< Both errors together; they are independent.
  double smudges(const LightQuality& q) const { return smudges_.at(q); }
  double gatherCost(const LightQuality&) const;
  /// Returns the cost for a share of the frame. Even a part needs all records of further bounces.
  double gatherCostOf(double share, const LightQuality&) const;
  double shadeCost(const LightQuality&) const;
  double cost(const LightQuality& q) const { return gatherCost(q) + shadeCost(q); }
  /// Learns from two trials in the same buckets how the cost of gathering changes with rays.
  void learnRays(const QualityTrial& few, const QualityTrial& many);
  /// Learn from the cost of the whole frame.
  void correctGatherCost(const LightQuality&, double cost);
  void correctShadeCost(const LightQuality&, double cost);

  /// Scales the errors to those that a picture had.
  void correct(const QualityTrial& picture);

  /// Returns the quality that reaches the target at the least cost. If none does within the range in which the model
  /// can be trusted, returns the one that comes nearest. `gathered`: the quality of existing records, which cost
  /// nothing.
  LightQuality cheapest(const ErrorTarget& target, const std::optional<LightQuality>& gathered = {}) const;
  /// Returns the same for smudges that nobody has asked for: where no quality reaches them, the mean error alone
  /// decides.
  LightQuality cheapestOfError(const ErrorTarget& target, const std::optional<LightQuality>& gathered = {}) const;
  /// Returns the best quality that costs no more than `most`: it minimizes the worse of mean error and smudges, and
  /// spends what is left on rays. If every quality costs more, returns the cheapest one.
  LightQuality best(double most) const;
  /// Returns the same with records as wide as those of `given`.
  LightQuality bestAsWide(const LightQuality& given, double most) const;
  /// Returns the most light samples, with the rays and records of `given`, that cost no more in shading.
  LightQuality bestLightSamples(const LightQuality& given, double most) const;

 private:
  template <class Better>
  LightQuality search(const Better& better, const std::function<bool(const LightQuality&)>& isAllowed = {}) const;
  LightQuality bestOf(double most, const std::function<bool(const LightQuality&)>& isAllowed) const;
  /// Returns the error as a multiple of the target.
  double timesTarget(const LightQuality&, const ErrorTarget&) const;

  double bounceCost(const LightQuality&) const;
  bool tracesPaths() const { return base_.quality.samples > 0 && !(base_.quality.maxError > 0); }
  int mostSamples() const;
  LightQuality withMoreRays(const LightQuality&, double most) const;

  QualityTrial base_;
  RecordError indirect_, smudges_;
  CostLine shading_;
  double directPower_ = 0, raysPower_ = 0, recordsPower_ = 0, narrowRecordsPower_ = 0, bouncesPower_ = 0;
  double directScale_ = 1, gatherScale_ = 1;
};

}  // namespace tomales
