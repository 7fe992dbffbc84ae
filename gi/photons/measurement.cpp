#include "gi/photons/measurement.h"

#include <algorithm>
#include <utility>

#include "gi/photons/disk_coverage.h"
#include "reyes/base/morton.h"
#include "reyes/base/parallel.h"

namespace tomales {
namespace {

/// Photons that face a point's side by a smaller cosine lie on another surface.
constexpr float kSameFacing = 0.7071f;
/// Sums of 63 bits hold 2^15 times the power of all photons, counted at scale 1. One of 10^9 photons still has 18 bits.
constexpr double kUnitsOfPower = 0x1p48;
constexpr size_t kNumbers = 6, kColors = 3;

/// Returns a box around a disk, with room for rounding: each photon on the disk must be in it.
Bound3 boundOf(const MeasurementPoint& p, float scale) {
  const vec3 across = scale * p.radius * glm::sqrt(glm::max(vec3(0.0f), 1.0f - p.N * p.N));
  const vec3 half = 1.001f * (across + p.thickness(scale) * glm::abs(p.N)) + 1e-6f * glm::abs(p.P);
  return {p.P - half, p.P + half};
}

}  // namespace

bool MeasurementPoint::holds(const vec3& at, const vec3& facing, float scale) const {
  if (dot(facing, N) < kSameFacing) return false;
  const vec3 off = at - P;
  const float along = dot(off, N);
  return std::abs(along) < thickness(scale) && dot(off, off) - along * along < scale * radius * scale * radius;
}

PhotonMeasurement::PhotonMeasurement(std::vector<MeasurementPoint> points, double power, const RayScene* rays,
                                     float largestScale)
    : points_(std::move(points)),
      unit_(power > 0 ? power / kUnitsOfPower : 1),
      rays_(rays),
      covered_(points_.size(), 1.0f),
      sums_{.power = std::vector<int64_t>(kNumbers * points_.size())} {
  std::vector<vec3> places;
  for (const MeasurementPoint& p : points_) places.push_back(p.P);
  order_ = mortonOrder(places);
  if (!rays_) return;
  std::vector<uint8_t> isEdge(points_.size());
  parallelFor(points_.size(), 256, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) isEdge[i] = !isCovered(*rays_, points_[i], largestScale);
  });
  for (uint32_t i = 0; i < isEdge.size(); ++i)
    if (isEdge[i]) edges_.push_back(i);
}

void PhotonMeasurement::beginPass(float scale, double weight) {
  ++sums_.passes;
  weight_ = weight;
  sums_.weights[(sums_.passes & 1)] += weight;
  if (scale == scale_) return;
  scale_ = scale;
  cover();
}

void PhotonMeasurement::cover() {
  parallelFor(edges_.size(), 64, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) covered_[edges_[i]] = coverage(*rays_, points_[edges_[i]], scale_);
  });
}

void PhotonMeasurement::count(std::span<const StoredPhoton> photons) {
  const std::lock_guard lock(*counting_);
  for (const StoredPhoton& p : photons)
    if (p.group >= 0) counted_.push_back(p);
}

void PhotonMeasurement::endPass() {
  const PhotonArrivals arrivals(counted_);
  counted_.clear();
  parallelFor(points_.size(), 64, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) measure(order_[i], arrivals);
  });
}

void PhotonMeasurement::measure(uint32_t point, const PhotonArrivals& arrivals) {
  const MeasurementPoint& p = points_[point];
  const double units = weight_ / (unit_ * double{scale_} * double{scale_} * double{covered_[point]});
  int64_t* const sums = &sums_.power[kNumbers * point + kColors * (sums_.passes & 1)];
  arrivals.visit(boundOf(p, scale_), [&](const StoredPhoton& photon) {
    if (photon.bounces > p.bounces || !p.holds(photon.P, photon.N, scale_)) return;
    for (int c = 0; c < 3; ++c) sums[c] += std::llround(double{photon.power[c]} * units);
  });
}

vec3 PhotonMeasurement::half(size_t point, size_t parity) const {
  if (sums_.weights[parity] <= 0) return vec3(0.0f);
  const double r = double{points_[point].radius};
  const double scale = unit_ / (double{kPi} * double{kPi} * r * r * sums_.weights[parity]);
  vec3 out;
  for (int c = 0; c < 3; ++c)
    out[c] = static_cast<float>(
        static_cast<double>(sums_.power[kNumbers * point + kColors * parity + static_cast<size_t>(c)]) * scale);
  return out;
}

vec3 PhotonMeasurement::overPi(size_t point) const {
  if (sums_.passes == 0) return vec3(0.0f);
  const auto odd = static_cast<float>(sums_.weights[1] / (sums_.weights[0] + sums_.weights[1]));
  return half(point, 1) * odd + half(point, 0) * (1 - odd);
}

bool PhotonMeasurement::resume(PhotonSums sums) {
  if (sums.power.size() != sums_.power.size()) return false;
  sums_ = std::move(sums);
  return true;
}

double PhotonMeasurement::noise() const {
  double difference = 0, mean = 0;
  for (size_t i = 0; i < points_.size(); ++i) {
    const double even = double{luminance(half(i, 0))}, odd = double{luminance(half(i, 1))};
    difference += std::abs(even - odd) / 2;
    mean += (even + odd) / 2;
  }
  return sums_.passes > 1 && mean > 0 ? difference / mean : -1;
}

}  // namespace tomales
