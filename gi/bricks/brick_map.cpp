#include "gi/brick_map.h"

#include <fmt/format.h>

#include <bit>
#include <utility>

namespace tomales {

struct BrickMap::Sum {
  float* data = nullptr;
  float weight = 0;
  int surface = 0;           ///< The surface that is asked for.
  bool acrossWalls = false;  ///< Some voxel that faces as the lookup does has data of kAcrossWalls.
  // Most voxels of a lookup lie in one brick, so the last one found is kept.
  int level = -1;                         ///< Level of the last brick that was searched.
  glm::ivec3 place{0};                    ///< Its position, in bricks of that level.
  int foundLevel = -1;                    ///< Level at which a brick was found.
  std::array<int32_t, kMostLevels> path;  ///< Nodes from the root to that brick.
  BrickPtr brick;

  static_assert(kBrickWidth == 1 << 3);
  bool isOf(int l, const glm::ivec3& p) const { return l == level && p == place; }
  int indexOf(const glm::ivec3& voxel) const {
    const int up = level - foundLevel;
    return voxelIndex(voxel.x >> up & 7, voxel.y >> up & 7, voxel.z >> up & 7);
  }
};

BrickMap::BrickMap(const PointCloud& cloud) : channels_(dataOf(cloud.channels)), width_(widthOf(channels_)) {
  if (width_ > kMostWidth) throw FileError(fmt::format("more than {} floats per point", kMostWidth));
  BrickSettings settings;
  settings.maxError = 0;
  tree_ = buildBricks(cloud, settings, [&](const Brick& brick) {
            bricks_.push_back(std::make_shared<const Brick>(brick));
          }).tree;
}

BrickPtr BrickMap::cached(int32_t node) const {
  if (!file_) return bricks_[static_cast<size_t>(node)];
  return cache_->get(id_, static_cast<uint32_t>(node), [&] { return file_->brick(node); });
}

bool BrickMap::lookup(const vec3& P, const vec3& N, float radius, float* out, int surface, bool* acrossWalls) const {
  std::fill_n(out, width(), 0.0f);
  if (acrossWalls) *acrossWalls = false;
  if (tree().nodes.empty() || !isFinite(P) || std::isnan(radius)) return false;
  Sum sum;
  sum.data = out;
  sum.surface = knows(surface) ? surface : 0;
  // The level whose voxels are as wide as the lookup volume. It lies between two levels, or at either end.
  const float ideal = std::log2(tree().cube.voxelSize(0) / std::max(2 * radius, 1e-30f));
  float level = std::clamp(ideal, 0.0f, static_cast<float>(tree().deepest));
  addBetween(level, P, N, radius, sum);
  if (acrossWalls && tree().surfaces[kAcrossWalls]) {
    while (sum.acrossWalls && level < static_cast<float>(tree().deepest) && sum.foundLevel == sum.level) {
      level = std::floor(level) + 1;
      std::fill_n(out, width(), 0.0f);
      sum.weight = 0;
      sum.acrossWalls = false;
      addBetween(level, P, N, radius, sum);
    }
    *acrossWalls = sum.acrossWalls;
  }
  if (!(sum.weight > 0)) return false;
  for (int k = 0; k < width(); ++k) out[k] /= sum.weight;
  return true;
}

/// Adds the data of the levels on both sides of `level`, or of the next coarser one that has any.
void BrickMap::addBetween(float level, const vec3& P, const vec3& N, float radius, Sum& sum) const {
  const int coarse = static_cast<int>(level);
  const float t = level - static_cast<float>(coarse);
  if (t < 1) addLevel(coarse, P, N, std::max(radius, 0.5f * tree().cube.voxelSize(coarse)), 1 - t, sum);
  if (t > 0) addLevel(coarse + 1, P, N, std::max(radius, 0.5f * tree().cube.voxelSize(coarse + 1)), t, sum);
  for (int l = coarse - 1; l >= 0 && !(sum.weight > 0); --l) addLevel(l, P, N, 0.5f * tree().cube.voxelSize(l), 1, sum);
}

namespace {

/// The voxels that a lookup overlaps in one dimension, and by how much.
struct VoxelOverlap {
  int first, last;
  std::array<float, 4> overlap;

  /// Coordinates are in voxels, of which there are `end`; `half` is at most one. So it overlaps at most three voxels,
  /// or four after rounding.
  VoxelOverlap(float center, float half, int end) {
    const float lo = center - half, hi = center + half;
    first = std::min(static_cast<int>(std::max(lo, 0.0f)), end - 1);
    last = std::min(static_cast<int>(std::max(hi, 0.0f)), end - 1);
    for (int i = first; i <= last; ++i)
      overlap[static_cast<size_t>(i - first)] =
          std::min(hi, static_cast<float>(i + 1)) - std::max(lo, static_cast<float>(i));
  }
  float operator[](int i) const { return overlap[static_cast<size_t>(i - first)]; }
};

}  // namespace

inline void BrickMap::addVoxel(int level, const glm::ivec3& voxel, const vec3& N, float weight, Sum& sum,
                               int depth) const {
  if (const glm::ivec3 place = voxel >> 3; !sum.isOf(level, place)) find(level, place, sum);
  if (sum.brick->fills(sum.indexOf(voxel))) addLayers(level, voxel, N, weight, sum, depth);
}

void BrickMap::addLevel(int level, const vec3& P, const vec3& N, float halfWidth, float weight, Sum& sum) const {
  const float voxel = tree().cube.voxelSize(level);
  const int end = kBrickWidth << level;
  const vec3 p = (P - tree().cube.lo) / voxel;
  // The quotient is more than 1 only if the lookup is wider than the voxels of the root.
  const float h = std::min(halfWidth / voxel, 1.0f);
  if (glm::any(glm::lessThan(p, vec3(-2.0f))) || glm::any(glm::greaterThan(p, vec3(static_cast<float>(end) + 2))))
    return;
  const VoxelOverlap xs(p.x, h, end), ys(p.y, h, end), zs(p.z, h, end);
  std::array<float, kMostWidth> own;
  std::fill_n(own.begin(), width(), 0.0f);
  const float before = std::exchange(sum.weight, 0.0f);
  float* const all = std::exchange(sum.data, own.data());
  for (int z = zs.first; z <= zs.last; ++z)
    for (int y = ys.first; y <= ys.last; ++y)
      for (int x = xs.first; x <= xs.last; ++x)
        if (xs[x] > 0 && ys[y] > 0 && zs[z] > 0) addVoxel(level, {x, y, z}, N, xs[x] * ys[y] * zs[z], sum, 0);
  const float found = std::exchange(sum.weight, before);
  sum.data = all;
  if (!(found > 0)) return;
  for (int k = 0; k < width(); ++k) sum.data[k] += weight / found * own[static_cast<size_t>(k)];
  sum.weight += weight;
}

/// Finds the brick at this level, or the finest one above it, which holds the same data where finer bricks were left
/// out.
void BrickMap::find(int level, const glm::ivec3& place, Sum& sum) const {
  int at = 0;  // the level of the last node above both this brick and the one before
  if (sum.foundLevel < 0) {
    sum.path[0] = tree().root();
  } else {
    const int both = std::min(level, sum.foundLevel);
    const glm::ivec3 apart = (place >> (level - both)) ^ (sum.place >> (sum.level - both));
    at = both - static_cast<int>(std::bit_width(static_cast<unsigned>(apart.x | apart.y | apart.z)));
  }
  const int32_t before = sum.foundLevel < 0 ? -1 : sum.path[static_cast<size_t>(sum.foundLevel)];
  while (at < level) {
    const glm::ivec3 octant = (place >> (level - at - 1)) & 1;
    const BrickNode& node = tree().nodes[static_cast<size_t>(sum.path[static_cast<size_t>(at)])];
    const int32_t child = node.child[static_cast<size_t>(octant.x | octant.y << 1 | octant.z << 2)];
    if (child < 0) break;
    sum.path[static_cast<size_t>(++at)] = child;
  }
  if (const int32_t node = sum.path[static_cast<size_t>(at)]; node != before) sum.brick = cached(node);
  sum.level = level;
  sum.place = place;
  sum.foundLevel = at;
}

/// Adds the layers of a voxel. Pre: the voxel is filled, and its brick is found.
void BrickMap::addLayers(int level, const glm::ivec3& voxel, const vec3& N, float weight, Sum& sum, int depth) const {
  const Brick::Range layers = sum.brick->layersOf(sum.indexOf(voxel));
  if (sum.foundLevel == level && level < tree().deepest && depth < 2 && N != vec3(0.0f)) {
    bool incoherent = false;
    for (size_t l = layers.first; l < layers.end; ++l) incoherent |= sum.brick->layer(l).incoherent != 0;
    if (incoherent && addFiner(level, voxel, N, weight, sum, depth)) return;
  }
  for (size_t l = layers.first; l < layers.end; ++l) {
    const BrickLayer& layer = sum.brick->layer(l);
    sum.acrossWalls |= layer.surface == kAcrossWalls && layer.faces(N);
    if (!layer.answers(N, sum.surface)) continue;
    sum.brick->add(l, weight, sum.data);
    sum.weight += weight;
  }
}

/// Adds the data of finer voxels in place of this one, whose layers merge directions that the finer ones keep apart
/// (3.3). Returns false if nothing is found there.
bool BrickMap::addFiner(int level, const glm::ivec3& voxel, const vec3& N, float weight, Sum& sum, int depth) const {
  const float before = sum.weight;
  for (int k = 0; k < 8; ++k) addVoxel(level + 1, voxel * 2 + octantOffset(k), N, weight / 8, sum, depth + 1);
  if (sum.weight > before) return true;
  find(level, voxel >> 3, sum);
  return false;
}

namespace {

/// `points` may be in memory or on disk.
template <class Points>
BuiltBricks write(const Points& points, const std::vector<CloudChannel>& channels, const BrickSettings& settings,
                  const std::string& path, const MadeFrom& madeFrom) {
  BrickFileWriter file(path);
  BuiltBricks built = buildBricks(points, settings, [&](const Brick& brick) { file.add(brick); });
  file.finish(channels, built.tree, madeFrom);
  return built;
}

}  // namespace

BuiltBricks writeBrickMap(const PointCloud& cloud, const BrickSettings& settings, const std::string& path,
                          const MadeFrom& madeFrom) {
  if (cloud.width() > kMostWidth)
    throw FileError(fmt::format("\"{}\": more than {} floats per point", path, kMostWidth));
  return write(cloud, dataOf(cloud.channels), settings, path, madeFrom);
}

BuiltBricks writeBrickMap(const PointTiles& points, const BrickSettings& settings, const std::string& path,
                          const MadeFrom& madeFrom) {
  return write(points, dataOf(points.file().channels()), settings, path, madeFrom);
}

}  // namespace tomales
