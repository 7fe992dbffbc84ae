#include "reyes/app/frame/trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "reyes/app/frame/audit.h"
#include "reyes/app/frame/frame_stages.h"
#include "reyes/base/morton.h"
#include "reyes/base/rng.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

/// The quality of trials: the base, one with four times the rays, and one with wider records.
constexpr LightQuality kBaseOfRecords{150, 1, 4}, kFinerRecords{600, 1, 16}, kWiderRecords{150, 2, 4};
constexpr LightQuality kBaseOfPaths{16, -1, 0}, kFinerPaths{64, -1, 0};
constexpr LightQuality kBaseOfLights{0, -1, 4}, kFinerLights{0, -1, 16};
/// One bucket in kBucketsPerTrial is tried, but at least kFewestBuckets.
constexpr size_t kBucketsPerTrial = 40, kFewestBuckets = 16;
constexpr size_t kPixelsOfBriefTrials = 100;
/// Where only the error of lamps is wanted, as a share of all light, this many paths at each point find the indirect
/// light.
constexpr int kPathsBesideLamps = 16;
constexpr size_t kSmudgeSizesOfTrials = 1;  ///< Blocks larger than the smallest lie in several buckets.
/// Records with a maxError below this share of the base's count as much narrower.
constexpr float kMuchNarrower = 1 / 1.5f;

/// Returns some of these buckets in order. They are spread over the picture: each equal piece of Morton's curve has
/// one, which a hash of its place chooses.
std::vector<size_t> someOf(const std::vector<size_t>& seen, const DeepFrame& layout, uint32_t seed) {
  std::vector<vec3> places;
  for (const size_t t : seen) {
    const PixelRect r = layout.rectOf(t);
    places.emplace_back(r.x0, r.y0, 0);
  }
  const std::vector<uint32_t> curve = mortonOrder(places);
  const size_t count = std::min(seen.size(), std::max(kFewestBuckets, seen.size() / kBucketsPerTrial));
  const auto order = [&](uint32_t i) {
    return std::pair(hashCombine(static_cast<uint32_t>(places[i].x), static_cast<uint32_t>(places[i].y), seed), i);
  };
  std::vector<size_t> out;
  for (size_t piece = 0; piece < count; ++piece) {
    const auto first = curve.begin() + static_cast<ptrdiff_t>(piece * seen.size() / count),
               last = curve.begin() + static_cast<ptrdiff_t>((piece + 1) * seen.size() / count);
    out.push_back(seen[*std::ranges::min_element(first, last, {}, order)]);
  }
  std::ranges::sort(out);
  return out;
}

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Returns the number of points of each bucket that sees something.
std::map<size_t, double> pointsIn(const FrameLight& light) {
  std::map<size_t, double> out;
  for (size_t t = 0; t < light.layout().tileCount(); ++t)
    if (const auto tile = light.tiles()(t); tile && !tile->fragments.empty()) out[t] = pointsOf(*tile);
  return out;
}

std::vector<size_t> bucketsOf(const std::map<size_t, double>& points) {
  std::vector<size_t> out;
  for (const auto& [bucket, count] : points) out.push_back(bucket);
  return out;
}

/// Returns the light of these buckets alone.
FrameLight within(const FrameLight& light, std::span<const size_t> which) {
  const auto read = [tiles = light.tiles(), buckets = std::set(which.begin(), which.end())](size_t t) {
    return buckets.contains(t) ? tiles(t) : nullptr;
  };
  return {light.job(), light.layout(), read};
}

class Trials {
 public:
  Trials(const FrameLight& light, const TrialSettings& settings)
      : job_(light.job()),
        frame_(light),
        settings_(settings),
        points_(pointsIn(light)),
        seen_(bucketsOf(points_)),
        some_(someOf(seen_, light.layout(), settings.seed)),
        light_(within(light, some_)) {}

  TrialsResult run() {
    const bool paths = job_.method().isReference, records = job_.method().caches;
    const LightQuality& base = paths ? kBaseOfPaths : records ? kBaseOfRecords : kBaseOfLights;
    const LightQuality& finer = paths ? kFinerPaths : records ? kFinerRecords : kFinerLights;
    AuditSettings settings = frame_.auditSettings(settings_.seed);
    settings.lightSamples = fewer(finer.lightSamples);
    settings.leastError = settings_.matters.error;
    settings.leastSmudges = settings_.matters.smudges;
    settings.smudgeSizes = kSmudgeSizesOfTrials;
    if (settings_.isBrief) settings.pixels = kPixelsOfBriefTrials;
    if (records && settings.indirect) {
      settings.direct = false;
      recordAudit_.emplace(light_.layout(), light_.tiles(), job_.scene(), job_.shading(), settings, processStop());
      settings.direct = true;
      settings.indirect = false;
    }
    if (records) settings.smudgeSizes = 0;
    audit_.emplace(frame_.layout(), frame_.tiles(), job_.scene(), job_.shading(), settings, processStop());
    const QualityTrial first = trial(base), second = trial(finer);
    const std::optional<QualityTrial> third = records ? std::optional(trial(kWiderRecords)) : std::nullopt;
    ErrorModel model(first, second, third);
    if (records) tryNarrower(first, model);
    std::vector<size_t> tried = some_;
    std::stable_sort(tried.begin(), tried.end(), [&](size_t a, size_t b) { return points_.at(a) > points_.at(b); });
    return {model, seen_, tried, second.quality.lightSamples, audit_s_, light_s_ > 0 ? lightRays_ / light_s_ : 0};
  }

 private:
  void tryNarrower(const QualityTrial& base, ErrorModel& model) {
    const float maxError = settings_.likely(model).maxError;
    if (!(maxError > 0 && maxError < kMuchNarrower * base.quality.maxError)) return;
    LightQuality quality = base.quality;
    quality.maxError = maxError;
    if (model.gatherCostOf(1 / inFrame(), quality) <= settings_.mostOfNarrow()) model.addNarrower(trialOf(quality));
  }

  int fewer(int rays) const { return rays > 0 ? std::max(1, rays / settings_.fewerRays) : rays; }

  QualityTrial trial(LightQuality quality) {
    quality.samples = fewer(quality.samples);
    quality.lightSamples = fewer(quality.lightSamples);
    return trialOf(quality);
  }

  /// Returns the number of buckets of the frame for each that is tried.
  double inFrame() const {
    return static_cast<double>(seen_.size()) / std::max<double>(1, static_cast<double>(some_.size()));
  }

  QualityTrial trialOf(const LightQuality& quality) {
    QualityTrial out{quality};
    job_.setQuality(quality);
    const double gathering = costOf([&] { light_.gatherRecords(); });
    if (job_.services()) out.bounceCost = inUnit(job_.services()->bounceCost());
    out.gatherCost = inFrame() * std::max(0.0, gathering - out.bounceCost);
    out.shadeCost = shadeCost();
    const double before_s = seconds();
    ShadeContext context = job_.shadeContext();
    if (recordAudit_) context.auditPaths = kPathsBesideLamps;
    addErrors(audit_->of(context), out);
    if (recordAudit_) addErrors(recordAudit_->of(job_.shadeContext()), out);
    audit_s_ += seconds() - before_s;
    return out;
  }

  static void addErrors(const AuditReport& report, QualityTrial& out) {
    if (report.indirect) out.indirect = report.indirect->mean;
    if (report.direct) out.direct = report.direct->mean;
    if (const SmudgeEstimate* smudges = report.finestSmudges()) out.smudges = smudges->deviation;
  }

  /// Returns the cost of shading. Single pixels cost more than whole buckets, where neighbours share points. Time is
  /// measured on whole buckets, because small pieces say little about it; rays are counted at the audit's pixels.
  double shadeCost() {
    double all = 0, some = 0;
    for (const auto& [tile, points] : points_) all += points;
    for (const size_t t : some_) some += points_.at(t);
    ShadeContext context = job_.shadeContext();
    if (recordAudit_) context.indirect = false;  // lookups trace no rays
    if (settings_.unit == CostUnit::Seconds) return all / std::max(1.0, some) * secondsToShade(light_, some_);
    return all / std::max(1.0, audit_->pointCount()) * costOf([&] { audit_->shade(context); });
  }

  double inUnit(const GiServices::BounceCost& cost) const {
    return settings_.unit == CostUnit::Seconds ? cost.time_s : cost.rays;
  }

  template <class Work>
  double costOf(const Work& work) {
    const double rays = job_.stats().lightRays(), time_s = seconds();
    work();
    const double moreRays = job_.stats().lightRays() - rays, more_s = seconds() - time_s;
    lightRays_ += moreRays;
    light_s_ += more_s;
    return settings_.unit == CostUnit::Seconds ? more_s : moreRays;
  }

  FrameJob& job_;
  const FrameLight& frame_;
  const TrialSettings settings_;
  const std::map<size_t, double> points_;
  const std::vector<size_t> seen_, some_;
  FrameLight light_;  ///< That of the buckets that are tried.
  /// The error of records is found in the buckets that have them. Lamps and paths need none, and are audited in the
  /// whole frame: a lamp's noise lies in its penumbras, which are in few buckets.
  std::optional<Audit> audit_, recordAudit_;
  double audit_s_ = 0, light_s_ = 0, lightRays_ = 0;
};

}  // namespace

std::string TrialsResult::timeOf(double rays) const {
  const double time_s = raysPerSecond > 0 ? rays / raysPerSecond : 0;
  if (time_s < 100) return fmt::format("{:.2g} s", time_s);
  return time_s < 6000 ? fmt::format("{:.0f} min", time_s / 60) : fmt::format("{:.0f} h", time_s / 3600);
}

QualityTrial secondsToGather(const FrameLight& light, std::span<const size_t> which, const LightQuality& quality) {
  QualityTrial out{quality};
  light.job().setQuality(quality);
  const double start_s = seconds();
  within(light, which).gatherRecords();
  if (light.job().services()) out.bounceCost = light.job().services()->bounceCost().time_s;
  out.gatherCost = std::max(0.0, seconds() - start_s - out.bounceCost);
  return out;
}

double secondsToShade(const FrameLight& light, std::span<const size_t> which) {
  constexpr size_t kAtOnce = 64;
  const double start_s = seconds();
  for (size_t first = 0; first < which.size() && !stopRequested(); first += kAtOnce) {
    std::vector<DeepTile> copies;
    for (const size_t t : which.subspan(first, std::min(kAtOnce, which.size() - first)))
      if (const auto tile = light.tiles()(t)) copies.push_back(*tile);
    shadeApart(light.job(), copies, {});
  }
  return seconds() - start_s;
}

TrialsResult makeTrials(const FrameLight& light, const TrialSettings& settings) {
  const StageTimer timer(light.job().stats(), "trials");
  return Trials(light, settings).run();
}

}  // namespace tomales
