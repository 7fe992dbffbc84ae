#include "gi/brick_map.h"

#include <fmt/format.h>

namespace tomales {

struct BrickMap::Sum {
  float* data;
  float weight = 0;
  int32_t lastNode = -1;  ///< Most voxels of a lookup lie in one brick.
  BrickPtr last;
};

BrickPtr BrickMap::cached(int32_t node) const {
  return cache_.get(id_, static_cast<uint32_t>(node), [&] { return file_.brick(node); });
}

bool BrickMap::lookup(const vec3& P, const vec3& N, float radius, float* out) const {
  std::fill_n(out, width(), 0.0f);
  if (tree().nodes.empty() || !isFinite(P)) return false;
  Sum sum{out, 0, -1, nullptr};
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
  const float before = sum.weight;
  Sum part{sum.data, 0, sum.lastNode, sum.last};
  std::array<float, BrickFile::kMostWidth> own{};
  part.data = own.data();
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        const glm::ivec3 v(x, y, z);
        const vec3 overlap = glm::min(p + h, vec3(v + 1)) - glm::max(p - h, vec3(v));
        const float share = overlap.x * overlap.y * overlap.z;
        if (overlap.x > 0 && overlap.y > 0 && overlap.z > 0) addVoxel(level, v, N, share, part, 0);
      }
  sum.lastNode = part.lastNode, sum.last = part.last;
  if (!(part.weight > 0)) return;
  for (int k = 0; k < width(); ++k) sum.data[k] += weight * own[static_cast<size_t>(k)] / part.weight;
  sum.weight = before + weight;
}

void BrickMap::addVoxel(int level, const glm::ivec3& voxel, const vec3& N, float weight, Sum& sum, int depth) const {
  // Down to the brick at this level, or to the finest above it: what was left out there says the same.
  int32_t node = tree().root();
  int at = 0;
  while (at < level) {
    const glm::ivec3 octant = (voxel >> (level - at + 2)) & 1;
    const int32_t child = tree().nodes[static_cast<size_t>(node)].child[static_cast<size_t>(octant.x | octant.y << 1 | octant.z << 2)];
    if (child < 0) break;
    node = child, ++at;
  }
  if (node != sum.lastNode) sum.last = cached(node), sum.lastNode = node;
  const Brick& b = *sum.last;
  const glm::ivec3 local = (voxel >> (level - at)) & (kBrickWidth - 1);
  const auto v = static_cast<size_t>(voxelIndex(local.x, local.y, local.z));
  for (size_t l = b.first[v]; l < b.first[v + 1]; ++l) {
    const BrickLayer& layer = b.layers[l];
    if (layer.incoherent && at == level && level < tree().deepest && depth < 2 && N != vec3(0.0f)) {
      // Too many directions met here: finer voxels tell them apart (3.3). That covers every layer of the voxel.
      const BrickPtr held = sum.last;
      const float before = sum.weight;
      for (int k = 0; k < 8; ++k)
        addVoxel(level + 1, voxel * 2 + glm::ivec3(k & 1, k >> 1 & 1, k >> 2 & 1), N, weight / 8, sum, depth + 1);
      if (sum.weight > before) return;
      sum.last = held, sum.lastNode = node;
    }
  }
  for (size_t l = b.first[v]; l < b.first[v + 1]; ++l) {
    const vec3& n = b.layers[l].normal;
    if (N != vec3(0.0f) && n != vec3(0.0f) && dot(N, n) < kLayerCosine) continue;
    const float* data = b.data.data() + l * static_cast<size_t>(width());
    for (int k = 0; k < width(); ++k) sum.data[k] += weight * data[k];
    sum.weight += weight;
  }
}

BuiltBricks writeBrickMap(const PointCloud& cloud, const BrickSettings& settings, const std::string& path) {
  if (cloud.width() > BrickFile::kMostWidth) throw FileError(fmt::format("\"{}\": more than {} floats a point", path, BrickFile::kMostWidth));
  BrickFileWriter file(path);
  BuiltBricks built = buildBricks(cloud, settings, [&](const Brick& brick) { file.add(brick); });
  file.finish(cloud.channels, built.tree);
  return built;
}

}  // namespace tomales
