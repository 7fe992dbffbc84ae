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
/// Share of the time left that a trial of narrow records may take.
constexpr double kShareOfNarrowTrial = 0.1;
constexpr double kShareToPlan = 0.9;  ///< Share of the time left that is planned: models of time are off by a tenth.
/// A frame whose gathering has taken less than this share of its time is lit again, better.
constexpr double kLittleUsed = 0.5;
constexpr int kLampsOfAudit = 16;  ///< Light samples of a picture whose audit takes as long as those of trials.
/// Lamps lose no more of their planned samples where gathering was late: a picture that is late too is better than
/// noise.
constexpr int kMostCutOfLamps = 4;
constexpr double kBrief_s = 60;  ///< Trials are brief where less time is left.

uint32_t seedOf(const RenderSettings& settings) { return hashCombine(lightSeedOf(settings), randomStream("targ")); }

ErrorTarget targetOf(const RenderSettings& settings) {
  return {settings.targetError, settings.targetSmudges > 0 ? settings.targetSmudges : settings.targetError};
}

bool errorIsNear(const AuditReport& report, const ErrorTarget& target) {
  return !report.picture.tells() || report.picture.mean <= kTolerance * target.error;
}

bool smudgesAreNear(const AuditReport& report, const ErrorTarget& target) {
  const SmudgeEstimate* smudges = report.finestSmudges();
  return !smudges || !smudges->tells() || smudges->deviation <= kTolerance * target.smudges;
}

std::string wordsFor(const LightQuality& quality) {
  const std::string options = optionsOf(quality);
  return options.empty() ? "the scene's own settings are kept" : "chose " + options;
}

class TargetSearch {
 public:
  TargetSearch(FrameJob& job, const DeepFrame& layout, const TileReader& tiles, const RenderSettings& settings,
               Stats& stats, Log& log)
      : job_(job),
        layout_(layout),
        tiles_(tiles),
        settings_(settings),
        target_(targetOf(settings)),
        stats_(stats),
        log_(log) {}

  void run() {
    const TrialPlan plan{.seed = seedOf(settings_),
                         .likely = [&](const ErrorModel& m) { return m.cheapest(target_ * kMargin); }};
    TrialsResult trials = makeTrials(job_, layout_, tiles_, plan, stats_);
    if (interrupted()) return;
    ErrorModel& model = trials.model;
    LightQuality quality = model.cheapest(target_ * kMargin);
    tellChoice(trials, quality);
    for (int attempt = 1;; ++attempt) {
      job_.setQuality(quality);
      job_.gather(layout_, tiles_);
      if (interrupted()) return;
      const AuditReport report =
          job_.audit(layout_, tiles_, hashCombine(seedOf(settings_), static_cast<uint32_t>(attempt)));
      if (interrupted()) return;
      // More rays in the picture do not quieten the audit.
      const bool isNear = errorIsNear(report, target_) && smudgesAreNear(report, target_);
      const SmudgeEstimate* smudges = report.finestSmudges();
      model.correct({quality, report.indirect ? report.indirect->mean : 0, report.direct ? report.direct->mean : 0,
                     smudges ? smudges->deviation : 0});
      const LightQuality better = model.cheapest(target_ * kMargin);
      if (isNear || attempt == kMostAttempts || better == quality) return finish(quality, report, attempt);
      quality = better;
    }
  }

 private:
  void tellChoice(const TrialsResult& trials, const LightQuality& quality) {
    const double expected = trials.model.error(quality), smudges = trials.model.smudges(quality);
    const bool isBeyond = expected > target_.error || smudges > target_.smudges;
    log_.report(
        Severity::Note, "target-error", {},
        fmt::format("{} for a mean error of {:.3g} % and smudges of {:.3g} %: trials in {} of {} buckets expect {:.2g} "
                    "% and {:.2g} %, by about {:.2g} million rays or {} here and now{}",
                    wordsFor(quality), 100 * target_.error, 100 * target_.smudges, trials.buckets, trials.ofBuckets,
                    100 * expected, 100 * smudges, trials.model.cost(quality) / 1e6,
                    trials.timeOf(trials.model.cost(quality)),
                    isBeyond ? "; that is the least error of all settings within the range of the model" : ""));
  }

  void finish(const LightQuality& quality, const AuditReport& report, int attempts) {
    job_.tellAudit(report);
    describeQuality(job_.scene().options, optionsOf(quality), settings_);
    tellMissed(report, settings_,
               fmt::format("{}, after {} of at most {} attempts", optionsOf(quality), attempts, kMostAttempts), log_);
    if (settings_.onQuality) settings_.onQuality(quality);
  }

  FrameJob& job_;
  const DeepFrame& layout_;
  const TileReader& tiles_;
  const RenderSettings& settings_;
  const ErrorTarget target_;
  Stats& stats_;
  Log& log_;
};

}  // namespace

void tellMissed(const AuditReport& report, const RenderSettings& settings, const std::string& with, Log& log) {
  const ErrorTarget target = targetOf(settings);
  const ErrorEstimate& error = report.picture;
  if (!error.tells() && error.noise > target.error)
    log.report(Severity::Warning, "target-unproved", {},
               fmt::format("a mean error of {:.3g} % was asked, and the audit's own noise of {:.2g} % hides whether it "
                           "is reached, with {}",
                           100 * target.error, 100 * error.noise, with));
  std::string missed;
  if (!errorIsNear(report, target))
    missed = fmt::format("a mean error of {:.3g} % was asked, and {:.2g} % ({:.2g} to {:.2g}) reached",
                         100 * target.error, 100 * error.mean, 100 * error.low, 100 * error.high);
  if (const SmudgeEstimate* s = report.finestSmudges(); !smudgesAreNear(report, target))
    missed +=
        fmt::format("{}smudges of {:.3g} % were asked, and {:.2g} % ({:.2g} to {:.2g}) reached",
                    missed.empty() ? "" : "; ", 100 * target.smudges, 100 * s->deviation, 100 * s->low, 100 * s->high);
  if (!missed.empty()) log.report(Severity::Warning, "target-missed", {}, fmt::format("{}, with {}", missed, with));
}

void reachTargetError(FrameJob& job, const DeepFrame& layout, const TileReader& tiles, const RenderSettings& settings,
                      Stats& stats, Log& log) {
  TargetSearch(job, layout, tiles, settings, stats, log).run();
}

void useTimeBudget(FrameJob& job, const DeepFrame& layout, const TileReader& tiles, const RenderSettings& settings,
                   Stats& stats, Log& log) {
  job.writeSketch(layout, tiles);
  const auto remaining_s = [&] { return std::max(0.0, settings.timeBudget_s - job.elapsed_s()); };
  const TrialPlan plan{CostUnit::Seconds, remaining_s() < kBrief_s, seedOf(settings),
                       [&](const ErrorModel& m) { return m.best(kShareToPlan * remaining_s()); },
                       [&] { return kShareOfNarrowTrial * remaining_s(); }};
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
  if (settings.onQuality) settings.onQuality(quality);
  if (planned_s > 0) return;
  log.report(
      Severity::Warning, "time-over", {},
      fmt::format("{:.3g} s are too short: hiding and trials alone took {:.3g} s; light has the coarsest settings",
                  settings.timeBudget_s, settings.timeBudget_s - planned_s / kShareToPlan));
}

}  // namespace tomales
