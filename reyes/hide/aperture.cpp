#include "reyes/hide/aperture.h"

#include "reyes/base/rng.h"

namespace tomales {

ApertureShape::ApertureShape(const Aperture& a)
    : disk_(a.sides < 3),
      sides_(std::floor(a.sides)),
      turn_(a.angle_degrees * kPi / 180),
      roundness_(std::clamp(a.roundness, -1.0f, 1.0f)),
      density_(std::clamp(a.density, -1.0f, 1.0f)) {
  if (disk_) return;
  for (int i = 0; i < kSteps; ++i) {
    const float r = rim((static_cast<float>(i) + 0.5f) / kSteps);
    areas_[static_cast<size_t>(i) + 1] = areas_[static_cast<size_t>(i)] + r * r;
  }
  for (float& area : areas_) area /= areas_.back();
}

float ApertureShape::rim(float along) const {
  const float half = kPi / sides_, chord = std::cos(half) / std::cos((2 * along - 1) * half);
  return chord + (1 - chord) * roundness_;
}

float ApertureShape::radius(float xi) const {
  float r = std::sqrt(xi);
  if (density_ == 0) return r;
  const float all = 0.5f + density_ / 6;
  float low = 0, high = 1;
  for (int step = 0; step < 24; ++step) {
    r = 0.5f * (low + high);
    const float below = 0.5f * (1 - density_) * r * r + 2 * density_ / 3 * r * r * r;
    (below < xi * all ? low : high) = r;
  }
  return r;
}

vec2 ApertureShape::operator()(const vec2& square) const {
  if (disk_) {
    const vec2 p = concentricDisk(square);
    const float r = glm::length(p);
    return r > 0 && density_ != 0 ? p * (radius(r * r) / r) : p;
  }
  const float at = square.x * sides_, side = std::min(std::floor(at), sides_ - 1);
  const float share = std::min(at - side, 1.0f);
  const auto next = std::upper_bound(areas_.begin() + 1, areas_.end() - 1, share);
  const auto k = static_cast<size_t>(next - areas_.begin()) - 1;
  const float inside = (share - areas_[k]) / (areas_[k + 1] - areas_[k]);
  const float along = std::clamp((static_cast<float>(k) + inside) / kSteps, 0.0f, 1.0f);
  const float angle = turn_ + (side + along) * 2 * kPi / sides_, r = rim(along) * radius(square.y);
  return {r * std::cos(angle), r * std::sin(angle)};
}

}  // namespace tomales
