#include "reyes/app/frame/error_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tomales {
namespace {

/// Noise and bias each have at least this share of an error's square: a trial may show none of it by chance.
constexpr double kLeastShare = 0.03;
/// Limits of the search around the base, in half octaves.
constexpr int kFewerRays = 6, kNarrower = 8, kFewerLightSamples = 4;
/// Records are no wider than those of the trials: in few pixels, wider ones err much more than a law of narrow ones
/// says.
constexpr int kWider = 2;
/// Absolute limits of the search, whatever the trials used.
constexpr int kMostRaysOfRecord = 9600, kMostPathsOfPoint = 1024, kMostLightSamples = 1024;
constexpr double kLeastRaysPower = 0.2, kMostRaysPower = 1.2;
/// Limits of the power of costs that were measured in the same buckets. Other powers are chance.
constexpr double kLeastKnownPower = 0.6, kMostKnownPower = 1;
/// The largest share of a cost that two trials may find to be fixed: the first trial also pays for reading files.
constexpr double kMostFixed = 0.95;
/// A cost that was measured at this many times a known setting shows how the cost changes.
constexpr double kFarFromKnown = 4;
constexpr double kDeviation = 0.25;        ///< Standard deviation of the logarithm of the model's errors.
constexpr double kLeastOfInterval = 0.05;  ///< The low end of an interval is at least this share of what was seen.
constexpr double kNormalAt95 = 1.645;      ///< The 95th percentile of the normal distribution.
constexpr int kFineSteps = 16;             ///< Steps per octave when a given time is to be used up.

/// Returns the power of x by which y changes between two trials, within limits.
double power(double x0, double y0, double x1, double y1, double least, double most) {
  if (!(y0 > 0) || !(y1 > 0) || x0 == x1) return std::clamp(0.0, least, most);
  return std::clamp(std::log(y1 / y0) / std::log(x1 / x0), least, most);
}

/// Rounds to two digits, so that messages show the options exactly.
double rounded(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::round(x / unit) * unit;
}

double halfOctaves(int steps) { return std::pow(2.0, 0.5 * steps); }

/// Returns the number of half octaves from x to `most`.
int stepsTo(double most, double x) { return x > 0 ? static_cast<int>(std::floor(2 * std::log2(most / x) + 1e-6)) : 0; }

double ratio(double x, double base) { return x > 0 && base > 0 ? x / base : 1; }

}  // namespace

std::string optionsOf(const LightQuality& q) {
  std::string out;
  const auto add = [&](const char* option, auto value) {
    out += fmt::format("{}{} {:.4g}", out.empty() ? "" : " ", option, static_cast<double>(value));
  };
  if (q.samples > 0) add("--samples", q.samples);
  if (q.maxError >= 0) add("--max-error", q.maxError);
  if (q.lightSamples > 0) add("--light-samples", q.lightSamples);
  return out;
}

double likelyError(double expected, double seen, double low, double high) {
  if (!(expected > 0) || !(seen > 0)) return seen;
  const double width = std::log(std::max(high, seen) / std::max(low, kLeastOfInterval * seen));
  const double deviation = width / (2 * kNormalAt95);
  return expected *
         std::pow(seen / expected, kDeviation * kDeviation / (kDeviation * kDeviation + deviation * deviation));
}

CostLine::CostLine(double x0, double cost0, double x1, double cost1) : x0_(x0), cost0_(cost0) {
  if (!(cost0 > 0) || !(x0 > 0) || !(x1 > x0)) return;
  fixed_ = std::clamp((x1 / x0 - cost1 / cost0) / (x1 / x0 - 1), 0.0, kMostFixed);
}

void CostLine::learn(double x, double cost) {
  if (!(cost > 0)) return;
  if (x >= kFarFromKnown * x0_ && cost > at(x))
    *this = CostLine(x0_, cost0_, x, cost);
  else if (at(x) > 0)
    cost0_ *= cost / at(x);
}

double CostLine::at(double x) const { return cost0_ * (fixed_ + (1 - fixed_) * ratio(x, x0_)); }

RecordError::RecordError(const Seen& base, const Seen& finer, const std::optional<Seen>& wider) : base_(base.quality) {
  const double all = base.error * base.error, left = finer.error * finer.error;
  const double share = 1 - ratio(base_.samples, finer.quality.samples);
  noise_ = share > 0 && wider ? std::clamp((all - left) / share, kLeastShare * all, (1 - kLeastShare) * all) : all;
  if (!wider) return;
  bias_ = all - noise_;
  const double biasOfWider = std::max(wider->error * wider->error - noise_, bias_);
  power_ = narrowPower_ = power(base_.maxError, bias_, wider->quality.maxError, biasOfWider, 0.5, 5);
}

void RecordError::addNarrower(const Seen& narrower) {
  const double all = narrower.error * narrower.error;
  if (!(bias_ > 0 && all > 0)) return;
  const double bias = std::clamp(all - noise_, std::min(kLeastShare * all, bias_), bias_);
  narrowPower_ = power(narrower.quality.maxError, bias, base_.maxError, bias_, 0.5, 5);
}

double RecordError::at(const LightQuality& q) const {
  const double width = ratio(q.maxError, base_.maxError);
  const double noise = noise_ / ratio(q.samples, base_.samples);
  return scale_ * std::sqrt(noise + bias_ * std::pow(width, width < 1 ? narrowPower_ : power_));
}

void RecordError::correct(const Seen& picture) {
  if (const double expected = at(picture.quality); expected > 0) scale_ *= picture.error / expected;
}

ErrorModel::ErrorModel(const QualityTrial& base, const QualityTrial& finer, const std::optional<QualityTrial>& wider)
    : base_(base) {
  using Seen = RecordError::Seen;
  const auto fit = [&](double QualityTrial::*error) {
    const auto seen = [&](const QualityTrial& t) { return Seen{t.quality, t.*error}; };
    return RecordError(seen(base), seen(finer), wider ? std::optional(seen(*wider)) : std::nullopt);
  };
  indirect_ = fit(&QualityTrial::indirect);
  if (base.quality.samples > 0 && base.indirect > 0) smudges_ = fit(&QualityTrial::smudges);
  const double s0 = base.quality.samples, s1 = finer.quality.samples;
  const double l0 = base.quality.lightSamples, l1 = finer.quality.lightSamples;
  directPower_ = power(l0, base.direct, l1, finer.direct, -1.5, -0.25);
  raysPower_ = power(s0, base.gatherCost, s1, finer.gatherCost, kLeastRaysPower, kMostRaysPower);
  bouncesPower_ = power(s0, base.bounceCost, s1, finer.bounceCost, 0, 1);
  shading_ = tracesPaths() ? CostLine(s0, base.shadeCost, s1, finer.shadeCost)
                           : CostLine(l0, base.shadeCost, l1, finer.shadeCost);
  if (!wider) return;
  recordsPower_ = narrowRecordsPower_ =
      power(base.quality.maxError, base.gatherCost, wider->quality.maxError, wider->gatherCost, -2, -0.1);
}

void ErrorModel::addNarrower(const QualityTrial& t) {
  indirect_.addNarrower({t.quality, t.indirect});
  if (smudges_.any()) smudges_.addNarrower({t.quality, t.smudges});
  narrowRecordsPower_ = power(t.quality.maxError, t.gatherCost, base_.quality.maxError, base_.gatherCost, -4, -0.1);
}

double ErrorModel::directError(const LightQuality& q) const {
  return directScale_ * base_.direct * std::pow(ratio(q.lightSamples, base_.quality.lightSamples), directPower_);
}

double ErrorModel::error(const LightQuality& q) const { return std::hypot(indirectError(q), directError(q)); }

double ErrorModel::gatherCost(const LightQuality& q) const {
  const double width = ratio(q.maxError, base_.quality.maxError);
  return gatherScale_ * base_.gatherCost * std::pow(ratio(q.samples, base_.quality.samples), raysPower_) *
             std::pow(width, width < 1 ? narrowRecordsPower_ : recordsPower_) +
         bounceCost(q);
}

double ErrorModel::bounceCost(const LightQuality& q) const {
  return gatherScale_ * base_.bounceCost * std::pow(ratio(q.samples, base_.quality.samples), bouncesPower_);
}

double ErrorModel::gatherCostOf(double share, const LightQuality& q) const {
  return share * (gatherCost(q) - bounceCost(q)) + bounceCost(q);
}

double ErrorModel::shadeCost(const LightQuality& q) const {
  return shading_.at(tracesPaths() ? q.samples : q.lightSamples);
}

void ErrorModel::learnRays(const QualityTrial& few, const QualityTrial& many) {
  const double s0 = few.quality.samples, s1 = many.quality.samples;
  if (few.gatherCost > 0 && many.gatherCost > 0)
    raysPower_ = power(s0, few.gatherCost, s1, many.gatherCost, kLeastKnownPower, kMostKnownPower);
  if (few.bounceCost > 0 && many.bounceCost > 0) bouncesPower_ = power(s0, few.bounceCost, s1, many.bounceCost, 0, 1);
}

void ErrorModel::correctGatherCost(const LightQuality& q, double cost) {
  if (const double expected = gatherCost(q); expected > 0 && cost > 0) gatherScale_ *= cost / expected;
}

void ErrorModel::correctShadeCost(const LightQuality& q, double cost) {
  shading_.learn(tracesPaths() ? q.samples : q.lightSamples, cost);
}

void ErrorModel::correct(const QualityTrial& picture) {
  const LightQuality& q = picture.quality;
  indirect_.correct({q, picture.indirect});
  if (picture.smudges > 0) smudges_.correct({q, picture.smudges});
  if (const double expected = directError(q); expected > 0) directScale_ *= picture.direct / expected;
}

int ErrorModel::mostSamples() const { return tracesPaths() ? kMostPathsOfPoint : kMostRaysOfRecord; }

template <class Better>
LightQuality ErrorModel::search(const Better& better, const std::function<bool(const LightQuality&)>& isAllowed) const {
  const LightQuality& base = base_.quality;
  const auto steps = [](bool varies, int down, int up) { return varies ? std::pair(-down, up) : std::pair(0, 0); };
  const auto [fewest, most] =
      steps(base.samples > 0 && base_.indirect > 0, kFewerRays, stepsTo(mostSamples(), base.samples));
  const auto [narrowest, widest] = steps(base.maxError > 0 && base_.indirect > 0, kNarrower, kWider);
  const auto [fewestLight, mostLight] = steps(base.lightSamples > 0 && base_.direct > 0, kFewerLightSamples,
                                              stepsTo(kMostLightSamples, base.lightSamples));
  std::optional<LightQuality> found;
  for (int s = fewest; s <= most; ++s)
    for (int m = narrowest; m <= widest; ++m)
      for (int l = fewestLight; l <= mostLight; l += 2) {
        LightQuality q = base;
        if (base_.indirect == 0) {
          q.samples = 0;
          q.maxError = -1;
        }
        if (base_.direct == 0) q.lightSamples = 0;
        if (q.samples > 0) q.samples = static_cast<int>(rounded(q.samples * halfOctaves(s)));
        if (q.maxError > 0) q.maxError = static_cast<float>(rounded(q.maxError * halfOctaves(m)));
        if (q.lightSamples > 0)
          q.lightSamples = std::max(1, static_cast<int>(std::lround(q.lightSamples * halfOctaves(l))));
        if (isAllowed && !isAllowed(q)) continue;
        if (!found || better(q, *found)) found = q;
      }
  return found.value_or(base);
}

double ErrorModel::timesTarget(const LightQuality& q, const ErrorTarget& target) const {
  return std::max(error(q) / target.error, target.smudges > 0 ? smudges(q) / target.smudges : 0);
}

LightQuality ErrorModel::cheapest(const ErrorTarget& target, const std::optional<LightQuality>& gathered) const {
  const auto costLeft = [&](const LightQuality& q) {
    return gathered && q.hasRecordsOf(*gathered) ? shadeCost(q) : cost(q);
  };
  return search([&](const LightQuality& a, const LightQuality& b) {
    const double timesA = timesTarget(a, target), timesB = timesTarget(b, target);
    const bool bothReach = timesA <= 1 && timesB <= 1;
    if (!bothReach && timesA != timesB) return timesA < timesB;
    // Where smudges miss, their light samples do not matter, but those of the mean error do.
    if (!bothReach && error(a) != error(b)) return error(a) < error(b);
    return costLeft(a) < costLeft(b);
  });
}

LightQuality ErrorModel::cheapestOfError(const ErrorTarget& target, const std::optional<LightQuality>& gathered) const {
  const LightQuality best = cheapest(target, gathered), alone = cheapest({target.error, 0}, gathered);
  return smudges(best) > target.smudges && error(alone) <= target.error ? alone : best;
}

LightQuality ErrorModel::best(double most) const { return bestOf(most, {}); }

LightQuality ErrorModel::bestAsWide(const LightQuality& given, double most) const {
  return bestOf(most, [&](const LightQuality& q) { return q.maxError == given.maxError; });
}

LightQuality ErrorModel::bestOf(double most, const std::function<bool(const LightQuality&)>& isAllowed) const {
  const auto isBetter = [&](const LightQuality& a, const LightQuality& b) {
    const double costA = cost(a), costB = cost(b);
    if (costA <= most && costB <= most) return timesTarget(a, {1, 1}) < timesTarget(b, {1, 1});
    return costA < costB;
  };
  return withMoreRays(search(isBetter, isAllowed), most);
}

LightQuality ErrorModel::withMoreRays(const LightQuality& given, double most) const {
  LightQuality out = given;
  for (int step = 1; given.samples > 0; ++step) {
    LightQuality q = given;
    q.samples = static_cast<int>(rounded(given.samples * std::pow(2.0, 1.0 * step / kFineSteps)));
    if (q.samples > mostSamples() || cost(q) > most) break;
    out = q;
  }
  return out;
}

LightQuality ErrorModel::bestLightSamples(const LightQuality& given, double most) const {
  LightQuality out = given;
  if (!(base_.direct > 0) || given.lightSamples <= 0) return out;
  int low = 1, high = kMostLightSamples + 1;  // the answer is in [low, high)
  while (high - low > 1) {
    out.lightSamples = (low + high) / 2;
    (shadeCost(out) <= most ? low : high) = out.lightSamples;
  }
  out.lightSamples = low;
  return out;
}

}  // namespace tomales
