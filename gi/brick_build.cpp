#include "gi/brick_build.h"

#include <memory>
#include <numeric>

#include "gi/brick_accumulate.h"

namespace tomales {
namespace {

using Members = std::vector<uint32_t>;

class Builder {
 public:
  Builder(const PointCloud& cloud, const BrickSettings& settings, const std::function<void(const Brick&)>& store)
      : cloud_(cloud), settings_(settings), store_(store), width_(cloud.width()) {}

  BuiltBricks run() {
    if (cloud_.count() == 0) return {};
    out_.tree.cube = cubeAround(cloud_.bound());
    Members all(cloud_.count());
    std::iota(all.begin(), all.end(), 0u);
    BrickNode root;
    accumulate(0, out_.tree.cube.lo, std::move(all), root);
    keep(0, root);
    return std::move(out_);
  }

 private:
  static BrickCube cubeAround(const Bound3& b) {
    const float longest = maxComponent(b.size());
    // A margin, so that the farthest points lie inside and a single one has a volume at all.
    const float size = longest * 1.001f + 1e-5f * maxComponent(glm::max(glm::abs(b.lo), glm::abs(b.hi))) + 1e-30f;
    return {b.center() - vec3(0.5f * size), size};
  }

  bool oriented(uint32_t i) const { return !settings_.ignoreNormals && cloud_.normal[i] != vec3(0.0f); }
  float radius(uint32_t i) const { return cloud_.radius[i] * settings_.radiusScale; }

  /// Half the sides of the box around a point's disk or sphere.
  vec3 halfBox(uint32_t i) const {
    const vec3 n = cloud_.normal[i];
    return oriented(i) ? radius(i) * glm::sqrt(glm::max(vec3(1.0f) - n * n, vec3(0.0f))) : vec3(radius(i));
  }

  BrickAccumulator& accumulator(int level) {
    while (static_cast<int>(levels_.size()) <= level) levels_.push_back(std::make_unique<BrickAccumulator>(width_));
    return *levels_[static_cast<size_t>(level)];
  }

  int32_t keep(int level, const BrickNode& node) {
    store_(accumulator(level).finish());
    out_.tree.nodes.push_back(node);
    out_.tree.deepest = std::max(out_.tree.deepest, level);
    return out_.tree.root();
  }

  /// No point of the cube is smaller than half the diagonal of its voxels (irradiance-atlas 3.2).
  bool fineEnough(int level, const vec3& lo, const Members& members) const {
    if (level >= settings_.maxDepth || members.size() <= 1) return true;
    const float half = 0.5f * std::sqrt(3.0f) * out_.tree.cube.voxelSize(level);
    const vec3 hi = lo + vec3(std::ldexp(out_.tree.cube.size, -level));
    return std::none_of(members.begin(), members.end(), [&](uint32_t i) {
      const vec3& p = cloud_.position[i];
      return radius(i) < half && glm::all(glm::greaterThanEqual(p, lo)) && glm::all(glm::lessThan(p, hi));
    });
  }

  /// Fills the accumulator of `level` with the cube at `lo`, and `node` with the children that are kept.
  void accumulate(int level, const vec3& lo, Members members, BrickNode& node) {
    accumulator(level).clear();
    if (fineEnough(level, lo, members)) {
      for (const uint32_t i : members) splat(i, lo, out_.tree.cube.voxelSize(level), accumulator(level));
      return;
    }
    const float size = std::ldexp(out_.tree.cube.size, -level - 1);
    std::array<Members, 8> parts = partition(members, lo + vec3(size));
    Members().swap(members);
    for (int octant = 0; octant < 8; ++octant) {
      Members& part = parts[static_cast<size_t>(octant)];
      if (part.empty()) continue;
      const vec3 childLo = lo + size * vec3(octant & 1, octant >> 1 & 1, octant >> 2 & 1);
      BrickNode child;
      accumulate(level + 1, childLo, std::move(part), child);
      const float spread = accumulator(level).addChild(accumulator(level + 1), octant);
      const bool leaf = std::all_of(child.child.begin(), child.child.end(), [](int32_t c) { return c < 0; });
      if (leaf && spread <= settings_.maxError)
        ++out_.eliminated;
      else
        node.child[static_cast<size_t>(octant)] = keep(level + 1, child);
    }
  }

  /// Points by the octants around `middle` that their boxes reach.
  std::array<Members, 8> partition(const Members& members, const vec3& middle) const {
    std::array<Members, 8> parts;
    for (const uint32_t i : members) {
      const vec3 p = cloud_.position[i], h = halfBox(i);
      const auto low = glm::lessThan(p - h, middle), high = glm::greaterThanEqual(p + h, middle);
      for (int octant = 0; octant < 8; ++octant)
        if ((octant & 1 ? high.x : low.x) && (octant & 2 ? high.y : low.y) && (octant & 4 ? high.z : low.z))
          parts[static_cast<size_t>(octant)].push_back(i);
    }
    return parts;
  }

  /// Adds a point to the voxels that its box and its plane cross, by the share of the box in each.
  void splat(uint32_t i, const vec3& lo, float voxel, BrickAccumulator& to) {
    const vec3 p = (cloud_.position[i] - lo) / voxel, h = halfBox(i) / voxel, n = cloud_.normal[i];
    const glm::ivec3 first = glm::clamp(glm::ivec3(glm::floor(p - h)), 0, kBrickWidth - 1);
    const glm::ivec3 last = glm::clamp(glm::ivec3(glm::floor(p + h)), 0, kBrickWidth - 1);
    const float r = std::max(radius(i) / voxel, 1e-3f);
    const float size = oriented(i) ? r * r : r * r * r;  // area or volume, but for a constant
    for (int z = first.z; z <= last.z; ++z)
      for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
          const vec3 corner(x, y, z), off = corner + vec3(0.5f) - p;
          if (oriented(i) && std::abs(dot(n, off)) > 0.5f * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z))) continue;
          const float weight = size * share(p, h, corner);
          if (weight > 0) addPoint(i, voxelIndex(x, y, z), weight, to);
        }
  }

  /// Of the box p +- h, the part inside the unit voxel at `corner`; a side without length lies inside as a whole.
  static float share(const vec3& p, const vec3& h, const vec3& corner) {
    float part = 1;
    for (int k = 0; k < 3; ++k)
      if (h[k] > 1e-5f)
        part *= std::max(0.0f, std::min(p[k] + h[k], corner[k] + 1) - std::max(p[k] - h[k], corner[k])) / (2 * h[k]);
    return part;
  }

  void addPoint(uint32_t i, int voxel, float weight, BrickAccumulator& to) {
    scratch_.assign(cloud_.at(i), cloud_.at(i) + width_);
    for (float& d : scratch_) d *= weight;
    to.add(voxel, {oriented(i) ? weight * cloud_.normal[i] : vec3(0.0f), weight}, scratch_.data());
  }

  const PointCloud& cloud_;
  const BrickSettings settings_;
  const std::function<void(const Brick&)>& store_;
  const int width_;
  BuiltBricks out_;
  std::vector<std::unique_ptr<BrickAccumulator>> levels_;  // one brick a level: all that is ever in memory
  std::vector<float> scratch_;
};

}  // namespace

BuiltBricks buildBricks(const PointCloud& cloud, const BrickSettings& settings, const std::function<void(const Brick&)>& store) {
  return Builder(cloud, settings, store).run();
}

}  // namespace tomales
