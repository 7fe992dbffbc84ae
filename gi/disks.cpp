#include "gi/disks.h"

#include <algorithm>

#include "reyes/base/chunk_file.h"

namespace tomales {
namespace {

constexpr uint32_t kLeaf = 8;
constexpr int kCells = 400;            // as a cube of 12 x 12 pixels a face has in one hemisphere
constexpr float kOwnPlane = 0.05f;     // of its radius: nearer, a disk is that of the point itself, or of its neighbours

/// How one thing covers part of a cell.
struct Splat {
  int cell;
  float share, distance;
  uint32_t order;
  vec3 light;
  bool operator<(const Splat& o) const {
    return cell != o.cell ? cell < o.cell : distance != o.distance ? distance < o.distance : order < o.order;
  }
};

}  // namespace

void Disks::Sum::add(const Sum& o) {
  P += o.area * o.P;  // divided by the area when all are in
  area += o.area, facing += o.facing, front += o.front, light += o.light, lightFront += o.lightFront;
}

Disks::Sum Disks::sumOf(const Disk& d) {
  const bool sphere = d.N == vec3(0);
  return {d.P, d.area, d.area * (sphere ? mat3(1.0f) : glm::outerProduct(d.N, d.N)), sphere ? vec3(0) : d.area * d.N, d.area * d.light,
          glm::outerProduct(d.area * d.light, d.N)};
}

Disks::Disks(const PointCloud& cloud, const std::string& channel) : cells_(hemisphereCells(kCells)) {
  const int area = offsetOf(cloud.channels, "_area", 1), light = channel.empty() ? -1 : offsetOf(cloud.channels, channel, 3);
  if (!channel.empty() && light < 0) throw FileError("has no channel \"" + channel + "\" of 3 floats");
  disks_.reserve(cloud.count());
  for (size_t i = 0; i < cloud.count(); ++i) {
    const float r = cloud.radius[i], *values = cloud.at(i), a = area >= 0 ? values[area] : cloud.normal[i] == vec3(0) ? kPi * r * r : 2 * r * r;
    if (!(a > 0)) continue;
    const vec3 L = light >= 0 ? vec3(values[light], values[light + 1], values[light + 2]) : vec3(0);
    disks_.push_back({cloud.position[i], cloud.normal[i], r > 0 ? r : std::sqrt(a / kPi), a, L});
  }
  for (int ring = 0; ring < cells_.rings; ++ring)
    for (int sector = 0; sector < cells_.sectors; ++sector) directions_.push_back(hemisphereDirection(cells_, ring, sector, vec2(0.5f)));
  if (!disks_.empty()) build(0, static_cast<uint32_t>(disks_.size()));
}

uint32_t Disks::build(uint32_t begin, uint32_t end) {
  const auto node = static_cast<uint32_t>(groups_.size());
  Group group{{}, {}, 0, begin, end, 0};
  for (uint32_t i = begin; i < end; ++i) {
    group.sum.add(sumOf(disks_[i]));
    group.bound.extend(disks_[i].P - disks_[i].radius), group.bound.extend(disks_[i].P + disks_[i].radius);
  }
  group.sum.P /= group.sum.area;
  const vec3 size = group.bound.size();
  group.seen = std::max(group.sum.area, 0.5f * dot(size, size));  // however sparse it is
  groups_.push_back(group);
  if (end - begin <= kLeaf) return node;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(disks_.begin() + begin, disks_.begin() + middle, disks_.begin() + end,
                   [axis](const Disk& a, const Disk& b) { return a.P[axis] < b.P[axis]; });
  build(begin, middle);
  const uint32_t second = build(middle, end);
  groups_[node].second = second;
  return node;
}

/// One hemisphere while the tree is walked.
class Disks::View {
 public:
  View(const Disks& disks, const vec3& P, const vec3& N, const DisksQuery& query)
      : disks_(disks), P_(P), N_(N), query_(query), leastCosine_(query.coneAngle < kPi / 2 ? std::cos(query.coneAngle) : 0.0f) {
    orthonormalBasis(N, tangent_, bitangent_);
    splats_.clear();
    inCone_ = static_cast<float>(std::count_if(disks.directions_.begin(), disks.directions_.end(), [&](const vec3& d) { return d.z >= leastCosine_; }));
  }

  void walk() {
    uint32_t open[64];  // halving 2^32 disks goes no deeper
    size_t depth = 0;
    if (!disks_.groups_.empty()) open[depth++] = 0;
    while (depth > 0) {
      const uint32_t node = open[--depth];
      const Group& group = disks_.groups_[node];
      if (isBelow(group.bound)) continue;
      const vec3 way = group.sum.P - P_, outside = glm::max(glm::max(group.bound.lo - P_, P_ - group.bound.hi), vec3(0));
      if (outside != vec3(0) && dot(way, N_) > 0 && group.seen < query_.maxSolidAngle * dot(way, way)) {
        addFar(group.sum);
      } else if (group.second != 0) {
        open[depth++] = group.second, open[depth++] = node + 1;
      } else {
        for (uint32_t i = group.begin; i < group.end; ++i) add(disks_.disks_[i]);
      }
    }
  }

  HemisphereView result() {
    HemisphereView out;
    if (!(inCone_ > 0)) return out;
    if (query_.clamp) std::sort(splats_.begin(), splats_.end());
    float left = 1;
    for (size_t k = 0; k < splats_.size(); ++k) {
      const Splat& s = splats_[k];
      if (k == 0 || s.cell != splats_[k - 1].cell) left = 1;
      const float share = query_.clamp ? std::min(left, s.share) : s.share;
      left -= share;
      out.covered += share / inCone_ * query_.falloff.coveredAt(s.distance);
      out.radiance += share / inCone_ * s.light;
    }
    out.covered = std::min(out.covered, 1.0f);
    return out;
  }

 private:
  bool isBelow(const Bound3& b) const {
    const vec3 highest{N_.x > 0 ? b.hi.x : b.lo.x, N_.y > 0 ? b.hi.y : b.lo.y, N_.z > 0 ? b.hi.z : b.lo.z};
    return dot(highest - P_, N_) <= 0;
  }

  void add(const Disk& disk) {
    const vec3 way = disk.P - P_;
    const float squared = dot(way, way);
    if (squared > 4 * disk.radius * disk.radius && disk.area < query_.maxSolidAngle * squared)
      addFar(sumOf(disk));
    else
      addNear(disk);
  }

  /// As a disk of its own direction, on as many cells as it is large.
  void addFar(const Sum& sum) {
    const vec3 way = sum.P - P_;
    const float distance = glm::length(way);
    const vec3 d = way / distance, local{dot(d, tangent_), dot(d, bitangent_), dot(d, N_)};
    if (distance > query_.falloff.maxDistance || distance < query_.falloff.bias || local.z < std::max(leastCosine_, 1e-6f)) return;
    const float across = std::sqrt(std::max(0.0f, sum.area * dot(d, sum.facing * d)));  // what it covers as seen from here
    if (!(across > 0)) return;
    const float front = std::clamp(0.5f - 0.5f * dot(sum.front, d) / across, 0.0f, 1.0f), sides = shown(front);
    const vec3 light = glm::max(0.5f * (sum.light / sum.area - sum.lightFront * d / across), vec3(0));
    const float angle = across / (distance * distance), share = sides * angle * local.z * static_cast<float>(disks_.directions_.size()) / kPi;
    if (share <= 1) return splat(cellOf(disks_.cells_, local), share, distance, light);
    const float cosine = 1 - angle / (2 * kPi);
    within_.clear();
    for (size_t c = 0; c < disks_.directions_.size(); ++c)
      if (dot(disks_.directions_[c], local) > cosine && disks_.directions_[c].z >= leastCosine_) within_.push_back(static_cast<int>(c));
    if (within_.empty()) within_.push_back(cellOf(disks_.cells_, local));
    for (const int c : within_) splat(c, share / static_cast<float>(within_.size()), distance, light);
  }

  /// Where the middle of each cell meets it.
  void addNear(const Disk& disk) {
    const vec3 way = disk.P - P_, n = disk.N == vec3(0) ? normalizeOr(-way, N_) : disk.N;
    const float least = query_.falloff.bias >= 0 ? query_.falloff.bias : kOwnPlane * disk.radius, r2 = disk.radius * disk.radius;
    const float share = query_.clamp ? 1.0f : std::min(1.0f, disk.area / (kPi * r2));  // disks overlap
    for (size_t c = 0; c < disks_.directions_.size(); ++c) {
      const vec3& local = disks_.directions_[c];
      if (local.z < leastCosine_) continue;
      const vec3 d = local.x * tangent_ + local.y * bitangent_ + local.z * N_;
      const float facing = dot(n, d), t = dot(n, way) / facing;
      if (!(t > least) || t > query_.falloff.maxDistance || dot(t * d - way, t * d - way) > r2) continue;
      const float front = facing < 0 ? 1.0f : 0.0f;
      splat(static_cast<int>(c), share * shown(front), t, front * disk.light);
    }
  }

  /// Of the share that faces the point.
  float shown(float front) const {
    const HitSides sides = query_.falloff.sides;
    return sides == HitSides::Both ? 1.0f : sides == HitSides::Front ? front : 1 - front;
  }
  void splat(int cell, float share, float distance, const vec3& light) {
    if (share > 0) splats_.push_back({cell, share, distance, static_cast<uint32_t>(splats_.size()), light});
  }

  const Disks& disks_;
  const vec3 P_, N_;
  const DisksQuery& query_;
  const float leastCosine_;
  float inCone_ = 0;  ///< Cells
  vec3 tangent_, bitangent_;
  static thread_local std::vector<Splat> splats_;
  static thread_local std::vector<int> within_;
};

thread_local std::vector<Splat> Disks::View::splats_;
thread_local std::vector<int> Disks::View::within_;

HemisphereView Disks::seenFrom(const vec3& P, const vec3& N, const DisksQuery& query) const {
  View view(*this, P, N, query);
  view.walk();
  return view.result();
}

}  // namespace tomales
