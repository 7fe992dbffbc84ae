#include "reyes/app/frame/trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <vector>

#include "reyes/app/frame/audit.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

/// The quality of trials: the base, one with four times the rays, and one with wider records.
constexpr LightQuality kBaseOfRecords{150, 1, 4}, kFinerRecords{600, 1, 16}, kWiderRecords{150, 2, 4};
constexpr LightQuality kBaseOfPaths{16, -1, 0}, kFinerPaths{64, -1, 0};
constexpr LightQuality kBaseOfLamps{0, -1, 4}, kFinerLamps{0, -1, 16};
/// One bucket of so many is tried, and no fewer than so many.
constexpr size_t kBucketsPerTrial = 16, kFewestBuckets = 8;
constexpr int kBriefness = 4;  ///< Brief trials have so many times fewer rays.
constexpr size_t kPixelsOfBriefTrials = 100;
constexpr size_t kSmudgeSizesOfTrials = 1;  ///< Larger blocks than the least lie in several buckets.
/// Records with a maxError below this share of the base's count as much narrower.
constexpr float kMuchNarrower = 1 / 1.5f;

/// Numbers, in order, of some of these buckets, chosen by a hash of their places.
std::vector<size_t> someOf(const std::vector<size_t>& seen, const DeepFrame& layout, uint32_t seed) {
  std::vector<std::pair<uint32_t, size_t>> order;
  for (const size_t t : seen) {
    const PixelRect r = layout.rectOf(t);
    order.emplace_back(hashCombine(static_cast<uint32_t>(r.x0), static_cast<uint32_t>(r.y0), seed), t);
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), std::max(kFewestBuckets, order.size() / kBucketsPerTrial)));
  std::vector<size_t> out;
  for (const auto& [hash, t] : order) out.push_back(t);
  std::sort(out.begin(), out.end());
  return out;
}

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

class Trials {
 public:
  Trials(FrameJob& job, const DeepFrame& layout, const TileReader& tiles, const TrialPlan& plan, Stats& stats)
      : job_(job), layout_(layout), plan_(plan), stats_(stats) {
    for (size_t t = 0; t < layout.tileCount(); ++t)
      if (const auto tile = tiles(t); tile && !tile->fragments.empty()) {
        seen_.push_back(t);
        points_[t] = pointsOf(*tile);
      }
    some_ = someOf(seen_, layout, plan.seed);
    tiles_ = [&tiles, some = some_](size_t t) {
      return std::binary_search(some.begin(), some.end(), t) ? tiles(t) : nullptr;
    };
  }

  TrialsResult run() {
    const bool paths = job_.method().isReference, records = job_.method().caches;
    const LightQuality& base = paths ? kBaseOfPaths : records ? kBaseOfRecords : kBaseOfLamps;
    const LightQuality& finer = paths ? kFinerPaths : records ? kFinerRecords : kFinerLamps;
    AuditPlan plan = job_.auditPlan(plan_.seed);
    plan.lightSamples = finer.lightSamples;
    plan.smudgeSizes = kSmudgeSizesOfTrials;
    if (plan_.isBrief) plan.pixels = kPixelsOfBriefTrials;
    Audit audit(layout_, tiles_, job_.scene(), job_.shading(), plan, interrupted());
    const QualityTrial first = trial(base, audit), second = trial(finer, audit);
    const std::optional<QualityTrial> third = records ? std::optional(trial(kWiderRecords, audit)) : std::nullopt;
    ErrorModel model(first, second, third);
    if (records) tryNarrower(first, model, audit);
    std::vector<size_t> tried = some_;
    std::stable_sort(tried.begin(), tried.end(), [&](size_t a, size_t b) { return points_.at(a) > points_.at(b); });
    return {model, seen_, tried, audit_s_, light_s_ > 0 ? lightRays_ / light_s_ : 0};
  }

 private:
  void tryNarrower(const QualityTrial& base, ErrorModel& model, Audit& audit) {
    const float maxError = plan_.likely(model).maxError;
    if (!(maxError > 0 && maxError < kMuchNarrower * base.quality.maxError)) return;
    LightQuality quality = base.quality;
    quality.maxError = maxError;
    if (model.gatherCostOf(1 / inFrame(), quality) <= plan_.mostOfNarrow()) model.addNarrower(trialOf(quality, audit));
  }

  QualityTrial trial(LightQuality quality, Audit& audit) {
    if (plan_.isBrief && quality.samples > 0) quality.samples /= kBriefness;
    if (plan_.isBrief && quality.lightSamples > 0) quality.lightSamples /= kBriefness;
    return trialOf(quality, audit);
  }

  /// Buckets of the frame for each that is tried.
  double inFrame() const {
    return static_cast<double>(seen_.size()) / std::max<double>(1, static_cast<double>(some_.size()));
  }

  QualityTrial trialOf(const LightQuality& quality, Audit& audit) {
    QualityTrial out{quality};
    job_.setQuality(quality);
    const double gathering = costOf([&] { job_.gatherRecords(layout_, tiles_); });
    if (job_.services()) out.bounceCost = inUnit(job_.services()->bounceCost());
    out.gatherCost = inFrame() * std::max(0.0, gathering - out.bounceCost);
    out.shadeCost = shadeCost(audit);
    const double before_s = seconds();
    const AuditReport report = audit.of(job_.shadeContext());
    audit_s_ += seconds() - before_s;
    if (report.indirect) out.indirect = report.indirect->mean;
    if (report.direct) out.direct = report.direct->mean;
    if (const SmudgeEstimate* smudges = report.finestSmudges()) out.smudges = smudges->deviation;
    return out;
  }

  /// Returns the cost of shading. Neighbouring pixels share points, so that pixels alone cost more. The time of small
  /// pieces says little of the time of whole buckets, and pixels say more of their rays.
  double shadeCost(const Audit& audit) {
    double all = 0, some = 0;
    for (const auto& [tile, points] : points_) all += points;
    for (const size_t t : some_) some += points_.at(t);
    if (plan_.unit == CostUnit::Seconds) return all / std::max(1.0, some) * secondsToShade(job_, tiles_, some_);
    return all / std::max(1.0, audit.pointCount()) * costOf([&] { audit.shade(job_.shadeContext()); });
  }

  double inUnit(const GiServices::BounceCost& cost) const {
    return plan_.unit == CostUnit::Seconds ? cost.time_s : cost.rays;
  }

  template <class Work>
  double costOf(const Work& work) {
    const double rays = stats_.lightRays(), time_s = seconds();
    work();
    const double moreRays = stats_.lightRays() - rays, more_s = seconds() - time_s;
    lightRays_ += moreRays;
    light_s_ += more_s;
    return plan_.unit == CostUnit::Seconds ? more_s : moreRays;
  }

  FrameJob& job_;
  const DeepFrame& layout_;
  const TrialPlan plan_;
  Stats& stats_;
  TileReader tiles_;                 ///< Reads the buckets that are tried.
  std::map<size_t, double> points_;  ///< Number of points of each tile that sees something.
  std::vector<size_t> seen_, some_;
  double audit_s_ = 0, light_s_ = 0, lightRays_ = 0;
};

}  // namespace

std::string TrialsResult::timeOf(double rays) const {
  const double time_s = raysPerSecond > 0 ? rays / raysPerSecond : 0;
  if (time_s < 100) return fmt::format("{:.2g} s", time_s);
  return time_s < 6000 ? fmt::format("{:.0f} min", time_s / 60) : fmt::format("{:.0f} h", time_s / 3600);
}

QualityTrial secondsToGather(FrameJob& job, const DeepFrame& layout, const TileReader& tiles,
                             std::span<const size_t> which, const LightQuality& quality) {
  QualityTrial out{quality};
  job.setQuality(quality);
  const double start_s = seconds();
  job.gatherRecords(layout, [&](size_t t) { return std::ranges::count(which, t) > 0 ? tiles(t) : nullptr; });
  if (job.services()) out.bounceCost = job.services()->bounceCost().time_s;
  out.gatherCost = std::max(0.0, seconds() - start_s - out.bounceCost);
  return out;
}

double secondsToShade(FrameJob& job, const TileReader& tiles, std::span<const size_t> which) {
  constexpr size_t kAtOnce = 64;
  const double start_s = seconds();
  for (size_t first = 0; first < which.size() && !interrupted(); first += kAtOnce) {
    std::vector<DeepTile> copies;
    for (const size_t t : which.subspan(first, std::min(kAtOnce, which.size() - first)))
      if (const auto tile = tiles(t)) copies.push_back(*tile);
    job.shadeApart(copies, nullptr, true);
  }
  return seconds() - start_s;
}

TrialsResult makeTrials(FrameJob& job, const DeepFrame& layout, const TileReader& tiles, const TrialPlan& plan,
                        Stats& stats) {
  const StageTimer timer(stats, "trials");
  return Trials(job, layout, tiles, plan, stats).run();
}

}  // namespace tomales
