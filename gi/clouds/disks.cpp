#include "gi/clouds/disks.h"

#include "gi/clouds/halves.h"

namespace tomales {
namespace {

constexpr int kLinesOfSight = 1024;
// Turn between successive directions of a spiral, whose points are evenly spread.
constexpr float kGoldenAngle = 2.399963f;
// The squared radius of the disk that stands for a group, over the area that the group covers (LineOfSight::meet).
constexpr float kSquaredReach = 0.625f;
// A disk nearer than this share of its radius, or of that of the micropolygon that looks, belongs to the point itself
// or to its neighbours.
constexpr float kOwnPlane = 0.3f;
// The middle of a micropolygon on a convex surface lies below it, and a level line of sight leaves the surface only
// beyond the micropolygon's radius. So backs that are nearer than that are the surface's own.
constexpr float kOwnBack = 1.0f;
// A disk that is this many times as large as a near micropolygon shows as a blotch.
constexpr float kMuchLarger = 3.0f;

}  // namespace

void Disks::Sum::add(const Sum& o) {
  P += o.area * o.P;  // o.P is divided by the area when all disks are added
  area += o.area;
  facing += o.facing;
  front += o.front;
  light += o.light;
  lightFront += o.lightFront;
}

Disks::Sum Disks::sumOf(const Disk& d) {
  const bool sphere = d.N == vec3(0);
  return {d.P,
          d.area,
          d.area * (sphere ? mat3(1.0f) : glm::outerProduct(d.N, d.N)),
          sphere ? vec3(0) : d.area * d.N,
          d.area * d.light,
          glm::outerProduct(d.area * d.light, d.N)};
}

Disks::Disks(const PointCloud& cloud, const std::string& channel) {
  const int area = offsetOf(cloud.channels, "_area", 1), light = offsetOf(cloud.channels, channel, 3);
  sends_ = light >= 0;
  disks_.reserve(cloud.count());
  for (size_t i = 0; i < cloud.count(); ++i) {
    const float r = cloud.radius[i], *values = cloud.at(i),
                a = area >= 0                    ? values[area]
                    : cloud.normal[i] == vec3(0) ? kPi * r * r
                                                 : 2 * r * r;
    if (!(a > 0)) continue;
    const vec3 L = light >= 0 ? vec3(values[light], values[light + 1], values[light + 2]) : vec3(0);
    disks_.push_back({cloud.position[i], cloud.normal[i], r > 0 ? r : std::sqrt(a / kPi), a, L});
  }
  for (int k = 0; k < kLinesOfSight; ++k) {
    const float r2 = (static_cast<float>(k) + 0.5f) / kLinesOfSight, r = std::sqrt(r2),
                phi = kGoldenAngle * static_cast<float>(k);
    directions_.push_back({r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r2)});
  }
  if (!disks_.empty()) build(0, static_cast<uint32_t>(disks_.size()));
}

uint32_t Disks::build(uint32_t begin, uint32_t end) {
  const auto node = static_cast<uint32_t>(groups_.size());
  Group group{{}, {}, 0, begin, end, 0};
  for (uint32_t i = begin; i < end; ++i) {
    group.sum.add(sumOf(disks_[i]));
    group.bound.extend(disks_[i].P - disks_[i].radius);
    group.bound.extend(disks_[i].P + disks_[i].radius);
  }
  group.sum.P /= group.sum.area;
  const vec3 size = group.bound.size();
  group.seen = std::max(group.sum.area, 0.5f * dot(size, size));  // as in Diffusion::build()
  groups_.push_back(group);
  const auto middle = halve(disks_, begin, end, size);
  if (!middle) return node;
  build(begin, *middle);
  const uint32_t second = build(*middle, end);
  groups_[node].second = second;
  return node;
}

/// One line of sight through the tree.
class Disks::LineOfSight {
 public:
  LineOfSight(const Disks& disks, const vec3& P, float radius, const vec3& d, const DisksQuery& query)
      : disks_(disks),
        P_(P),
        d_(d),
        over_(1.0f / d),
        radius_(radius),
        query_(query),
        reach_(query.falloff.maxDistance) {}

  void walk() {
    uint32_t open[64];  // a tree that halves 2^32 disks is no deeper
    size_t depth = 0;
    if (!disks_.groups_.empty()) open[depth++] = 0;
    while (depth > 0) {
      const uint32_t node = open[--depth];
      const Group& group = disks_.groups_[node];
      if (!crosses(group.bound)) continue;
      const vec3 way = group.sum.P - P_,
                 outside = glm::max(glm::max(group.bound.lo - P_, P_ - group.bound.hi), vec3(0));
      if (outside != vec3(0) && group.seen < query_.maxSolidAngle * dot(way, way)) {
        meet(group.sum);
      } else if (group.second != 0) {
        open[depth++] = group.second;
        open[depth++] = node + 1;
      } else {
        for (uint32_t i = group.begin; i < group.end; ++i) meet(disks_.disks_[i]);
      }
    }
  }

  float covered = 0;
  vec3 light{0.0f};
  bool coarse = false;

 private:
  bool crosses(const Bound3& b) const {
    const vec3 a = (b.lo - P_) * over_, c = (b.hi - P_) * over_, first = glm::min(a, c), last = glm::max(a, c);
    return std::max({first.x, first.y, first.z, 0.0f}) <= std::min({last.x, last.y, last.z, reach_});
  }

  /// Returns the distance within which a disk belongs to the receiver's own surface.
  float own(float diskRadius, bool back) const {
    if (query_.falloff.bias >= 0) return query_.falloff.bias;
    return std::max(kOwnPlane * diskRadius, (back ? kOwnBack : kOwnPlane) * radius_);
  }

  /// Meets a group as a disk across its direction. The disk reaches the corners of a rectangle of the group's covered
  /// area with sides of two to one, so that no light comes through between neighbours.
  void meet(const Sum& sum) {
    const vec3 way = sum.P - P_;
    const float t = dot(way, d_);
    const float all = std::sqrt(std::max(0.0f, sum.area * dot(d_, sum.facing * d_))),
                facing = std::clamp(-dot(sum.front, d_), -all, all);
    const float front = 0.5f * (all + facing), back = 0.5f * (all - facing),
                across = std::max(front, back);  // on a closed surface the fronts hide the backs
    if (!(across > 0) || !(t > own(0, back > front)) || dot(way, way) - t * t > kSquaredReach * across) return;
    add(t, 1 / (kPi * kSquaredReach), front / across, back / across,
        glm::max(0.5f * (all / sum.area * sum.light - sum.lightFront * d_), vec3(0)) / across, false);
  }

  void meet(const Disk& disk) {
    const vec3 way = disk.P - P_, n = disk.N == vec3(0) ? -d_ : disk.N;
    const float r2 = disk.radius * disk.radius;
    const float facing = dot(n, d_), t = dot(n, way) / facing;
    const vec3 off = t * d_ - way;
    if (!(t > own(disk.radius, facing > 0)) || !(dot(off, off) <= r2)) return;
    const float front = facing < 0 ? 1.0f : 0.0f;
    add(t, std::min(1.0f, disk.area / (kPi * r2)), front, 1 - front, front * disk.light,
        radius_ > 0 && disk.radius > kMuchLarger * radius_ && t < disk.radius);
  }

  /// `share` is the share of the disk that counts, since disks overlap.
  void add(float t, float share, float front, float back, const vec3& sends, bool isCoarse) {
    const HitSides sides = query_.falloff.sides;
    const float shown = sides == HitSides::Both ? 1.0f : sides == HitSides::Front ? front : back;
    if (t > reach_ || !(shown > 0)) return;
    if (!query_.clamp) {
      covered += share * shown * query_.falloff.coveredAt(t);
      light += share * sends;
      coarse = coarse || isCoarse;
      return;
    }
    reach_ = t;
    covered = shown * query_.falloff.coveredAt(t);
    light = sends;
    coarse = isCoarse;
  }

  const Disks& disks_;
  const vec3 P_, d_, over_;
  const float radius_;  ///< Radius of the receiver.
  const DisksQuery& query_;
  float reach_;  ///< Distance beyond which disks do not count.
};

HemisphereView Disks::seenFrom(const vec3& P, const vec3& N, const DisksQuery& query, float radius) const {
  vec3 tangent, bitangent;
  orthonormalBasis(N, tangent, bitangent);
  const float spread = std::sin(std::clamp(query.coneAngle, 0.0f, kPi / 2));
  HemisphereView out;
  for (const vec3& whole : directions_) {
    const vec2 d = spread * vec2(whole);
    const vec3 local(d, std::sqrt(std::max(0.0f, 1 - dot(d, d))));
    LineOfSight sight(*this, P, radius, local.x * tangent + local.y * bitangent + local.z * N, query);
    sight.walk();
    out.covered += sight.covered / kLinesOfSight;
    out.radiance += sight.light / static_cast<float>(kLinesOfSight);
    out.coarse += sight.coarse ? 1.0f / kLinesOfSight : 0.0f;
  }
  out.covered = std::min(1.0f, out.covered);
  return out;
}

}  // namespace tomales
