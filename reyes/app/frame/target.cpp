#include "reyes/app/frame/target.h"

#include <fmt/format.h>

#include <algorithm>

#include "reyes/app/frame/provenance.h"
#include "reyes/app/frame/trials.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr int kMostAttempts = 3;
constexpr double kMargin = 0.9;     ///< Share of the target that is aimed at: some pictures err more than a model says.
constexpr double kTolerance = 1.1;  ///< A picture that errs by so many times the target is lit again.
constexpr double kShareToPlan = 0.9;  ///< Share of the time left that is planned: models of time are off by a tenth.
/// A frame whose gathering has taken less than this share of its time is lit again, better.
constexpr double kLittleUsed = 0.5;
constexpr int kLampsOfAudit = 16;  ///< Light samples of a picture whose audit takes as long as those of trials.
/// Lamps lose no more of their planned samples where gathering was late: a picture that is late too is better than
/// noise.
constexpr int kMostCutOfLamps = 4;
constexpr double kBrief_s = 60;  ///< Trials are brief where less time is left.

uint32_t seedOf(const RenderSettings& settings) { return hashCombine(lightSeedOf(settings), randomStream("targ")); }

std::string wordsFor(const LightQuality& quality) {
  const std::string options = optionsOf(quality);
  return options.empty() ? "the scene's own settings are kept" : "chose " + options;
}

class TargetSearch {
 public:
  TargetSearch(FrameJob& job, const DeepFrame& layout, const TileReader& tiles, const RenderSettings& settings,
               Stats& stats, Log& log)
      : job_(job), layout_(layout), tiles_(tiles), settings_(settings), stats_(stats), log_(log) {}

  void run() {
    TrialsResult trials = makeTrials(job_, layout_, tiles_, {.seed = seedOf(settings_)}, stats_);
    if (interrupted()) return;
    ErrorModel& model = trials.model;
    LightQuality quality = model.cheapest(kMargin * settings_.targetError);
    tellChoice(trials, quality);
    for (int attempt = 1;; ++attempt) {
      job_.setQuality(quality);
      job_.gather(layout_, tiles_);
      if (interrupted()) return;
      const AuditReport report =
          job_.audit(layout_, tiles_, hashCombine(seedOf(settings_), static_cast<uint32_t>(attempt)));
      if (interrupted()) return;
      const ErrorEstimate& error = report.picture;
      // More rays in the picture do not quieten the audit.
      const bool isNear = !error.tells() || error.mean <= kTolerance * settings_.targetError;
      model.correct(quality, report.indirect ? report.indirect->mean : 0, report.direct ? report.direct->mean : 0);
      const LightQuality better = model.cheapest(kMargin * settings_.targetError);
      if (isNear || attempt == kMostAttempts || better == quality) return finish(quality, report, attempt, isNear);
      quality = better;
    }
  }

 private:
  void tellChoice(const TrialsResult& trials, const LightQuality& quality) {
    const double expected = trials.model.error(quality);
    log_.report(
        Severity::Note, "target-error", {},
        fmt::format("{} for a mean error of {:.3g} %: trials in {} of {} buckets expect {:.2g} %, by about {:.2g} "
                    "million rays{}",
                    wordsFor(quality), 100 * settings_.targetError, trials.buckets, trials.ofBuckets, 100 * expected,
                    trials.model.cost(quality) / 1e6,
                    expected > settings_.targetError
                        ? "; that is the least error of all settings within the range of the model"
                        : ""));
  }

  void finish(const LightQuality& quality, const AuditReport& report, int attempts, bool isNear) {
    job_.tellAudit(report);
    describeQuality(job_.scene().options, optionsOf(quality), settings_);
    const ErrorEstimate& error = report.picture;
    if (!error.tells() && error.noise > settings_.targetError)
      log_.report(
          Severity::Warning, "target-unproved", {},
          fmt::format("a mean error of {:.3g} % was asked, and the audit's own noise of {:.2g} % hides whether it "
                      "is reached, with {}",
                      100 * settings_.targetError, 100 * error.noise, optionsOf(quality)));
    if (isNear) return;
    log_.report(
        Severity::Warning, "target-missed", {},
        fmt::format("a mean error of {:.3g} % was asked, and {:.2g} % ({:.2g} to {:.2g}) reached after {} of at "
                    "most {} attempts, the last with {}",
                    100 * settings_.targetError, 100 * error.mean, 100 * error.low, 100 * error.high, attempts,
                    kMostAttempts, optionsOf(quality)));
  }

  FrameJob& job_;
  const DeepFrame& layout_;
  const TileReader& tiles_;
  const RenderSettings& settings_;
  Stats& stats_;
  Log& log_;
};

}  // namespace

void reachTargetError(FrameJob& job, const DeepFrame& layout, const TileReader& tiles, const RenderSettings& settings,
                      Stats& stats, Log& log) {
  TargetSearch(job, layout, tiles, settings, stats, log).run();
}

void useTimeBudget(FrameJob& job, const DeepFrame& layout, const TileReader& tiles, const RenderSettings& settings,
                   Stats& stats, Log& log) {
  const TrialPlan plan{CostUnit::Seconds, settings.timeBudget_s - job.elapsed_s() < kBrief_s, seedOf(settings)};
  TrialsResult trials = makeTrials(job, layout, tiles, plan, stats);
  LightQuality quality;
  const auto left_s = [&] {  // an audit takes many times as many light samples as the picture
    const double audit_s = settings.audit > 0 ? trials.audit_s * std::max(1, quality.lightSamples / kLampsOfAudit) : 0;
    return kShareToPlan * (settings.timeBudget_s - job.elapsed_s() - audit_s);
  };
  for (int pass = 0; pass < 2; ++pass) quality = trials.model.best(std::max(0.0, left_s()));
  const double planned_s = left_s();
  job.setQuality(quality);
  job.gather(layout, tiles);
  if (interrupted()) return;
  if (const double left = left_s() - trials.model.shadeCost(quality); planned_s > 0 && left > kLittleUsed * planned_s) {
    const LightQuality better = trials.model.best(left_s());
    if (trials.model.error(better) < trials.model.error(quality)) {
      quality = better;
      job.setQuality(quality);
      job.gather(layout, tiles);
    }
  }
  const int fewest = quality.lightSamples / kMostCutOfLamps;
  quality = trials.model.bestLamps(quality, std::max(0.0, left_s()));
  quality.lightSamples = std::max(quality.lightSamples, fewest);
  job.setLightSamples(quality.lightSamples);
  log.report(
      Severity::Note, "time-budget", {},
      fmt::format("{} for {:.3g} s: trials in {} of {} buckets expect a mean error of {:.2g} %", wordsFor(quality),
                  settings.timeBudget_s, trials.buckets, trials.ofBuckets, 100 * trials.model.error(quality)));
  describeQuality(job.scene().options, optionsOf(quality), settings);
  if (planned_s > 0) return;
  log.report(
      Severity::Warning, "time-over", {},
      fmt::format("{:.3g} s are too short: hiding and trials alone took {:.3g} s; light has the coarsest settings",
                  settings.timeBudget_s, settings.timeBudget_s - planned_s / kShareToPlan));
}

}  // namespace tomales
