// Noun: a brick, the tile of a brick map (Christensen and Batali 2004, section 3.1): 8^3 voxels, few of which are
// filled. A voxel has a layer for every surface and direction in it, each with the mean of the data there. It needs
// point clouds and reyes/base alone. Threads: plain data.
#pragma once
#include <array>
#include <bit>
#include <bitset>
#include <optional>
#include <span>
#include <vector>

#include "gi/point_cloud.h"
#include "reyes/base/math.h"

namespace tomales {

constexpr int kBrickWidth = 8;  ///< Voxels along an edge.
constexpr int kBrickVoxels = kBrickWidth * kBrickWidth * kBrickWidth;
/// Voxel coordinates of a map with this many levels, and those next to them, are exact in float.
constexpr int kMostLevels = 22;

/// Normals farther apart than this do not share a layer, and do not answer each other's lookups.
constexpr float kLayerCosine = kCosine45;  ///< 45 degrees (Christensen and Batali 2004, sections 3.2 and 3.3)

/// Calls work for channels 0 .. width - 1. Three channels, as most data have, need no loop.
template <class Work>
inline void forEachChannel(size_t width, const Work& work) {
  if (width == 3) return work(size_t{0}), work(size_t{1}), work(size_t{2});
  for (size_t k = 0; k < width; ++k) work(k);
}

/// Returns where an octant of a cube begins, in halves of its edge.
inline glm::ivec3 octantOffset(int octant) { return {octant & 1, octant >> 1 & 1, octant >> 2 & 1}; }

inline int voxelIndex(int x, int y, int z) { return (z * kBrickWidth + y) * kBrickWidth + x; }

/// The direction and the surface of a layer's data, in 32 bits.
struct BrickLayer {
  /// The mean normal in 127ths of its length, off by less than half a degree. Zero for volume data.
  int8_t x = 0, y = 0, z = 0;
  uint8_t incoherent : 1 = 0;  ///< Layers that face apart had to be merged: finer bricks tell them apart.
  uint8_t surface : 7 = 0;     ///< PointCloud::surface() of the data; 0: not known, or several.
  /// The mask of the bits of `surface`, the largest number of which is kAcrossWalls.
  static constexpr int kSurfaceMask = kAcrossWalls;

  BrickLayer() = default;
  BrickLayer(const vec3& unitNormal, bool isIncoherent, int of = 0)
      : x(part(unitNormal.x)),
        y(part(unitNormal.y)),
        z(part(unitNormal.z)),
        incoherent(isIncoherent),
        surface(static_cast<uint8_t>(of & kSurfaceMask)) {}
  vec3 normal() const { return normalizeOr(vec3(x, y, z), vec3(0.0f)); }
  /// Tells whether the layer matches a lookup. N: unit; zero matches any direction. of: a surface; 0 matches any.
  bool answers(const vec3& N, int of = 0) const { return (of == 0 || surface == 0 || of == surface) && faces(N); }
  bool faces(const vec3& N) const {
    const vec3 n(x, y, z);
    const float along = dot(N, n), length2 = dot(n, n);
    return (along > 0 && along * along >= kLayerCosine * kLayerCosine * length2) || length2 == 0 || N == vec3(0.0f);
  }

 private:
  /// Does the same as std::lround(), without a call. It is in double, because floats would round t + 0.5.
  static int8_t part(float v) {
    const double t = 127 * v;
    return static_cast<int8_t>(t + std::copysign(0.5, t));
  }
};

/// A brick, packed as it is in the file, so that a cache holds as many as possible.
class Brick {
 public:
  /// The parts that a brick is made from, with layers in the order of their voxels.
  struct Parts {
    std::vector<uint16_t> voxels;  ///< Voxel of each layer.
    std::vector<BrickLayer> layers;
    std::vector<float> data;  ///< `width` floats for each layer.
  };
  /// Rounds data to 16 bits where that is within `tolerance`.
  Brick(const Parts& parts, int width, float tolerance);
  /// Makes a brick from bytes(); empty if they are no brick of that width.
  static std::optional<Brick> of(std::vector<std::byte> bytes, int width);

  bool fills(int voxel) const { return head().filled[static_cast<size_t>(voxel) / 64] >> voxel % 64 & 1; }
  /// Layers [first, end) of a voxel.
  struct Range {
    size_t first, end;
  };
  Range layersOf(int voxel) const {
    const Head& h = head();
    const auto slab = static_cast<size_t>(voxel) / 64;
    const uint64_t bit = uint64_t{1} << voxel % 64;
    if (!(h.filled[slab] & bit)) return {0, 0};
    const size_t rank = h.before[slab] + countOnes(h.filled[slab] & (bit - 1));
    if (!h.several) return {rank, rank + 1};
    const auto* first = at<uint16_t>(firstAt());
    return {first[rank], first[rank + 1]};
  }
  const BrickLayer& layer(size_t i) const { return at<BrickLayer>(sizeof(Head))[i]; }
  /// Adds weight * value k of the layer to sum[k].
  void add(size_t layer, float weight, float* sum) const {
    if (head().rounded) {
      const auto* low = at<float>(dataAt());
      const float* const step = low + width_;
      const auto* q = reinterpret_cast<const uint16_t*>(step + width_) + layer * width_;
      forEachChannel(width_, [&](size_t k) { sum[k] += weight * (low[k] + step[k] * static_cast<float>(q[k])); });
      return;
    }
    const auto* data = at<float>(dataAt()) + layer * width_;
    forEachChannel(width_, [&](size_t k) { sum[k] += weight * data[k]; });
  }

  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  /// Start of the bytes. The layers follow, then the data, or for each channel its lowest value and its step and then
  /// the data in steps; and if some voxels have several layers, the first layer of each filled voxel.
  struct Head {
    std::array<uint64_t, kBrickVoxels / 64> filled{};  ///< One bit for each voxel.
    std::array<uint16_t, kBrickVoxels / 64> before{};  ///< Number of filled voxels in lower slabs.
    uint32_t layers = 0;
    uint8_t rounded = 0, several = 0;
    uint16_t voxels = 0;  ///< Number of filled voxels.
  };
  static_assert(sizeof(Head) == 88);

  Brick(std::vector<std::byte> bytes, size_t width) : bytes_(std::move(bytes)), width_(width) {}
  /// Does the same as std::popcount(), without a call on processors that may lack the instruction.
  static size_t countOnes(uint64_t bits) {
    bits -= bits >> 1 & 0x5555555555555555u;
    bits = (bits & 0x3333333333333333u) + (bits >> 2 & 0x3333333333333333u);
    return ((bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fu) * 0x0101010101010101u >> 56;
  }
  template <class T>
  const T* at(size_t offset) const {
    return reinterpret_cast<const T*>(bytes_.data() + offset);
  }
  const Head& head() const { return *at<Head>(0); }
  size_t dataAt() const { return sizeof(Head) + head().layers * sizeof(BrickLayer); }
  size_t firstAt() const {
    const size_t values = head().layers * width_;
    return dataAt() +
           (head().rounded ? 2 * width_ * sizeof(float) + values * sizeof(uint16_t) : values * sizeof(float));
  }
  size_t wholeSize() const { return firstAt() + (head().several ? (head().voxels + size_t{1}) * sizeof(uint16_t) : 0); }

  std::vector<std::byte> bytes_;
  size_t width_;
};

/// Octree node; its brick has the same number. Octant i has bit 0 in x, bit 1 in y, bit 2 in z.
struct BrickNode {
  std::array<int32_t, 8> child{-1, -1, -1, -1, -1, -1, -1, -1};  ///< -1: there is nothing, or nothing finer.
};

/// A cube, halved with every level.
struct BrickCube {
  vec3 lo{0.0f};
  float size = 1;
  float voxelSize(int level) const { return size / static_cast<float>(kBrickWidth << level); }
};

/// The octree of a brick map: children come before their parents, the root last.
struct BrickTree {
  BrickCube cube;
  std::vector<BrickNode> nodes;
  int deepest = 0;                                       ///< Level of the finest node; the root's is 0.
  std::bitset<BrickLayer::kSurfaceMask + 1> surfaces{};  ///< The surfaces that the points name; bit 0: some name none.
  int32_t root() const { return static_cast<int32_t>(nodes.size()) - 1; }
};

}  // namespace tomales
