// Noun: a brick, the tile of a brick map (irradiance-atlas 3.1): 8^3 voxels, of which few are filled. A voxel has a
// layer for every surface and direction that it faces, each with the mean of the data there. Over point clouds and
// reyes/base. Threads: plain data.
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
constexpr int kMostLevels = 24;  ///< Of a brick map: voxel coordinates stay exact in int.

/// Normals farther apart than this do not share a layer, and do not answer each other's lookups.
constexpr float kLayerCosine = 0.70710678f;  ///< 45 degrees (irradiance-atlas 3.2, 3.3)

/// Channels 0 .. width - 1: three, as most data have, without a loop.
template <class Work>
inline void forEachChannel(size_t width, const Work& work) {
  if (width == 3) return work(size_t{0}), work(size_t{1}), work(size_t{2});
  for (size_t k = 0; k < width; ++k) work(k);
}

inline int voxelIndex(int x, int y, int z) { return (z * kBrickWidth + y) * kBrickWidth + x; }

/// Which way the data of a layer face, in 32 bits.
struct BrickLayer {
  int8_t x = 0, y = 0,
         z = 0;  ///< Mean normal, in 127ths of its length: off by less than half a degree. Zero: volume data.
  uint8_t incoherent : 1 = 0;  ///< Different layers had to be merged: finer bricks tell them apart.
  uint8_t surface : 7 = 0;     ///< As PointCloud::surface(); 0: not known, or of several.

  BrickLayer() = default;
  BrickLayer(const vec3& unitNormal, bool isIncoherent, int of = 0)
      : x(part(unitNormal.x)),
        y(part(unitNormal.y)),
        z(part(unitNormal.z)),
        incoherent(isIncoherent),
        surface(static_cast<uint8_t>(of & kMostSurfaces)) {}
  vec3 normal() const { return normalizeOr(vec3(x, y, z), vec3(0.0f)); }
  /// N: of unit length; zero: asks for whatever is there. of: 0: likewise, of any surface.
  bool answers(const vec3& N, int of = 0) const {
    if (of != 0 && surface != 0 && of != surface) return false;
    const vec3 n(x, y, z);
    const float along = dot(N, n), length2 = dot(n, n);
    return (along > 0 && along * along >= kLayerCosine * kLayerCosine * length2) || length2 == 0 || N == vec3(0.0f);
  }

 private:
  /// As std::lround(), which is a call; in double, because floats would round t + 0.5.
  static int8_t part(float v) {
    const double t = 127 * v;
    return static_cast<int8_t>(t + std::copysign(0.5, t));
  }
};

/// Packed as it is in the file, because a cache holds as many bricks as they are small.
class Brick {
 public:
  /// While it is made: layers in the order of their voxels.
  struct Parts {
    std::vector<uint16_t> voxels;  ///< Of each layer.
    std::vector<BrickLayer> layers;
    std::vector<float> data;  ///< `width` floats a layer.
  };
  /// Data that may be off by `tolerance` are kept in 16 bits where that suffices.
  Brick(const Parts& parts, int width, float tolerance);
  /// Of bytes(); nothing if they make no brick of that width.
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
  /// sum[k] += weight * value k of the layer.
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
  /// Then the layers; the data, or for each channel the lowest and the step and then data in steps; and where the
  /// layers of each filled voxel begin, if some have several.
  struct Head {
    std::array<uint64_t, kBrickVoxels / 64> filled{};  ///< A bit a voxel.
    std::array<uint16_t, kBrickVoxels / 64> before{};  ///< Filled voxels of lower slabs.
    uint32_t layers = 0;
    uint8_t rounded = 0, several = 0;
    uint16_t voxels = 0;  ///< Filled.
  };
  static_assert(sizeof(Head) == 88);

  Brick(std::vector<std::byte> bytes, size_t width) : bytes_(std::move(bytes)), width_(width) {}
  /// std::popcount(), which is a call for processors that may lack the instruction.
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
  std::array<int32_t, 8> child{-1, -1, -1, -1, -1, -1, -1, -1};  ///< -1: nothing there, or nothing finer to tell.
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
  int deepest = 0;                            ///< Level of the finest node; the root's is 0.
  std::bitset<kMostSurfaces + 1> surfaces{};  ///< That the points told; 0: some told none.
  int32_t root() const { return static_cast<int32_t>(nodes.size()) - 1; }
};

}  // namespace tomales
