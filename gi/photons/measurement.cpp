#include "gi/photons/measurement.h"

#include <bit>
#include <numeric>

#include "gi/photons/disk_coverage.h"
#include "reyes/base/parallel.h"

namespace tomales {
namespace {

/// Photons that face a point's side by a smaller cosine lie on another surface.
constexpr float kSameFacing = 0.7071f;
/// Sums of 63 bits hold 2^15 times the power of all photons, and one of 10^9 photons still has 18 bits.
constexpr double kUnitsOfPower = 0x1p48;
constexpr size_t kNumbers = 6, kColors = 3;

uint64_t mixed(uint64_t x) {  // splitmix64 (Steele, Lea and Flood 2014)
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9U;
  x = (x ^ x >> 27) * 0x94d049bb133111ebU;
  return x ^ x >> 31;
}

}  // namespace

uint64_t PhotonMeasurement::Cube::name() const {
  uint64_t out = mixed(static_cast<uint32_t>(level));
  for (const int c : {at.x, at.y, at.z}) out = mixed(out ^ static_cast<uint32_t>(c));
  return out;
}

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
      sums_(new std::atomic<int64_t>[kNumbers * points_.size()]) {
  for (size_t i = 0; i < kNumbers * points_.size(); ++i) sums_[i] = 0;
  if (!rays_) return;
  std::vector<uint8_t> isEdge(points_.size());
  parallelFor(points_.size(), 256, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) isEdge[i] = !isCovered(*rays_, points_[i], largestScale);
  });
  for (uint32_t i = 0; i < isEdge.size(); ++i)
    if (isEdge[i]) edges_.push_back(i);
}

void PhotonMeasurement::beginPass(float scale, double weight) {
  ++passes_;
  weight_ = weight;
  weights_[static_cast<size_t>(passes_ & 1)] += weight;
  if (scale == scale_) return;
  scale_ = scale;
  build();
  cover();
}

void PhotonMeasurement::cover() {
  parallelFor(edges_.size(), 64, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) covered_[edges_[i]] = coverage(*rays_, points_[edges_[i]], scale_);
  });
}

/// Puts each point into one cube that is at least twice as wide as the point's reach. So all that the point reaches
/// lies in that cube or within half its width of it.
void PhotonMeasurement::build() {
  const size_t count = points_.size();
  std::vector<uint64_t> cube(count);
  std::vector<int> level(count);
  parallelFor(count, 4096, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      level[i] = std::ilogb(2 * reach(points_[i])) + 1;
      cube[i] = Cube{level[i], glm::ivec3(glm::floor(points_[i].P * std::ldexp(1.0f, -level[i])))}.name();
    }
  });
  levels_ = level;
  std::sort(levels_.begin(), levels_.end());
  levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
  const size_t slots = std::bit_ceil(std::max<size_t>(count, 1));
  slots_.assign(slots + 1, 0);
  for (const uint64_t c : cube) ++slots_[(c & (slots - 1)) + 1];
  std::partial_sum(slots_.begin(), slots_.end(), slots_.begin());
  std::vector<uint32_t> next(slots_.begin(), slots_.end() - 1);
  entries_.resize(count);
  for (size_t i = 0; i < count; ++i) entries_[next[cube[i] & (slots - 1)]++] = {cube[i], static_cast<uint32_t>(i)};
}

std::span<const PhotonMeasurement::Entry> PhotonMeasurement::slotOf(uint64_t cube) const {
  const size_t slot = cube & (slots_.size() - 2);
  return std::span(entries_).subspan(slots_[slot], slots_[slot + 1] - slots_[slot]);
}

void PhotonMeasurement::count(std::span<const StoredPhoton> photons) {
  for (const StoredPhoton& photon : photons) {
    if (photon.group < 0) continue;
    for (const int level : levels_) {
      const vec3 at = photon.P * std::ldexp(1.0f, -level);
      const glm::ivec3 first(glm::floor(at - 0.5f));
      for (int k = 0; k < 8; ++k) {
        const uint64_t cube = Cube{level, first + glm::ivec3(k & 1, k >> 1 & 1, k >> 2)}.name();
        for (const Entry& e : slotOf(cube)) {
          if (e.cube != cube || photon.bounces > points_[e.point].bounces) continue;
          if (points_[e.point].holds(photon.P, photon.N, scale_)) add(e.point, photon.power);
        }
      }
    }
  }
}

void PhotonMeasurement::add(uint32_t point, const vec3& power) {
  const double units = weight_ / (unit_ * double{scale_} * double{scale_} * double{covered_[point]});
  std::atomic<int64_t>* const sums = &sums_[kNumbers * point + kColors * static_cast<size_t>(passes_ & 1)];
  for (int c = 0; c < 3; ++c) sums[c].fetch_add(std::llround(double{power[c]} * units), std::memory_order_relaxed);
}

vec3 PhotonMeasurement::half(size_t point, size_t parity) const {
  if (weights_[parity] <= 0) return vec3(0.0f);
  const double r = double{points_[point].radius};
  const double scale = unit_ / (double{kPi} * double{kPi} * r * r * weights_[parity]);
  vec3 out;
  for (int c = 0; c < 3; ++c)
    out[c] = static_cast<float>(
        static_cast<double>(sums_[kNumbers * point + kColors * parity + static_cast<size_t>(c)]) * scale);
  return out;
}

vec3 PhotonMeasurement::overPi(size_t point) const {
  if (passes_ == 0) return vec3(0.0f);
  const auto odd = static_cast<float>(weights_[1] / (weights_[0] + weights_[1]));
  return half(point, 1) * odd + half(point, 0) * (1 - odd);
}

PhotonSums PhotonMeasurement::sums() const {
  return {passes_, weights_, {sums_.get(), sums_.get() + kNumbers * points_.size()}};
}

bool PhotonMeasurement::resume(const PhotonSums& sums) {
  if (sums.power.size() != kNumbers * points_.size()) return false;
  passes_ = sums.passes;
  weights_ = sums.weights;
  std::copy(sums.power.begin(), sums.power.end(), sums_.get());
  return true;
}

double PhotonMeasurement::noise() const {
  double difference = 0, mean = 0;
  for (size_t i = 0; i < points_.size(); ++i) {
    const double even = double{luminance(half(i, 0))}, odd = double{luminance(half(i, 1))};
    difference += std::abs(even - odd) / 2;
    mean += (even + odd) / 2;
  }
  return passes_ > 1 && mean > 0 ? difference / mean : -1;
}

}  // namespace tomales
