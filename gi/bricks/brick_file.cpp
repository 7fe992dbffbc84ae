#include "gi/brick_file.h"

#include <fmt/format.h>

namespace tomales {
namespace {

constexpr char kBrickKind[9] = "TMBRICKS";
constexpr uint32_t kBrickVersion = 4;

/// Tells whether the nodes are one tree, whose last node is the root, that has the number of levels that it says.
bool isTree(const BrickTree& tree) {
  std::vector<int> level(tree.nodes.size(), -1);
  int deepest = 0;
  if (!level.empty()) level.back() = 0;
  for (size_t i = tree.nodes.size(); i-- > 0;) {
    if (level[i] < 0) return false;
    deepest = std::max(deepest, level[i]);
    for (const int32_t c : tree.nodes[i].child) {
      if (c == -1) continue;
      if (c < 0 || static_cast<size_t>(c) >= i || level[static_cast<size_t>(c)] >= 0) return false;
      level[static_cast<size_t>(c)] = level[i] + 1;
    }
  }
  return deepest == tree.deepest;
}

bool sound(const BrickTree& tree) {
  return isTree(tree) && isFinite(tree.cube.lo) && tree.cube.size > 0 && std::isfinite(tree.cube.size) &&
         tree.deepest >= 0 && tree.deepest < kMostLevels;
}

}  // namespace

template <class A>
void fields(A& a, BrickCube& x) {
  auto& [lo, size] = x;
  each(a, lo, size);
}

template <class A>
void fields(A& a, BrickNode& x) {
  auto& [child] = x;
  field(a, child);
}

BrickFile::BrickFile(const std::string& path) : file_(path, kBrickKind, kBrickVersion) {
  const Bytes header = file_.takeHeader();
  Unpacker r{header};
  channels_ = getChannels(r, path);
  width_ = widthOf(channels_);
  std::vector<uint8_t> surfaces;
  each(r, tree_.cube, tree_.deepest, tree_.nodes, surfaces, madeFrom_);
  throwIfDamaged(r, path);
  for (const uint8_t surface : surfaces) tree_.surfaces.set(surface & BrickLayer::kSurfaceMask);
  if (!sound(tree_) || tree_.nodes.size() != file_.count())
    throw DamageError(path, fmt::format("\"{}\" is damaged: its octree does not add up", path));
}

Brick BrickFile::brick(int32_t node) const {
  std::optional<Brick> brick = Brick::of(file_.read(static_cast<uint32_t>(node)), width_);
  if (!brick) throw DamageError(path(), fmt::format("\"{}\" is damaged: a brick does not add up", path()));
  return std::move(*brick);
}

BrickFileWriter::BrickFileWriter(const std::string& path) : file_(path, kBrickKind, kBrickVersion) {}

void BrickFileWriter::add(const Brick& brick) { file_.add(brick.bytes()); }

void BrickFileWriter::finish(const std::vector<CloudChannel>& channels, const BrickTree& tree,
                             const MadeFrom& madeFrom) {
  Packer header;
  putChannels(header, channels);
  std::vector<uint8_t> surfaces;
  for (size_t i = 0; i < tree.surfaces.size(); ++i)
    if (tree.surfaces[i]) surfaces.push_back(static_cast<uint8_t>(i));
  header.put(tree.cube, tree.deepest, tree.nodes, surfaces, madeFrom);
  file_.finish(header.bytes);
}

PointCloud voxelsOf(const BrickFile& file, int level) {
  const BrickTree& tree = file.tree();
  PointCloud out;
  out.channels = file.channels();
  std::vector<float> values(static_cast<size_t>(file.width()));
  struct Place {
    int32_t node;
    int level;
    vec3 lo;
  };
  std::vector<Place> todo;
  if (tree.root() >= 0) todo.push_back({tree.root(), 0, tree.cube.lo});
  while (!todo.empty()) {
    const Place p = todo.back();
    todo.pop_back();
    const BrickNode& node = tree.nodes[static_cast<size_t>(p.node)];
    const bool deeper = level < 0 || p.level < level;
    const float half = std::ldexp(tree.cube.size, -p.level - 1), voxel = tree.cube.voxelSize(p.level);
    for (int octant = 0; octant < 8; ++octant)
      if (const int32_t child = node.child[static_cast<size_t>(octant)]; deeper && child >= 0)
        todo.push_back({child, p.level + 1, p.lo + half * vec3(octantOffset(octant))});
    const Brick brick = file.brick(p.node);
    for (int v = 0; v < kBrickVoxels; ++v) {
      const int x = v % kBrickWidth, y = v / kBrickWidth % kBrickWidth, z = v / (kBrickWidth * kBrickWidth);
      const auto octant =
          static_cast<size_t>((x >= kBrickWidth / 2) | (y >= kBrickWidth / 2) << 1 | (z >= kBrickWidth / 2) << 2);
      if (deeper && node.child[octant] >= 0) continue;
      const Brick::Range layers = brick.layersOf(v);
      for (size_t l = layers.first; l < layers.end; ++l) {
        std::fill(values.begin(), values.end(), 0.0f);
        brick.add(l, 1, values.data());
        out.add(p.lo + voxel * (vec3(x, y, z) + 0.5f), brick.layer(l).normal(), 0.5f * std::sqrt(3.0f) * voxel,
                values.data());
      }
    }
  }
  return out;
}

}  // namespace tomales
