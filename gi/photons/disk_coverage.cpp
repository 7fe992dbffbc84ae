#include "gi/photons/disk_coverage.h"

#include "reyes/base/checksum.h"

namespace tomales {
namespace {

constexpr int kPlaces = 32;
constexpr int kStep = 4;  ///< isCovered() asks at every fourth place alone.
/// A ray passes surfaces on which photons do not count because they are turned away.
constexpr int kMostPassed = 4;

/// Tells whether a ray against the normal meets the surface at a place of the disk. Places lie on a spiral, each with
/// an equal part of the area (Vogel 1979).
bool isCoveredAt(const RayScene& rays, const MeasurementPoint& point, float scale, int place, float turn) {
  constexpr float kGoldenAngle = 2.39996323f;
  vec3 x, y;
  orthonormalBasis(point.N, x, y);
  const float angle = turn + kGoldenAngle * static_cast<float>(place),
              radius = scale * point.radius * std::sqrt((static_cast<float>(place) + 0.5f) / kPlaces),
              height = point.thickness(scale);
  Ray ray{point.P + radius * (std::cos(angle) * x + std::sin(angle) * y) + height * point.N, -point.N};
  ray.tMax = 2 * height;
  for (int i = 0; i < kMostPassed; ++i) {
    const Hit hit = rays.closest(ray, kMaskPhoton);
    if (hit.object < 0) return false;
    const vec3 facing = dot(hit.geometricNormal, point.N) < 0 ? -hit.geometricNormal : hit.geometricNormal;
    if (point.holds(hit.atOpen, facing, scale)) return true;
    ray.bias = hit.t + 1e-4f * height;
  }
  return false;
}

/// Neighbouring points have other angles, so that their errors do not make a pattern.
float turnOf(const MeasurementPoint& point) {
  return 2 * kPi * static_cast<float>(checksum(std::as_bytes(std::span(&point.P, 1))) >> 40) * 0x1p-24f;
}

}  // namespace

bool isCovered(const RayScene& rays, const MeasurementPoint& point, float scale) {
  const float turn = turnOf(point);
  for (int place = kStep - 1; place < kPlaces; place += kStep)
    if (!isCoveredAt(rays, point, scale, place, turn)) return false;
  return true;
}

float coverage(const RayScene& rays, const MeasurementPoint& point, float scale) {
  const float turn = turnOf(point);
  float covered = 0;
  for (int place = 0; place < kPlaces; ++place) covered += isCoveredAt(rays, point, scale, place, turn) ? 1.0f : 0.0f;
  return std::max(covered, 0.5f) / kPlaces;
}

}  // namespace tomales
