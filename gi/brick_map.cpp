#include "gi/brick_map.h"

#include <fmt/format.h>

#include <limits>
#include <numeric>
#include <utility>

#include "gi/packed_normal.h"

namespace tomales {
namespace {

constexpr char kKind[9] = "TMBRICKS";
constexpr uint32_t kVersion = 2;
constexpr int kMostWidth = 256;  ///< Floats of a lookup.
constexpr int kMostLevels = 24;  ///< Voxel coordinates stay exact in int.

/// A brick as it is stored: for each layer its voxel, in order, its normal, whether that is incoherent, and its data.
Bytes packed(const Brick& brick) {
  std::vector<uint16_t> voxels;
  std::vector<uint32_t> normals;
  std::vector<uint8_t> incoherent;
  voxels.reserve(brick.layers.size()), normals.reserve(brick.layers.size()), incoherent.reserve(brick.layers.size());
  for (size_t v = 0; v < kBrickVoxels; ++v) voxels.insert(voxels.end(), brick.first[v + 1] - brick.first[v], static_cast<uint16_t>(v));
  for (const BrickLayer& l : brick.layers) normals.push_back(packNormal(l.normal)), incoherent.push_back(l.incoherent);
  ByteWriter w;
  w.put(voxels);
  w.put(normals);
  w.put(incoherent);
  w.put(brick.data);
  return std::move(w.bytes);
}

Brick unpacked(const Bytes& bytes, int width, const std::string& path) {
  ByteReader r(bytes, path);
  Brick brick;
  const auto voxels = r.getVector<uint16_t>();
  const auto normals = r.getVector<uint32_t>();
  const auto incoherent = r.getVector<uint8_t>();
  brick.data = r.getVector<float>();
  const bool whole = std::is_sorted(voxels.begin(), voxels.end()) && (voxels.empty() || voxels.back() < kBrickVoxels) &&
                     voxels.size() <= std::numeric_limits<uint16_t>::max() && normals.size() == voxels.size() &&
                     incoherent.size() == voxels.size() && brick.data.size() == voxels.size() * static_cast<size_t>(width);
  if (!whole) throw FileError(fmt::format("\"{}\" is damaged: a brick does not add up", path));
  for (const uint16_t v : voxels) ++brick.first[v + 1u];
  std::partial_sum(brick.first.begin(), brick.first.end(), brick.first.begin());
  brick.layers.reserve(voxels.size());
  for (size_t i = 0; i < voxels.size(); ++i) brick.layers.push_back({unpackNormal(normals[i]), incoherent[i] != 0});
  return brick;
}

bool sound(const BrickTree& tree) {
  const auto count = static_cast<int32_t>(tree.nodes.size());
  for (int32_t i = 0; i < count; ++i)
    for (const int32_t c : tree.nodes[static_cast<size_t>(i)].child)
      if (c < -1 || c >= i) return false;
  return isFinite(tree.cube.lo) && tree.cube.size > 0 && std::isfinite(tree.cube.size) && tree.deepest >= 0 &&
         tree.deepest < kMostLevels;
}

}  // namespace

struct BrickMap::Sum {
  float* data = nullptr;
  float weight = 0;
  // Most voxels of a lookup lie in one brick:
  int level = -1;                ///< The last was asked for at this level,
  glm::ivec3 place{0};           ///< here, in bricks of that level,
  int32_t node = -1;             ///< and is this one,
  int foundLevel = 0;            ///< which is at this level.
  BrickPtr brick;
};

BrickMap::BrickMap(const std::string& path, BrickCache& cache) : file_(path, kKind, kVersion), cache_(cache), id_(cache.addMap()) {
  ByteReader r(file_.header(), path);
  const auto channelCount = r.get<uint32_t>();
  for (uint32_t i = 0; i < channelCount; ++i) {
    std::string name = r.getString();
    channels_.push_back({std::move(name), r.get<int32_t>()});
    if (channels_.back().width < 1 || channels_.back().width > kMostWidth - width_)
      throw FileError(fmt::format("\"{}\": its channels are too many or damaged", path));
    width_ += channels_.back().width;
  }
  tree_.cube = r.get<BrickCube>();
  tree_.deepest = r.get<int32_t>();
  tree_.nodes = r.getVector<BrickNode>();
  madeFrom_ = r.get<MadeFrom>();
  if (!sound(tree_) || tree_.nodes.size() != file_.count()) throw FileError(fmt::format("\"{}\" is damaged: its octree does not add up", path));
}

Brick BrickMap::brick(int32_t node) const { return unpacked(file_.read(static_cast<uint32_t>(node)), width_, file_.path()); }

BrickPtr BrickMap::cached(int32_t node) const {
  return cache_.get(id_, static_cast<uint32_t>(node), [&] { return brick(node); });
}

bool BrickMap::lookup(const vec3& P, const vec3& N, float radius, float* out) const {
  std::fill_n(out, width_, 0.0f);
  if (tree_.nodes.empty() || !isFinite(P)) return false;
  Sum sum;
  sum.data = out;
  // The level whose voxels are as wide as the lookup volume, between two levels unless at either end.
  const float ideal = std::log2(tree_.cube.voxelSize(0) / std::max(2 * radius, 1e-30f));
  const float level = std::clamp(ideal, 0.0f, static_cast<float>(tree_.deepest));
  const int coarse = static_cast<int>(level);
  const float t = level - static_cast<float>(coarse);
  if (t < 1) addLevel(coarse, P, N, std::max(radius, 0.5f * tree_.cube.voxelSize(coarse)), 1 - t, sum);
  if (t > 0) addLevel(coarse + 1, P, N, std::max(radius, 0.5f * tree_.cube.voxelSize(coarse + 1)), t, sum);
  for (int l = coarse - 1; l >= 0 && !(sum.weight > 0); --l) addLevel(l, P, N, 0.5f * tree_.cube.voxelSize(l), 1, sum);
  if (!(sum.weight > 0)) return false;
  for (int k = 0; k < width_; ++k) out[k] /= sum.weight;
  return true;
}

void BrickMap::addLevel(int level, const vec3& P, const vec3& N, float halfWidth, float weight, Sum& sum) const {
  const float voxel = tree_.cube.voxelSize(level);
  const int end = kBrickWidth << level;
  const vec3 p = (P - tree_.cube.lo) / voxel;
  const float h = std::min(halfWidth / voxel, 1.0f);  // farther than two voxels only where the root is still too fine
  if (glm::any(glm::lessThan(p, vec3(-2.0f))) || glm::any(glm::greaterThan(p, vec3(static_cast<float>(end) + 2)))) return;
  const glm::ivec3 first = glm::clamp(glm::ivec3(glm::floor(p - h)), 0, end - 1);
  const glm::ivec3 last = glm::clamp(glm::ivec3(glm::floor(p + h)), 0, end - 1);
  std::array<float, kMostWidth> own;
  std::fill_n(own.begin(), width_, 0.0f);
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
  for (int k = 0; k < width_; ++k) sum.data[k] += weight / found * own[static_cast<size_t>(k)];
  sum.weight += weight;
}

/// The brick at this level, or the finest above it: what was left out there says the same.
void BrickMap::find(int level, const glm::ivec3& voxel, Sum& sum) const {
  const glm::ivec3 place = voxel >> 3;
  static_assert(kBrickWidth == 1 << 3);
  if (level == sum.level && place == sum.place) return;
  int32_t node = tree_.root();
  int at = 0;
  while (at < level) {
    const glm::ivec3 octant = (place >> (level - at - 1)) & 1;
    const int32_t child = tree_.nodes[static_cast<size_t>(node)].child[static_cast<size_t>(octant.x | octant.y << 1 | octant.z << 2)];
    if (child < 0) break;
    node = child, ++at;
  }
  if (node != sum.node) sum.brick = cached(node);
  sum.level = level, sum.place = place, sum.node = node, sum.foundLevel = at;
}

void BrickMap::addVoxel(int level, const glm::ivec3& voxel, const vec3& N, float weight, Sum& sum, int depth) const {
  find(level, voxel, sum);
  const Brick* b = sum.brick.get();
  const glm::ivec3 local = (voxel >> (level - sum.foundLevel)) & (kBrickWidth - 1);
  const auto v = static_cast<size_t>(voxelIndex(local.x, local.y, local.z));
  const size_t first = b->first[v], end = b->first[v + 1];
  const bool finer = sum.foundLevel == level && level < tree_.deepest && depth < 2 && N != vec3(0.0f);
  if (finer && std::any_of(b->layers.begin() + static_cast<std::ptrdiff_t>(first), b->layers.begin() + static_cast<std::ptrdiff_t>(end),
                           [](const BrickLayer& layer) { return layer.incoherent; })) {
    // Too many directions met here: finer voxels tell them apart (3.3). That covers every layer of the voxel.
    const float before = sum.weight;
    for (int k = 0; k < 8; ++k)
      addVoxel(level + 1, voxel * 2 + glm::ivec3(k & 1, k >> 1 & 1, k >> 2 & 1), N, weight / 8, sum, depth + 1);
    if (sum.weight > before) return;
    find(level, voxel, sum);
    b = sum.brick.get();
  }
  for (size_t l = first; l < end; ++l) {
    const vec3& n = b->layers[l].normal;
    if (N != vec3(0.0f) && n != vec3(0.0f) && dot(N, n) < kLayerCosine) continue;
    const float* data = b->data.data() + l * static_cast<size_t>(width_);
    for (int k = 0; k < width_; ++k) sum.data[k] += weight * data[k];
    sum.weight += weight;
  }
}

BuiltBricks writeBrickMap(const PointCloud& cloud, const BrickSettings& settings, const std::string& path, const MadeFrom& madeFrom) {
  if (cloud.width() > kMostWidth) throw FileError(fmt::format("\"{}\": more than {} floats a point", path, kMostWidth));
  ChunkWriter file(path, kKind, kVersion);
  BuiltBricks built = buildBricks(cloud, settings, [&](const Brick& brick) { file.add(packed(brick)); });
  ByteWriter header;
  header.put(static_cast<uint32_t>(cloud.channels.size()));
  for (const CloudChannel& c : cloud.channels) {
    header.put(c.name);
    header.put(static_cast<int32_t>(c.width));
  }
  header.put(built.tree.cube);
  header.put(static_cast<int32_t>(built.tree.deepest));
  header.put(built.tree.nodes);
  header.put(madeFrom);
  file.finish(header.bytes);
  return built;
}

}  // namespace tomales
