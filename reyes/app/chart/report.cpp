#include "reyes/app/chart/report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reyes/app/build_info.h"
#include "reyes/app/chart/html.h"
#include "reyes/app/settings.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

using Json = nlohmann::ordered_json;

template <class Cost>
bool isBest(const ChartReport& report, const ChartPoint& p, Cost&& cost) {
  return std::none_of(report.points.begin(), report.points.end(), [&](const ChartPoint& q) {
    return cost(q) <= cost(p) && q.error.mean <= p.error.mean && (cost(q) < cost(p) || q.error.mean < p.error.mean);
  });
}

Json pointJson(const ChartReport& report, const ChartPoint& p) {
  return {{"method", report.curves[p.curve]},
          {"setting", p.setting},
          {"value", p.value},
          {"command", p.commandLine},
          {"cpu_s", p.run.cpu_s},
          {"wall_s", p.run.wall_s},
          {"peak_bytes", p.run.peakBytes},
          {"irradiance_records", p.run.records},
          {"mean_absolute_relative_error", p.error.mean},
          {"with_noise_of_reference", p.error.measured},
          {"confidence_95", p.error.confidence},
          {"p99", p.error.p99},
          {"bias", p.error.bias},
          {"rms", p.error.rms},
          {"pixels_not_finite", p.error.notFinite},
          {"best_in_time", p.bestInTime},
          {"best_in_memory", p.bestInMemory},
          {"recalled", p.run.recalled}};
}

}  // namespace

void markBest(ChartReport& report) {
  for (ChartPoint& p : report.points) {
    p.bestInTime = isBest(report, p, [](const ChartPoint& q) { return q.run.cpu_s; });
    p.bestInMemory = isBest(report, p, [](const ChartPoint& q) { return q.run.peakBytes; });
  }
}

std::optional<double> secondsToReach(const ChartReport& report, size_t curve, double error) {
  std::optional<double> best;
  const ChartPoint* before = nullptr;
  for (const ChartPoint& p : report.points) {
    if (p.curve != curve) continue;
    std::optional<double> seconds;
    if (p.error.mean <= error) seconds = p.run.cpu_s;
    if (seconds && before && before->error.mean > error) {
      const double share =
          std::log(before->error.mean / error) / std::log(before->error.mean / std::max(p.error.mean, 1e-9));
      seconds = before->run.cpu_s * std::pow(p.run.cpu_s / before->run.cpu_s, share);
    }
    if (seconds && (!best || *seconds < *best)) best = seconds;
    before = &p;
  }
  return best;
}

const ChartPoint* mostAccurate(const ChartReport& report, size_t curve) {
  const ChartPoint* out = nullptr;
  for (const ChartPoint& p : report.points)
    if ((p.curve == curve || curve >= report.curves.size()) && (!out || p.error.mean < out->error.mean)) out = &p;
  return out;
}

bool isFlat(const ChartReport& report, size_t curve) {
  double least = kInfinity, most = 0;
  int count = 0;
  for (const ChartPoint& p : report.points)
    if (p.curve == curve) {
      least = std::min(least, p.error.mean);
      most = std::max(most, p.error.mean);
      ++count;
    }
  return count > 1 && most - least <= 1e-3 * most;
}

bool writeChartJson(const std::string& path, const ChartReport& report) {
  Json out{{"version", kVersion},
           {"scene", report.scene},
           {"sweep", report.title},
           {"command", report.commandLine},
           {"reference",
            {{"command", report.referenceCommandLine},
             {"batches", report.referenceBatches},
             {"cpu_s", report.referenceSeconds},
             {"noise_floor", std::isfinite(report.noiseFloor) ? Json(report.noiseFloor) : Json(nullptr)}}},
           {"budget_s", report.budget_s},
           {"missing", report.missing},
           {"warnings", report.warnings},
           {"points", Json::array()}};
  for (const ChartPoint& p : report.points) out["points"].push_back(pointJson(report, p));
  std::string why;
  return writeFile(path, out.dump(2, ' ', false, Json::error_handler_t::replace) + '\n', why);
}

}  // namespace tomales
