#include "reyes/app/frame/target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reyes/app/frame/provenance.h"
#include "reyes/app/frame/trials.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

constexpr int kMostAttempts = 3;
constexpr double kMargin = 0.9;  ///< Share of the target to aim at: some pictures have larger errors than predicted.
/// Errors below this share of the target may be hidden by the noise of an audit.
constexpr double kMatters = 0.7;
/// Trials have all their rays for this target and finer ones. For coarser targets, they have fewer in proportion, down
/// to one in kFewestInTrials.
constexpr double kFinestTarget = 0.01;
constexpr int kFewestInTrials = 2;
/// At least this share of the target is left for other errors than that of highlights, because less would cost more
/// than it brings.
constexpr double kLeastLeft = 0.7;
constexpr double kMuchOfTarget = 0.5;  ///< Highlights that err by this share of the target are named if it is missed.
constexpr double kTolerance = 1.1;     ///< A picture is lit again if its error is this many times the target.

ErrorTarget targetOf(const QualitySettings& settings) {
  return {settings.targetError, settings.targetSmudges > 0 ? settings.targetSmudges : settings.targetError};
}

int fewerRaysFor(double target) {
  return std::clamp(static_cast<int>(std::lround(target / kFinestTarget)), 1, kFewestInTrials);
}

bool errorIsNear(const AuditReport& report, const ErrorTarget& target) {
  return !report.picture.tells() || report.picture.mean <= kTolerance * target.error;
}

/// A few blocks have most of the smudges, so that an audit tells them from the target only if they are far from it.
bool smudgesAreFar(const AuditReport& report, const ErrorTarget& target) {
  const SmudgeEstimate* smudges = report.finestSmudges();
  return smudges && smudges->tells() && smudges->low > target.smudges &&
         smudges->deviation > kTolerance * target.smudges;
}

/// Returns what to believe of an error of which the model expects this. Estimate: ErrorEstimate or SmudgeEstimate.
template <class Estimate>
double believed(double expected, double seen, const Estimate& audit) {
  return audit.tells() ? likelyError(expected, seen, audit.low, audit.high) : std::min(expected, audit.high);
}

class TargetSearch {
 public:
  explicit TargetSearch(FrameLight& light)
      : light_(light),
        job_(light.job()),
        settings_(job_.settings()),
        target_(targetOf(settings_.quality)),
        log_(job_.log()) {}

  void run() {
    const TrialSettings trialSettings{.fewerRays = fewerRaysFor(target_.error),
                                      .matters = target_ * kMatters,
                                      .seed = seedOfTrials(settings_),
                                      .likely = [&](const ErrorModel& m) { return cheapest(m); }};
    TrialsResult trials = makeTrials(light_, trialSettings);
    if (stopRequested()) return;
    ErrorModel& model = trials.model;
    LightQuality quality = cheapest(model);
    tellChoice(trials, quality);
    for (int attempt = 1;; ++attempt) {
      gather(quality, attempt == 1);
      if (stopRequested()) return;
      const AuditReport report =
          light_.audit(hashCombine(seedOfTrials(settings_), static_cast<uint32_t>(attempt)), target_ * kMatters);
      if (stopRequested()) return;
      // More rays in the picture do not reduce the noise of the audit.
      const QualityTrial errors = believedErrors(model, quality, report);
      const bool isNear =
          errorIsNear(report, target_) && smudgesAreNear(report, model.smudges(quality), errors.smudges);
      model.correct(errors);
      if (report.highlights && report.highlights->tells()) highlights_ = report.highlights->mean;
      const LightQuality better = cheapest(model, job_.method().caches ? std::optional(quality) : std::nullopt);
      if (isNear || attempt == kMostAttempts || better == quality) return finish(quality, report, attempt);
      tellAgain(report, better);
      quality = better;
    }
  }

 private:
  bool namesSmudges() const { return settings_.quality.targetSmudges > 0; }

  /// Returns the error to aim at beside that of highlights, which no settings change.
  double aimedError() const {
    const double all = kMargin * target_.error, left = all * all - highlights_ * highlights_;
    return std::max(std::sqrt(std::max(left, 0.0)), kLeastLeft * all);
  }

  LightQuality cheapest(const ErrorModel& model, const std::optional<LightQuality>& gathered = {}) const {
    const ErrorTarget aim{aimedError(), kMargin * target_.smudges};
    return namesSmudges() ? model.cheapest(aim, gathered) : model.cheapestOfError(aim, gathered);
  }

  /// Returns false if the smudges are larger than asked, although they were to be reached.
  bool smudgesAreNear(const AuditReport& report, double expected, double seen) const {
    if (!namesSmudges() && expected > target_.smudges) return true;
    return !smudgesAreFar(report, target_) && seen <= kTolerance * target_.smudges;
  }

  /// Keeps the records that there are if they are as asked: only lamps have other samples.
  void gather(const LightQuality& quality, bool isFirst) {
    if (!isFirst && job_.method().caches && quality.hasRecordsOf(job_.quality()))
      return job_.setLightSamples(quality.lightSamples);
    job_.setQuality(quality);
    light_.gather();
  }

  void tellChoice(const TrialsResult& trials, const LightQuality& quality) {
    const double expected = trials.model.error(quality), smudges = trials.model.smudges(quality);
    const std::string least =
        fmt::format("{:.2g} % and {:.2g} %, by about {:.2g} million rays or {} here and now", 100 * expected,
                    100 * smudges, trials.model.cost(quality) / 1e6, trials.timeOf(trials.model.cost(quality)));
    if (expected > target_.error || smudges > target_.smudges)
      log_.report(
          Severity::Warning, "target-beyond", {},
          fmt::format("a mean error of {:.3g} % and smudges of {:.3g} % are beyond what rays, records and light "
                      "samples can reach here: {} are expected {}",
                      100 * target_.error, 100 * target_.smudges, least,
                      expected > target_.error || namesSmudges() ? "at best, and tried" : "for the mean error alone"));
    log_.report(
        Severity::Note, "target-error", {},
        fmt::format("{} for a mean error of {:.3g} % and smudges of {:.3g} %: trials in {} of {} buckets expect {}",
                    wordsFor(quality), 100 * target_.error, 100 * target_.smudges, trials.tried.size(),
                    trials.seen.size(), least));
  }

  static QualityTrial believedErrors(const ErrorModel& model, const LightQuality& quality, const AuditReport& report) {
    QualityTrial out{quality};
    if (report.indirect) out.indirect = believed(model.indirectError(quality), report.indirect->mean, *report.indirect);
    if (report.direct) out.direct = believed(model.directError(quality), report.direct->mean, *report.direct);
    if (const SmudgeEstimate* s = report.finestSmudges())
      out.smudges = believed(model.smudges(quality), s->deviation, *s);
    return out;
  }

  void tellAgain(const AuditReport& report, const LightQuality& better) {
    const SmudgeEstimate* smudges = report.finestSmudges();
    log_.report(Severity::Note, "target-again", {},
                fmt::format("mean error {:.2g} %{}: the frame is lit again, with {}", 100 * report.picture.mean,
                            smudges ? fmt::format(" and smudges of {:.2g} %", 100 * smudges->deviation) : "",
                            optionsOf(better)));
  }

  void finish(const LightQuality& quality, const AuditReport& report, int attempts) {
    light_.tellAudit(report);
    const std::string options = optionsOf(quality);
    describeQuality(job_.scene().options, options, settings_);
    tellMissed(report, settings_.quality,
               fmt::format("{}, after {} of at most {} attempts",
                           options.empty() ? "the scene's own settings" : options, attempts, kMostAttempts),
               log_);
    if (settings_.quality.onQuality) settings_.quality.onQuality(quality);
  }

  FrameLight& light_;
  FrameJob& job_;
  const RenderSettings& settings_;
  const ErrorTarget target_;
  Log& log_;
  double highlights_ = 0;  ///< Error of the highlights of indirect light in the last picture.
};

}  // namespace

uint32_t seedOfTrials(const RenderSettings& settings) {
  return hashCombine(lightSeedOf(settings), randomStream("targ"));
}

std::string wordsFor(const LightQuality& quality) {
  const std::string options = optionsOf(quality);
  return options.empty() ? "the scene's own settings are kept" : "chose " + options;
}

void tellMissed(const AuditReport& report, const QualitySettings& settings, const std::string& with, Log& log) {
  const ErrorTarget target = targetOf(settings);
  const ErrorEstimate& error = report.picture;
  if (!error.tells() && error.noise > target.error)
    log.report(
        Severity::Warning, "target-unproved", {},
        fmt::format("a mean error of {:.3g} % was asked for, and the audit's own noise of {:.2g} % hides whether it "
                    "is reached, with {}",
                    100 * target.error, 100 * error.noise, with));
  std::string missed;
  if (!errorIsNear(report, target))
    missed = fmt::format("a mean error of {:.3g} % was asked for, and {:.2g} % ({:.2g} to {:.2g}) was reached",
                         100 * target.error, 100 * error.mean, 100 * error.low, 100 * error.high);
  if (!missed.empty() && report.highlights && report.highlights->mean > kMuchOfTarget * target.error)
    missed += fmt::format(
        " (the highlights of indirect light err by {:.2g} %, which no rays mend: --gi reference traces them)",
        100 * report.highlights->mean);
  if (const SmudgeEstimate* s = report.finestSmudges(); smudgesAreFar(report, target))
    missed +=
        fmt::format("{}smudges of {:.3g} % were asked for, and {:.2g} % ({:.2g} to {:.2g}) were reached",
                    missed.empty() ? "" : "; ", 100 * target.smudges, 100 * s->deviation, 100 * s->low, 100 * s->high);
  if (!missed.empty()) log.report(Severity::Warning, "target-missed", {}, fmt::format("{}, with {}", missed, with));
}

void reachTargetError(FrameLight& light) { TargetSearch(light).run(); }

}  // namespace tomales
