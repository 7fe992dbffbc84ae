// Trials in a few buckets of a frame, which measure the error and the cost of its light under some settings.
#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "reyes/app/frame/error_model.h"
#include "reyes/app/frame/frame_light.h"

namespace tomales {

/// The number of rays is the same in every run; seconds depend on the machine and its load.
enum class CostUnit { Rays, Seconds };

struct TrialSettings {
  CostUnit unit = CostUnit::Rays;
  bool isBrief = false;   ///< Fewer pixels are audited: the frame has little time.
  int fewerRays = 1;      ///< The trials have so many times fewer rays and light samples than the finest ones.
  ErrorTarget matters{};  ///< Errors that are smaller need not be known; 0: all matter.
  uint32_t seed = 0;      ///< Decides which buckets and pixels.
  /// Returns the quality that would be chosen from the first trials. If its records are much narrower than those of the
  /// trials, a trial of such records follows, because wide records do not show how many narrow ones a frame needs. The
  /// trial is left out if it is likely to cost more than mostOfNarrow().
  std::function<LightQuality(const ErrorModel&)> likely;
  std::function<double()> mostOfNarrow = [] { return std::numeric_limits<double>::infinity(); };
};

struct TrialsResult {
  ErrorModel model;
  std::vector<size_t> seen;   ///< Buckets that see something.
  std::vector<size_t> tried;  ///< Buckets among them that were tried, the one with the most points first.
  int lightSamples = 0;       ///< Light samples of the finest picture among them.
  double audit_s = 0;         ///< Time that an audit of the frame may take.
  double raysPerSecond = 0;   ///< Rays per second on this machine now, for messages alone.

  /// Returns in words how long this many rays take.
  std::string timeOf(double rays) const;
};

/// Gathers in these buckets alone, and returns the wall time that it took as the costs of the trial.
QualityTrial secondsToGather(const FrameLight& light, std::span<const size_t> which, const LightQuality& quality);
/// Shades these tiles as for the picture, forgets them, and returns the wall time that it took.
double secondsToShade(const FrameLight& light, std::span<const size_t> which);

/// Lights and audits the buckets two to four times. The gathered records stay with the job until its next setQuality().
TrialsResult makeTrials(const FrameLight& light, const TrialSettings& settings);

}  // namespace tomales
