#include "reyes/app/frame/audit_estimate.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr uint32_t kResamples = 1000;
constexpr double kOutside = 0.05;  ///< Share of the resamples on each side of the interval.

/// The sums of errors and of noise over some places.
struct ErrorSums {
  double error = 0, noise = 0;
  void add(const AuditedError& e) {
    error += double{e.error};
    noise += double{e.noise};
  }
  double mean(size_t places) const {
    return std::sqrt(std::max(0.0, error * error - noise * noise)) / static_cast<double>(places);
  }
  /// Independent noise makes no mean absolute error smaller, whatever places it has.
  double most(size_t places) const { return error / static_cast<double>(places); }
};

double percentile(std::vector<double>& values, double share) {
  const auto at = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The covariance of both estimates over some blocks, and the smudges that follow from it.
struct SmudgeSums {
  double first = 0, second = 0, product = 0, differences = 0, count = 0;
  void add(const SmoothBlock& b) {
    first += b.off[0];
    second += b.off[1];
    product += b.off[0] * b.off[1];
    differences += (b.off[0] - b.off[1]) * (b.off[0] - b.off[1]);
    ++count;
  }
  double brightness() const { return 1 + 0.5 * (first + second) / count; }
  double deviation() const {
    const double covariance = (product - first * second / count) / std::max(1.0, count - 1);
    return std::sqrt(std::max(0.0, covariance)) / brightness();
  }
  double noise() const { return 0.5 * std::sqrt(differences / count) / brightness(); }
};

}  // namespace

ErrorEstimate estimateError(std::span<const AuditedError> places) {
  ErrorEstimate out;
  if (places.empty()) return out;
  ErrorSums all;
  std::vector<double> errors;
  for (const AuditedError& e : places) {
    all.add(e);
    errors.push_back(double{e.error});
  }
  out.mean = all.mean(places.size());
  out.noise = all.noise / static_cast<double>(places.size());
  out.p99 = percentile(errors, 0.99);
  std::vector<double> means, most;
  const auto count = static_cast<uint32_t>(places.size());
  for (uint32_t r = 0; r < kResamples; ++r) {
    ErrorSums drawn;
    for (uint32_t i = 0; i < count; ++i) drawn.add(places[hashCombine(randomStream("boot"), r, i) % count]);
    means.push_back(drawn.mean(places.size()));
    most.push_back(drawn.most(places.size()));
  }
  out.low = percentile(means, kOutside);
  out.high = percentile(most, 1 - kOutside);
  if (!out.tells()) out.high = std::max(out.high, out.noise);
  return out;
}

SmudgeEstimate estimateSmudges(int size, std::span<const SmoothBlock> blocks) {
  SmudgeEstimate out{size, blocks.size()};
  if (!out.isKnown()) return out;
  SmudgeSums all;
  for (const SmoothBlock& b : blocks) all.add(b);
  out.deviation = all.deviation();
  out.noise = all.noise();
  std::vector<double> deviations;
  const auto count = static_cast<uint32_t>(blocks.size());
  for (uint32_t r = 0; r < kResamples; ++r) {
    SmudgeSums drawn;
    for (uint32_t i = 0; i < count; ++i) drawn.add(blocks[hashCombine(randomStream("resa"), r, i) % count]);
    deviations.push_back(drawn.deviation());
  }
  out.low = percentile(deviations, kOutside);
  out.high = percentile(deviations, 1 - kOutside);
  if (!out.tells()) out.high = std::max(out.high, out.noise);
  return out;
}

}  // namespace tomales
