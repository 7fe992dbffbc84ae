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
};

double percentile(std::vector<double>& values, double share) {
  const auto at = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

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
  std::vector<double> means;
  const auto count = static_cast<uint32_t>(places.size());
  for (uint32_t r = 0; r < kResamples; ++r) {
    ErrorSums drawn;
    for (uint32_t i = 0; i < count; ++i) drawn.add(places[hashCombine(randomStream("boot"), r, i) % count]);
    means.push_back(drawn.mean(places.size()));
  }
  out.low = percentile(means, kOutside);
  out.high = percentile(means, 1 - kOutside);
  if (!out.tells()) out.high = std::max(out.high, out.noise);
  return out;
}

}  // namespace tomales
