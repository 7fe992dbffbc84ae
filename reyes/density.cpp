#include "reyes/density.h"

#include <algorithm>

namespace tomales {
namespace {

constexpr int kShift = 3;
static_assert(1 << kShift == DensityGrid::kSide);

ivec3 brickOf(const ivec3& point) { return {point.x >> kShift, point.y >> kShift, point.z >> kShift}; }

size_t within(const ivec3& point) {
  constexpr int kMask = DensityGrid::kSide - 1;
  return static_cast<size_t>((((point.x & kMask) << kShift | (point.y & kMask)) << kShift) | (point.z & kMask));
}

/// Returns the place within the piece that ends at `next`.
DensityAlongRay::Place inPiece(const DensityAlongRay::Knot* next, float distance, float columnDensity) {
  const float length = next->distance - (next - 1)->distance, holds = next->columnDensity - (next - 1)->columnDensity;
  return {distance, columnDensity, length > 0 ? holds / length : 0};
}

}  // namespace

DensityAlongRay::Place DensityAlongRay::atDistance(float distance) const {
  if (empty()) return {distance, 0, 0};
  const auto found = std::upper_bound(knots.begin() + 1, knots.end() - 1, distance,
                                      [](float d, const Knot& k) { return d < k.distance; });
  const Knot &a = *(found - 1), &b = *found;
  const float share = glm::clamp((distance - a.distance) / (b.distance - a.distance), 0.0f, 1.0f);
  return inPiece(&b, distance, glm::mix(a.columnDensity, b.columnDensity, share));
}

DensityAlongRay::Place DensityAlongRay::atColumnDensity(float columnDensity) const {
  if (empty()) return {0, columnDensity, 0};
  const auto found = std::lower_bound(knots.begin() + 1, knots.end(), columnDensity,
                                      [](const Knot& k, float x) { return k.columnDensity < x; });
  const Knot& b = found == knots.end() ? knots.back() : *found;
  const Knot& a = *(&b - 1);
  const float holds = b.columnDensity - a.columnDensity,
              share = holds > 0 ? (columnDensity - a.columnDensity) / holds : 1.0f;
  return inPiece(&b, glm::mix(a.distance, b.distance, glm::clamp(share, 0.0f, 1.0f)), columnDensity);
}

DensityGrid::DensityGrid(const ivec3& first, const ivec3& last, const mat4& indexFromObject, const Bound3& bound)
    // One brick more at the low side: cells that begin there reach the first points.
    : first_(brickOf(first) - 1),
      bricks_(brickOf(last) - first_ + 1),
      indexFromObject_(indexFromObject),
      bound_(bound),
      brickOf_(static_cast<size_t>(bricks_.x) * static_cast<size_t>(bricks_.y) * static_cast<size_t>(bricks_.z), -1) {}

double DensityGrid::tableBytes(const ivec3& first, const ivec3& last) {
  const glm::dvec3 bricks = glm::dvec3(brickOf(last) - brickOf(first)) + 2.0;
  return bricks.x * bricks.y * bricks.z * (sizeof(int32_t) + 1);
}

ptrdiff_t DensityGrid::entry(const ivec3& brick) const {
  const ivec3 b = brick - first_;
  if (b.x < 0 || b.y < 0 || b.z < 0 || b.x >= bricks_.x || b.y >= bricks_.y || b.z >= bricks_.z) return -1;
  return (static_cast<ptrdiff_t>(b.x) * bricks_.y + b.y) * bricks_.z + b.z;
}

float* DensityGrid::brickAt(const ivec3& point) {
  int32_t& number = brickOf_[static_cast<size_t>(entry(brickOf(point)))];
  if (number < 0) {
    number = static_cast<int32_t>(values_.size() / kBrickFloats);
    values_.resize(values_.size() + kBrickFloats, 0.0f);
  }
  return values_.data() + static_cast<size_t>(number) * kBrickFloats;
}

void DensityGrid::set(const ivec3& point, float value) { brickAt(point)[within(point)] = value; }

size_t DensityGrid::finish() {
  size_t bad = 0;
  for (float& v : values_)
    if (!(v >= 0 && v < kInfinity)) {
      v = 0;
      ++bad;
    }
  occupied_.assign(brickOf_.size(), 0);
  for (int x = 0; x < bricks_.x; ++x)
    for (int y = 0; y < bricks_.y; ++y)
      for (int z = 0; z < bricks_.z; ++z) {
        if (brickOf_[static_cast<size_t>(entry(first_ + ivec3(x, y, z)))] < 0) continue;
        for (int corner = 0; corner < 8; ++corner)
          if (const ptrdiff_t e = entry(first_ + ivec3(x - (corner & 1), y - (corner >> 1 & 1), z - (corner >> 2)));
              e >= 0)
            occupied_[static_cast<size_t>(e)] = 1;
      }
  return bad;
}

float DensityGrid::at(const ivec3& point) const {
  const ptrdiff_t e = entry(brickOf(point));
  const int32_t number = e < 0 ? -1 : brickOf_[static_cast<size_t>(e)];
  return number < 0 ? 0 : values_[static_cast<size_t>(number) * kBrickFloats + within(point)];
}

// Along a line the density of a cell is a cubic polynomial, which two-point Gauss-Legendre quadrature integrates
// exactly.
float DensityGrid::integral(const ivec3& cell, const vec3& origin, const vec3& direction, float t0, float t1) const {
  float corner[2][2][2];
  for (int x = 0; x < 2; ++x)
    for (int y = 0; y < 2; ++y)
      for (int z = 0; z < 2; ++z) corner[x][y][z] = at(cell + ivec3(x, y, z));
  constexpr float kGauss = 0.57735027f;
  const float half = 0.5f * (t1 - t0), middle = 0.5f * (t0 + t1);
  float sum = 0;
  for (const float side : {-kGauss, kGauss}) {
    const vec3 f = glm::clamp(origin + (middle + side * half) * direction - vec3(cell), 0.0f, 1.0f);
    const auto along = [&](int x, int y) { return glm::mix(corner[x][y][0], corner[x][y][1], f.z); };
    sum += glm::mix(glm::mix(along(0, 0), along(0, 1), f.y), glm::mix(along(1, 0), along(1, 1), f.y), f.x);
  }
  return half * sum;
}

/// Calls visit(end, columnDensity) for pieces of the line, in order. This is the traversal of J. Amanatides and A. Woo,
/// "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987; it skips whole empty bricks.
template <class Visit>
void DensityGrid::walk(const vec3& objectOrigin, const vec3& objectDirection, float t0, float t1,
                       const Visit& visit) const {
  const vec3 origin = transformPoint(indexFromObject_, objectOrigin),
             direction = transformVector(indexFromObject_, objectDirection);
  const vec3 inverse = 1.0f / direction;
  float t = t0;
  ivec3 cell(glm::floor(origin + t * direction));
  while (t < t1) {
    const ptrdiff_t e = entry(brickOf(cell));
    const int size = e >= 0 && occupied_[static_cast<size_t>(e)] ? 1 : kSide;
    const ivec3 low = size == 1 ? cell : brickOf(cell) * kSide;
    int axis = -1;
    float exit = t1;
    for (int k = 0; k < 3; ++k) {
      if (direction[k] == 0) continue;
      const float leaves = (static_cast<float>(direction[k] > 0 ? low[k] + size : low[k]) - origin[k]) * inverse[k];
      if (leaves < exit) {
        axis = k;
        exit = leaves;
      }
    }
    exit = std::max(exit, t);
    if (exit > t) visit(exit, size == 1 ? integral(cell, origin, direction, t, exit) : 0.0f);
    if (axis < 0) return;
    t = exit;
    for (int k = 0; k < 3; ++k)
      if (size > 1 && k != axis)
        cell[k] = glm::clamp(static_cast<int>(std::floor(origin[k] + t * direction[k])), low[k], low[k] + size - 1);
    cell[axis] = direction[axis] > 0 ? low[axis] + size : low[axis] - 1;
  }
}

bool cutLine(const Bound3& box, const vec3& origin, const vec3& direction, float& t0, float& t1) {
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0) {
      if (origin[k] < box.lo[k] || origin[k] > box.hi[k]) return false;
      continue;
    }
    const float a = (box.lo[k] - origin[k]) / direction[k], b = (box.hi[k] - origin[k]) / direction[k];
    t0 = std::max(t0, std::min(a, b));
    t1 = std::min(t1, std::max(a, b));
  }
  return t0 < t1;
}

void DensityGrid::cross(const vec3& origin, const vec3& direction, float t0, float t1, float unit,
                        DensityAlongRay& out) const {
  out.knots.clear();
  const float start = t0;
  if (!cutLine(bound_, origin, direction, t0, t1)) return;
  out.knots.push_back({0, 0});
  if (t0 > start) out.knots.push_back({(t0 - start) * unit, 0});
  walk(origin, direction, t0, t1, [&](float end, float columnDensity) {
    DensityAlongRay::Knot& last = out.knots.back();
    const DensityAlongRay::Knot next{(end - start) * unit, last.columnDensity + columnDensity * unit};
    const bool goesOn = columnDensity == 0 && out.knots.size() > 1 &&
                        out.knots[out.knots.size() - 2].columnDensity == last.columnDensity;
    if (goesOn)
      last = next;
    else if (next.distance > last.distance)
      out.knots.push_back(next);
  });
}

float DensityGrid::columnDensity(const vec3& origin, const vec3& direction, float t0, float t1) const {
  float sum = 0;
  if (cutLine(bound_, origin, direction, t0, t1))
    walk(origin, direction, t0, t1, [&](float, float columnDensity) { sum += columnDensity; });
  return sum;
}

}  // namespace tomales
