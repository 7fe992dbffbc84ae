#include "gi/cache/vicinity.h"

#include "gi/cache/amendments/behind.h"
#include "gi/cache/amendments/reach.h"

namespace tomales {
namespace {

struct Columns {
  const float *x, *y, *z, *nx, *ny, *nz, *size, *limit, *steepness, *unseen;
};

// A choice by a flag within a loop would keep GCC from vectorising it, so a limit of floats makes this choice.
float leastFrontOf(const Range& range) { return range.fadesBehind ? 0.0f : 1.0f; }

inline void serve(const RecordReach& of, const vec3& p, const vec3& n, const Range& range, float leastFront,
                  float& position, float& angle, float& fades) {
  const float dx = p.x - of.position.x, dy = p.y - of.position.y, dz = p.z - of.position.z;
  const float distance2 = dx * dx + dy * dy + dz * dz,
              cosine = n.x * of.normal.x + n.y * of.normal.y + n.z * of.normal.z;
  const float covers = range.radiusOf(of.size);
  const float radius = std::min(covers * reachFactor(of.steepness, covers, range.wider), of.limit);
  const float height = 0.5f * (dx * (n.x + of.normal.x) + dy * (n.y + of.normal.y) + dz * (n.z + of.normal.z));
  const float front = std::max(leastFront, 1 - behindness(height, radius, range.pixel, of.unseen));
  const bool serves = (distance2 < radius * radius) & (cosine > range.leastCosine);
  position = std::sqrt(distance2) / radius;
  angle = std::sqrt(std::max(0.0f, 1 - cosine));
  fades = serves ? front : 0.0f;
}

TOMALES_HOT void compare(const Columns& of, size_t count, const vec3& p, const vec3& n, const Range& range,
                         float* __restrict position, float* __restrict angle, float* __restrict fades) {
  const float *x = of.x, *y = of.y, *z = of.z, *nx = of.nx, *ny = of.ny, *nz = of.nz;
  const float *size = of.size, *limit = of.limit, *steepness = of.steepness, *unseen = of.unseen;
  const vec3 place = p, facing = n;
  const Range r = range;
  const float leastFront = leastFrontOf(r);
  for (size_t i = 0; i < count; ++i)
    serve({{x[i], y[i], z[i]}, {nx[i], ny[i], nz[i]}, size[i], limit[i], steepness[i], unseen[i]}, place, facing, r,
          leastFront, position[i], angle[i], fades[i]);
}

}  // namespace

RecordReach RecordReach::of(const IrradianceRecord& r, float size) {
  return {r.position, r.normal, size, r.limit, steepnessOf(r), r.unseenDisplacement};
}

Serving servingOf(uint32_t record, const RecordReach& reach, const vec3& position, const vec3& normal,
                  const Range& range) {
  Serving out{.record = record, .position = 0, .angle = 0, .fades = 0};
  serve(reach, position, normal, range, leastFrontOf(range), out.position, out.angle, out.fades);
  return out;
}

void Vicinity::clear() {
  records_.clear();
  for (auto* a : {&x_, &y_, &z_, &nx_, &ny_, &nz_, &size_, &limit_, &steepness_, &unseen_}) a->clear();
}

void Vicinity::add(uint32_t index, const RecordReach& r) {
  records_.push_back(index);
  x_.push_back(r.position.x);
  y_.push_back(r.position.y);
  z_.push_back(r.position.z);
  nx_.push_back(r.normal.x);
  ny_.push_back(r.normal.y);
  nz_.push_back(r.normal.z);
  size_.push_back(r.size);
  limit_.push_back(r.limit);
  steepness_.push_back(r.steepness);
  unseen_.push_back(r.unseen);
}

void Vicinity::find(const vec3& position, const vec3& normal, const Range& range, std::vector<Serving>& out) {
  const size_t count = records_.size();
  for (auto* a : {&position_, &angle_, &fades_}) a->resize(std::max(a->size(), count));
  const Columns of{x_.data(),  y_.data(),    z_.data(),     nx_.data(),        ny_.data(),
                   nz_.data(), size_.data(), limit_.data(), steepness_.data(), unseen_.data()};
  compare(of, count, position, normal, range, position_.data(), angle_.data(), fades_.data());
  out.clear();
  for (size_t i = 0; i < count; ++i)
    if (fades_[i] > 0) out.push_back({records_[i], position_[i], angle_[i], fades_[i]});
}

}  // namespace tomales
