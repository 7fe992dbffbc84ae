#include "gi/cache/vicinity.h"

#include "gi/cache/amendments/behind.h"
#include "gi/cache/amendments/reach.h"

namespace tomales {
namespace {

struct Columns {
  const float *x, *y, *z, *nx, *ny, *nz, *size, *limit, *steepness, *unseen;
};

TOMALES_HOT void compare(const Columns& of, size_t count, const vec3& p, const vec3& n, const Range& range,
                         float* __restrict position, float* __restrict angle, float* __restrict fades) {
  const float *x = of.x, *y = of.y, *z = of.z, *nx = of.nx, *ny = of.ny, *nz = of.nz;
  const float *size = of.size, *limit = of.limit, *steepness = of.steepness, *unseen = of.unseen;
  const float px = p.x, py = p.y, pz = p.z, qx = n.x, qy = n.y, qz = n.z;
  const Range r = range;
  // A choice by a flag within the loop would keep GCC from vectorising it, so a limit of floats makes this choice.
  const float leastFront = r.fadesBehind ? 0.0f : 1.0f;
  for (size_t i = 0; i < count; ++i) {
    const float dx = px - x[i], dy = py - y[i], dz = pz - z[i];
    const float distance2 = dx * dx + dy * dy + dz * dz, cosine = qx * nx[i] + qy * ny[i] + qz * nz[i];
    const float covers = r.radiusOf(size[i]);
    const float radius = std::min(covers * reachFactor(steepness[i], covers, r.wider), limit[i]);
    const float height = 0.5f * (dx * (qx + nx[i]) + dy * (qy + ny[i]) + dz * (qz + nz[i]));
    const float front = std::max(leastFront, 1 - behindness(height, radius, r.pixel, unseen[i]));
    const bool serves = (distance2 < radius * radius) & (cosine > r.leastCosine);
    position[i] = std::sqrt(distance2) / radius;
    angle[i] = std::sqrt(std::max(0.0f, 1 - cosine));
    fades[i] = serves ? front : 0.0f;
  }
}

}  // namespace

void Vicinity::clear() {
  records_.clear();
  for (auto* a : {&x_, &y_, &z_, &nx_, &ny_, &nz_, &size_, &limit_, &steepness_, &unseen_}) a->clear();
}

void Vicinity::add(uint32_t index, const IrradianceRecord& r, float size) {
  records_.push_back(index);
  x_.push_back(r.position.x);
  y_.push_back(r.position.y);
  z_.push_back(r.position.z);
  nx_.push_back(r.normal.x);
  ny_.push_back(r.normal.y);
  nz_.push_back(r.normal.z);
  size_.push_back(size);
  limit_.push_back(r.limit);
  steepness_.push_back(steepnessOf(r));
  unseen_.push_back(r.unseenDisplacement);
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
