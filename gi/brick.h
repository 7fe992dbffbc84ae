// Noun: a brick, the tile of a brick map (irradiance-atlas 3.1): 8^3 voxels, of which few are filled. A voxel has a layer for
// every direction that its surfaces face, each with the mean of the data there. Over reyes/base alone.
// Threads: plain data.
#pragma once
#include <array>
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

constexpr int kBrickWidth = 8;  ///< Voxels along an edge.
constexpr int kBrickVoxels = kBrickWidth * kBrickWidth * kBrickWidth;

/// Normals farther apart than this do not share a layer, and do not answer each other's lookups.
constexpr float kLayerCosine = 0.70710678f;  ///< 45 degrees (irradiance-atlas 3.2, 3.3)

inline int voxelIndex(int x, int y, int z) { return (z * kBrickWidth + y) * kBrickWidth + x; }

struct BrickLayer {
  vec3 normal;              ///< Mean, unit; zero: volume data.
  bool incoherent = false;  ///< Normals of different layers had to be merged: finer bricks tell them apart.
};

struct Brick {
  std::array<uint16_t, kBrickVoxels + 1> first{};  ///< Voxel v has layers first[v] .. first[v + 1] - 1.
  std::vector<BrickLayer> layers;
  std::vector<float> data;  ///< As many floats a layer as the map has.

  size_t bytes() const {
    return sizeof(Brick) + layers.capacity() * sizeof(BrickLayer) + data.capacity() * sizeof(float);
  }
};

/// Octree node; its brick has the same number. Octant i has bit 0 in x, bit 1 in y, bit 2 in z.
struct BrickNode {
  std::array<int32_t, 8> child{-1, -1, -1, -1, -1, -1, -1, -1};  ///< -1: nothing there, or nothing finer to tell.
};

/// A cube, halved with every level.
struct BrickCube {
  vec3 lo{0.0f};
  float size = 1;
  float voxelSize(int level) const { return std::ldexp(size / kBrickWidth, -level); }
};

/// The octree of a brick map: children come before their parents, the root last.
struct BrickTree {
  BrickCube cube;
  std::vector<BrickNode> nodes;
  int deepest = 0;  ///< Level of the finest node; the root's is 0.
  int32_t root() const { return static_cast<int32_t>(nodes.size()) - 1; }
};

}  // namespace tomales
