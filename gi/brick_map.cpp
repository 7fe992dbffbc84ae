#include "gi/brick_map.h"

#include <fmt/format.h>

#include <utility>

namespace tomales {

struct BrickMap::Sum {
  float* data = nullptr;
  float weight = 0;
  int surface = 0;               ///< That is asked for.
  // Most voxels of a lookup lie in one brick:
  int level = -1;                ///< The last was asked for at this level,
  glm::ivec3 place{0};           ///< here, in bricks of that level,
  int32_t node = -1;             ///< and is this one,
  int foundLevel = 0;            ///< which is at this level.
  BrickPtr brick;
};

BrickMap::BrickMap(const PointCloud& cloud) : channels_(dataOf(cloud.channels)), width_(widthOf(channels_)) {
  if (width_ > kMostWidth) throw FileError(fmt::format("more than {} floats a point", kMostWidth));
  BrickSettings settings;
  settings.maxError = 0;
  tree_ = buildBricks(cloud, settings, [&](const Brick& brick) { bricks_.push_back(std::make_shared<const Brick>(brick)); }).tree;
}

BrickPtr BrickMap::cached(int32_t node) const {
  if (!file_) return bricks_[static_cast<size_t>(node)];
  return cache_->get(id_, static_cast<uint32_t>(node), [&] { return file_->brick(node); });
}

bool BrickMap::lookup(const vec3& P, const vec3& N, float radius, float* out, int surface) const {
  std::fill_n(out, width(), 0.0f);
  if (tree().nodes.empty() || !isFinite(P) || std::isnan(radius)) return false;
  Sum sum;
  sum.data = out;
  sum.surface = knows(surface) ? surface : 0;
  // The level whose voxels are as wide as the lookup volume, between two levels unless at either end.
  const float ideal = std::log2(tree().cube.voxelSize(0) / std::max(2 * radius, 1e-30f));
  const float level = std::clamp(ideal, 0.0f, static_cast<float>(tree().deepest));
  const int coarse = static_cast<int>(level);
  const float t = level - static_cast<float>(coarse);
  if (t < 1) addLevel(coarse, P, N, std::max(radius, 0.5f * tree().cube.voxelSize(coarse)), 1 - t, sum);
  if (t > 0) addLevel(coarse + 1, P, N, std::max(radius, 0.5f * tree().cube.voxelSize(coarse + 1)), t, sum);
  for (int l = coarse - 1; l >= 0 && !(sum.weight > 0); --l) addLevel(l, P, N, 0.5f * tree().cube.voxelSize(l), 1, sum);
  if (!(sum.weight > 0)) return false;
  for (int k = 0; k < width(); ++k) out[k] /= sum.weight;
  return true;
}

void BrickMap::addLevel(int level, const vec3& P, const vec3& N, float halfWidth, float weight, Sum& sum) const {
  const float voxel = tree().cube.voxelSize(level);
  const int end = kBrickWidth << level;
  const vec3 p = (P - tree().cube.lo) / voxel;
  const float h = std::min(halfWidth / voxel, 1.0f);  // farther than two voxels only where the root is still too fine
  if (glm::any(glm::lessThan(p, vec3(-2.0f))) || glm::any(glm::greaterThan(p, vec3(static_cast<float>(end) + 2)))) return;
  const glm::ivec3 first = glm::clamp(glm::ivec3(glm::floor(p - h)), 0, end - 1);
  const glm::ivec3 last = glm::clamp(glm::ivec3(glm::floor(p + h)), 0, end - 1);
  std::array<float, kMostWidth> own;
  std::fill_n(own.begin(), width(), 0.0f);
  const float before = std::exchange(sum.weight, 0.0f);
  float* const all = std::exchange(sum.data, own.data());
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        const glm::ivec3 v(x, y, z);
        const vec3 overlap = glm::min(p + h, vec3(v + 1)) - glm::max(p - h, vec3(v));
        const float share = overlap.x * overlap.y * overlap.z;
        if (overlap.x > 0 && overlap.y > 0 && overlap.z > 0) addVoxel(level, v, N, share, sum, 0);
      }
  const float found = std::exchange(sum.weight, before);
  sum.data = all;
  if (!(found > 0)) return;
  for (int k = 0; k < width(); ++k) sum.data[k] += weight / found * own[static_cast<size_t>(k)];
  sum.weight += weight;
}

/// The brick at this level, or the finest above it: what was left out there says the same.
void BrickMap::find(int level, const glm::ivec3& voxel, Sum& sum) const {
  const glm::ivec3 place = voxel >> 3;
  static_assert(kBrickWidth == 1 << 3);
  if (level == sum.level && place == sum.place) return;
  int32_t node = tree().root();
  int at = 0;
  while (at < level) {
    const glm::ivec3 octant = (place >> (level - at - 1)) & 1;
    const int32_t child = tree().nodes[static_cast<size_t>(node)].child[static_cast<size_t>(octant.x | octant.y << 1 | octant.z << 2)];
    if (child < 0) break;
    node = child, ++at;
  }
  if (node != sum.node) sum.brick = cached(node);
  sum.level = level, sum.place = place, sum.node = node, sum.foundLevel = at;
}

void BrickMap::addVoxel(int level, const glm::ivec3& voxel, const vec3& N, float weight, Sum& sum, int depth) const {
  find(level, voxel, sum);
  const glm::ivec3 local = (voxel >> (level - sum.foundLevel)) & (kBrickWidth - 1);
  const int v = voxelIndex(local.x, local.y, local.z);
  const Brick::Range layers = sum.brick->layersOf(v);
  const bool finer = sum.foundLevel == level && level < tree().deepest && depth < 2 && N != vec3(0.0f);
  bool incoherent = false;
  for (size_t l = layers.first; finer && l < layers.end; ++l) incoherent |= sum.brick->layer(l).incoherent != 0;
  if (incoherent) {
    // Too many directions met here: finer voxels tell them apart (3.3). That covers every layer of the voxel.
    const float before = sum.weight;
    for (int k = 0; k < 8; ++k)
      addVoxel(level + 1, voxel * 2 + glm::ivec3(k & 1, k >> 1 & 1, k >> 2 & 1), N, weight / 8, sum, depth + 1);
    if (sum.weight > before) return;
    find(level, voxel, sum);
  }
  for (size_t l = layers.first; l < layers.end; ++l) {
    if (!sum.brick->layer(l).answers(N, sum.surface)) continue;
    sum.brick->add(l, weight, sum.data);
    sum.weight += weight;
  }
}

namespace {

/// `points`: in memory or on disk.
template <class Points>
BuiltBricks write(const Points& points, const std::vector<CloudChannel>& channels, const BrickSettings& settings, const std::string& path,
                  const MadeFrom& madeFrom) {
  BrickFileWriter file(path);
  BuiltBricks built = buildBricks(points, settings, [&](const Brick& brick) { file.add(brick); });
  file.finish(channels, built.tree, madeFrom);
  return built;
}

}  // namespace

BuiltBricks writeBrickMap(const PointCloud& cloud, const BrickSettings& settings, const std::string& path, const MadeFrom& madeFrom) {
  if (cloud.width() > kMostWidth) throw FileError(fmt::format("\"{}\": more than {} floats a point", path, kMostWidth));
  return write(cloud, dataOf(cloud.channels), settings, path, madeFrom);
}

BuiltBricks writeBrickMap(const PointTiles& points, const BrickSettings& settings, const std::string& path, const MadeFrom& madeFrom) {
  return write(points, dataOf(points.file().channels()), settings, path, madeFrom);
}

}  // namespace tomales
