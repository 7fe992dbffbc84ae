#include "reyes/app/frame/time_budget.h"

#include <fmt/format.h>

#include <algorithm>

#include "reyes/app/frame/provenance.h"
#include "reyes/app/frame/target.h"
#include "reyes/app/frame/trials.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

constexpr double kShareToPlan = 0.96;  ///< Share of the time left that is planned.
/// Shares of the time left that a trial of narrow records, the first round, and shading for measurement may take.
constexpr double kShareOfNarrowTrial = 0.1, kShareOfFirstRound = 0.15, kShareOfMeasuring = 0.2;
/// The first round, and shading for measurement, have this many times fewer rays.
constexpr int kFewerInFirst = 8;
constexpr int kLeastRays = 20;  ///< Least number of rays of a record in the first round.
constexpr int kMostRounds = 4;
constexpr double kBetter = 0.95;      ///< Another round is worth it if the error falls to this share.
constexpr double kMuchBetter = 0.85;  ///< Records of another width are worth it if the error falls to this share.
/// A round has at most this many times the rays of the one before, from which the cost of rays is known.
constexpr int kMostGrowth = 12;
constexpr double kShareOfProbe = 0.12;  ///< Share of the time left that a probe may take.
constexpr size_t kBucketsOfProbe = 16;  ///< At most one bucket in this many is probed for the cost of more rays.
/// Limit of the factor by which light samples are cut when gathering was late: a late picture is better than noise.
constexpr int kMostCutOfLights = 4;
constexpr double kBrief_s = 60;  ///< Trials are brief where less time is left.
constexpr int kFewerInBriefTrials = 4;

class BudgetedFrame {
 public:
  explicit BudgetedFrame(FrameLight& light)
      : light_(light), job_(light.job()), settings_(job_.settings()), log_(job_.log()), trials_(makeTrials()) {}

  void run() {
    const double planned_s = left_s();
    if (job_.gathers())
      gatherInRounds();
    else
      choose(trials_.model.best(left_s()));
    if (stopRequested()) return;
    measureShading();
    if (stopRequested()) return;
    spendRest();
    tell(planned_s);
  }

 private:
  TrialsResult makeTrials() {
    writeSketch(light_);
    const auto remaining_s = [&] { return std::max(0.0, settings_.quality.timeBudget_s - job_.elapsed_s()); };
    const bool isBrief = remaining_s() < kBrief_s;
    const TrialSettings trialSettings{
        .unit = CostUnit::Seconds,
        .isBrief = isBrief,
        .fewerRays = isBrief ? kFewerInBriefTrials : 1,
        .seed = seedOfTrials(settings_),
        .likely = [=](const ErrorModel& m) { return m.best(kShareToPlan * remaining_s()); },
        .mostOfNarrow = [=] { return kShareOfNarrowTrial * remaining_s(); }};
    return tomales::makeTrials(light_, trialSettings);
  }

  /// Returns the time that gathering and shading may take from now on; negative if there is nothing left.
  double left_s() const {
    // An audit takes many times as many light samples as the picture.
    const double audit_s =
        settings_.quality.audit > 0
            ? trials_.audit_s * std::max(1, quality_.lightSamples / std::max(1, trials_.lightSamples))
            : 0;
    return kShareToPlan * (settings_.quality.timeBudget_s - job_.elapsed_s() - audit_s);
  }

  void choose(const LightQuality& quality) {
    quality_ = quality;
    job_.setQuality(quality);
  }

  /// Gathers in rounds. Only the whole frame shows how many records it needs, and what records of further bounces cost.
  /// So the first round has few rays, and later rounds use the time that is left.
  void gatherInRounds() {
    ErrorModel& model = trials_.model;
    LightQuality next = firstRound();
    for (int round = 1;; ++round) {
      choose(next);
      const double before_s = job_.elapsed_s();
      light_.gatherShown();
      if (stopRequested()) return;
      const double took_s = job_.elapsed_s() - before_s;
      tellStep("gathering", quality_, model.gatherCost(quality_), took_s);
      model.correctGatherCost(quality_, took_s);
      const double left = std::max(0.0, left_s());
      next = bestAfter(quality_, left);
      const LightQuality stays = model.bestLightSamples(quality_, left);
      if (round == kMostRounds || model.cost(next) > left || model.error(next) > kBetter * model.error(stays)) break;
      if (round > 1 || !mayProbe(next, left)) continue;
      learnRays(quality_.samples, next);
      if (stopRequested()) return;
      model.correctGatherCost(quality_, took_s);
      next = bestAfter(quality_, std::max(0.0, left_s()));
      if (model.error(next) > model.error(quality_)) next = quality_;  // the probe took too long
    }
    light_.endGather();
  }

  /// Returns the best quality after a round. Another width of records changes their number, so the measured costs no
  /// longer hold.
  LightQuality bestAfter(const LightQuality& last, double left) const {
    const LightQuality any = trials_.model.best(left), asWide = trials_.model.bestAsWide(last, left);
    const bool fills = trials_.model.cost(asWide) > kBetter * left;
    LightQuality out = !fills || trials_.model.error(any) < kMuchBetter * trials_.model.error(asWide) ? any : asWide;
    out.samples = std::min(out.samples, kMostGrowth * last.samples);
    return out;
  }

  static LightQuality withFewRays(LightQuality q) {
    q.samples = std::max(std::min(q.samples, kLeastRays), q.samples / kFewerInFirst);
    return q;
  }

  size_t bucketsOfProbe() const {
    return std::min(trials_.tried.size(), std::max<size_t>(1, trials_.seen.size() / kBucketsOfProbe));
  }

  bool mayProbe(const LightQuality& many, double left) const {
    const double share =
        static_cast<double>(bucketsOfProbe()) / std::max<double>(1, static_cast<double>(trials_.seen.size()));
    LightQuality few = many;
    few.samples = quality_.samples;
    const double cost = trials_.model.gatherCostOf(share, few) + trials_.model.gatherCostOf(share, many);
    return many.samples >= 2 * quality_.samples && cost < kShareOfProbe * left;
  }

  /// Learns the cost of rays from a few buckets: the cost per ray falls with their number, by a factor that depends on
  /// the scene.
  void learnRays(int fewer, const LightQuality& many) {
    LightQuality few = many;
    few.samples = fewer;
    const size_t count = bucketsOfProbe();
    const std::span<const size_t> which = std::span(trials_.tried).first(count);
    const QualityTrial cheap = secondsToGather(light_, which, few);
    if (stopRequested()) return;
    const QualityTrial dear = secondsToGather(light_, which, many);
    log_.report(Severity::Info, "time-budget", {},
                fmt::format("after {:.3g} s: {} buckets took {:.3g} s with {} and {:.3g} s with {}", job_.elapsed_s(),
                            count, cheap.gatherCost + cheap.bounceCost, optionsOf(few),
                            dear.gatherCost + dear.bounceCost, optionsOf(many)));
    trials_.model.learnRays(cheap, dear);
  }

  LightQuality firstRound() const {
    const double left = std::max(0.0, left_s());
    const LightQuality out = withFewRays(trials_.model.best(left));
    return trials_.model.gatherCost(out) <= kShareOfFirstRound * left ? out
                                                                      : trials_.model.best(kShareOfFirstRound * left);
  }

  /// Shades the whole frame with few samples, if that is a cheap way to learn the cost of shading it with more.
  void measureShading() {
    const double left = std::max(0.0, left_s());
    const LightQuality planned = job_.gathers() ? trials_.model.bestLightSamples(quality_, left) : quality_;
    LightQuality few = planned;
    if (few.lightSamples > 1) few.lightSamples = std::max(1, few.lightSamples / kFewerInFirst);
    if (!job_.gathers() && few.samples > 1) few.samples = std::max(1, few.samples / kFewerInFirst);
    if (few == planned || trials_.model.shadeCost(few) > kShareOfMeasuring * left) return;
    if (job_.gathers())
      job_.setLightSamples(few.lightSamples);
    else
      job_.setQuality(few);
    const double took_s = secondsToShade(light_, trials_.seen);
    tellStep("shading", few, trials_.model.shadeCost(few), took_s);
    trials_.model.correctShadeCost(few, took_s);
  }

  void tellStep(const char* step, const LightQuality& quality, double expected_s, double took_s) {
    log_.report(Severity::Info, "time-budget", {},
                fmt::format("after {:.3g} s: {} with {} was expected to take {:.3g} s, and took {:.3g} s",
                            job_.elapsed_s(), step, optionsOf(quality), expected_s, took_s));
  }

  void spendRest() {
    const double left = std::max(0.0, left_s());
    if (job_.gathers()) {
      const int fewest = quality_.lightSamples / kMostCutOfLights;
      quality_ = trials_.model.bestLightSamples(quality_, left);
      quality_.lightSamples = std::max(quality_.lightSamples, fewest);
      job_.setLightSamples(quality_.lightSamples);
    } else {
      quality_ = trials_.model.best(left);
      choose(trials_.model.bestLightSamples(quality_, left));
    }
  }

  void tell(double planned_s) {
    log_.report(
        Severity::Note, "time-budget", {},
        fmt::format("{} for {:.3g} s: trials in {} of {} buckets expect a mean error of {:.2g} %; shading "
                    "begins after {:.3g} s and takes about {:.2g} s",
                    wordsFor(quality_), settings_.quality.timeBudget_s, trials_.tried.size(), trials_.seen.size(),
                    100 * trials_.model.error(quality_), job_.elapsed_s(), trials_.model.shadeCost(quality_)));
    describeQuality(job_.scene().options, optionsOf(quality_), settings_);
    if (settings_.quality.onQuality) settings_.quality.onQuality(quality_);
    if (planned_s > 0) return;
    log_.report(
        Severity::Warning, "time-over", {},
        fmt::format("{:.3g} s are too short: hiding and trials alone took {:.3g} s; light has the coarsest settings",
                    settings_.quality.timeBudget_s, settings_.quality.timeBudget_s - planned_s / kShareToPlan));
  }

  FrameLight& light_;
  FrameJob& job_;
  const RenderSettings& settings_;
  Log& log_;
  TrialsResult trials_;
  LightQuality quality_;
};

}  // namespace

void useTimeBudget(FrameLight& light) { BudgetedFrame(light).run(); }

}  // namespace tomales
