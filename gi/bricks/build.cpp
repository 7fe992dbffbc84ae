#include "gi/bricks/build.h"

#include <deque>
#include <numeric>

#include "gi/bricks/accumulate.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

using Members = std::vector<uint32_t>;

/// A point as it is added to voxels: flat along its normal, or a sphere where it has none.
struct Spot {
  vec3 center;
  vec3 half;    ///< Half the sides of the box around it.
  vec3 normal;  ///< Zero: a sphere.
  float radius;
  uint8_t surface;
};

/// The voxels that a point's box overlaps in one dimension: which, the share of the box in each, and the height of
/// their middles over the point's plane.
struct Shares {
  size_t first, last;
  std::array<float, kBrickWidth> share, height;

  /// `center` and `half` in voxels.
  Shares(float center, float half, float normal) {
    const float lo = center - half, hi = center + half;
    first = voxelOf(lo);
    last = voxelOf(hi);
    const bool hasLength = half > 1e-5f;  // otherwise the part lies in one voxel as a whole
    for (size_t i = first; i <= last; ++i) {
      const auto at = static_cast<float>(i);
      share[i] = hasLength ? std::max(0.0f, std::min(hi, at + 1) - std::max(lo, at)) / (2 * half) : 1.0f;
      height[i] = normal * (at + 0.5f - center);
    }
  }

 private:
  static size_t voxelOf(float at) { return static_cast<size_t>(std::clamp(at, 0.0f, kBrickWidth - 1.0f)); }
};

class Builder {
 public:
  Builder(const BrickCube& cube, int width, const BrickSettings& settings,
          const std::function<void(const Brick&)>& store)
      : settings_(settings), store_(store), width_(static_cast<size_t>(width)) {
    out_.tree.cube = cube;
  }

  BuiltBricks run(const PointCloud& cloud) {
    BrickNode root;
    accumulate(0, glm::ivec3(0), use(cloud), root);
    keep(0, root);
    return std::move(out_);
  }

  BuiltBricks run(const PointTiles& tiles, uint64_t most) {
    BrickNode root;
    accumulate(tiles, most, 0, glm::ivec3(0), root);
    keep(0, root);
    return std::move(out_);
  }

 private:
  /// The data of one level. Memory holds no more than this and the points.
  struct Level {
    explicit Level(size_t width) : sums(width) {}
    BrickAccumulator sums;
    std::array<Members, 8> parts;
  };

  /// Sets the points to work on, and returns the indices of all of them.
  Members use(const PointCloud& cloud) {
    cloud_ = &cloud;
    spots_.clear();
    spots_.reserve(cloud.count());
    for (size_t i = 0; i < cloud.count(); ++i) {
      spots_.push_back(spot(i));
      out_.tree.surfaces.set(spots_.back().surface);
    }
    Members all(cloud.count());
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }

  Spot spot(size_t i) const {
    const vec3 n = settings_.ignoreNormals ? vec3(0.0f) : cloud_->normal[i];
    const float r = cloud_->radius[i] * settings_.radiusScale;
    const vec3 half = n == vec3(0.0f) ? vec3(r) : r * glm::sqrt(glm::max(vec3(1.0f) - n * n, vec3(0.0f)));
    return {cloud_->position[i], half, n, r, static_cast<uint8_t>(cloud_->surface(i))};
  }

  Level& at(int level) {
    while (static_cast<int>(levels_.size()) <= level) levels_.emplace_back(width_);
    return levels_[static_cast<size_t>(level)];
  }

  int32_t keep(int level, const BrickNode& node) {
    store_(at(level).sums.finish(settings_.maxError));
    out_.tree.nodes.push_back(node);
    out_.tree.deepest = std::max(out_.tree.deepest, level);
    return out_.tree.root();
  }

  /// Tells whether no point of the cube is smaller than half the diagonal of its voxels (Christensen and Batali 2004,
  /// section 3.2), or nothing can be divided.
  bool fineEnough(int level, const vec3& lo, const Members& members) const {
    if (level >= settings_.maxDepth || members.size() <= 1) return true;
    const float half = 0.5f * std::sqrt(3.0f) * out_.tree.cube.voxelSize(level) / settings_.coarseness;
    const vec3 hi = lo + vec3(std::ldexp(out_.tree.cube.size, -level));
    return std::none_of(members.begin(), members.end(), [&](uint32_t i) {
      const Spot& s = spots_[i];
      return s.radius < half && glm::all(glm::greaterThanEqual(s.center, lo)) && glm::all(glm::lessThan(s.center, hi));
    });
  }

  vec3 corner(int level, const glm::ivec3& place) const {
    return out_.tree.cube.lo + std::ldexp(out_.tree.cube.size, -level) * vec3(place);
  }
  static glm::ivec3 placeOfChild(const glm::ivec3& place, int octant) { return place * 2 + octantOffset(octant); }

  /// Fills the sums of `level` with the cube at `place` (counted in cubes of that level), and `node` with the children
  /// that are kept.
  void accumulate(int level, const glm::ivec3& place, const Members& members, BrickNode& node) {
    throwIfStopped();
    Level& here = at(level);
    here.sums.clear();
    const vec3 lo = corner(level, place);
    if (fineEnough(level, lo, members)) {
      for (const uint32_t i : members) splat(i, lo, out_.tree.cube.voxelSize(level), here.sums);
      return;
    }
    partition(members, corner(level + 1, place * 2 + 1), here.parts);
    for (int octant = 0; octant < 8; ++octant) {
      const Members& part = here.parts[static_cast<size_t>(octant)];
      if (part.empty()) continue;
      BrickNode child;
      accumulate(level + 1, placeOfChild(place, octant), part, child);
      addChild(level, octant, child, node);
    }
  }

  /// Does the same for points on disk. Returns false if there are none.
  bool accumulate(const PointTiles& tiles, uint64_t most, int level, const glm::ivec3& place, BrickNode& node) {
    if (tiles.count(level, place) <= most || level == PointTiles::kDeepest || level >= settings_.maxDepth) {
      const Bound3 box = tiles.box(level, place);
      const PointCloud cloud = tiles.around(box, 0, settings_.radiusScale);
      Members members = use(cloud);
      std::erase_if(members, [&](uint32_t i) {  // this divides as partition() does
        const Spot& s = spots_[i];
        return glm::any(glm::greaterThanEqual(s.center - s.half, box.hi)) ||
               glm::any(glm::lessThan(s.center + s.half, box.lo));
      });
      accumulate(level, place, members, node);
      return !members.empty();
    }
    at(level).sums.clear();
    for (int octant = 0; octant < 8; ++octant) {
      BrickNode child;
      if (accumulate(tiles, most, level + 1, placeOfChild(place, octant), child)) addChild(level, octant, child, node);
    }
    return true;
  }

  /// Adds the finished sums of a child, one level below, to those of `level`, and stores the child unless the sums say
  /// the same.
  void addChild(int level, int octant, const BrickNode& child, BrickNode& node) {
    const float spread = at(level).sums.addChild(at(level + 1).sums, octant);
    const bool leaf = std::all_of(child.child.begin(), child.child.end(), [](int32_t c) { return c < 0; });
    if (leaf && spread <= settings_.maxError)
      ++out_.eliminated;
    else
      node.child[static_cast<size_t>(octant)] = keep(level + 1, child);
  }

  /// Sorts points into the octants around `middle` that their boxes touch.
  void partition(const Members& members, const vec3& middle, std::array<Members, 8>& parts) const {
    for (Members& part : parts) part.clear();
    for (const uint32_t i : members) {
      const Spot& s = spots_[i];
      unsigned low = 0, high = 0;
      for (int k = 0; k < 3; ++k) {
        low |= static_cast<unsigned>(s.center[k] - s.half[k] < middle[k]) << k;
        high |= static_cast<unsigned>(s.center[k] + s.half[k] >= middle[k]) << k;
      }
      for (unsigned octant = 0; octant < 8; ++octant)
        if ((octant & ~high) == 0 && (~octant & 7 & ~low) == 0) parts[octant].push_back(i);
    }
  }

  /// Adds a point to the voxels that its box and its plane cross, by the share of the box in each.
  void splat(uint32_t i, const vec3& lo, float voxel, BrickAccumulator& to) const {
    const Spot& s = spots_[i];
    const vec3 p = (s.center - lo) / voxel, h = s.half / voxel, n = s.normal;
    const bool oriented = n != vec3(0.0f);
    const float r = std::max(s.radius / voxel, 1e-3f);
    const float size = oriented ? r * r : r * r * r;  // area or volume, up to a constant factor
    const float reach = 0.5f * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    const Shares xs(p.x, h.x, n.x), ys(p.y, h.y, n.y), zs(p.z, h.z, n.z);
    const float* data = cloud_->at(i);
    for (size_t z = zs.first; z <= zs.last; ++z)
      for (size_t y = ys.first; y <= ys.last; ++y)
        for (size_t x = xs.first; x <= xs.last; ++x) {
          if (std::abs(xs.height[x] + ys.height[y] + zs.height[z]) > reach) continue;
          const float weight = size * xs.share[x] * ys.share[y] * zs.share[z];
          if (weight > 0)
            to.add(voxelIndex(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)), weight * n, weight,
                   s.surface, data, weight);
        }
  }

  const BrickSettings settings_;
  const std::function<void(const Brick&)>& store_;
  const size_t width_;
  BuiltBricks out_;
  const PointCloud* cloud_ = nullptr;
  std::vector<Spot> spots_;
  std::deque<Level> levels_;  // a deque, because references to upper levels are in use while deeper ones are added
};

}  // namespace

BuiltBricks buildBricks(const PointCloud& cloud, const BrickSettings& settings,
                        const std::function<void(const Brick&)>& store) {
  if (cloud.count() == 0) return {};
  return Builder(cubeAround(cloud.bound()), widthOf(dataOf(cloud.channels)), settings, store).run(cloud);
}

BuiltBricks buildBricks(const PointTiles& tiles, const BrickSettings& settings,
                        const std::function<void(const Brick&)>& store, uint64_t most) {
  if (tiles.file().count() == 0) return {};
  return Builder(tiles.cube(), widthOf(dataOf(tiles.file().channels())), settings, store).run(tiles, most);
}

}  // namespace tomales
