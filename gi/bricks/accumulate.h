// Private to gi: a brick while data are added to it. It holds sums and weights, not yet means.
#pragma once
#include "gi/bricks/brick.h"

namespace tomales {

/// The sums of one layer of a voxel. Its size is half a cache line.
struct alignas(32) LayerSum {
  vec3 normal{0.0f};  ///< Sum of weight * normal.
  float weight = 0;
  int32_t next = -1;  ///< Index of another layer of the same voxel.
  bool incoherent = false;
  uint8_t surface = 0;
};

class BrickAccumulator {
 public:
  explicit BrickAccumulator(size_t width) : width_(width) { clear(); }
  void clear();

  /// Adds to the voxel's layer of the same surface whose normal is close to `normal` (of any length), or to a new
  /// layer. `share` is the factor on `data`: the weight, or 1 if they are sums already. Returns the layer.
  int32_t add(int voxel, const vec3& normal, float weight, uint8_t surface, const float* data, float share) {
    const int32_t l = head_[static_cast<size_t>(voxel)];
    if (l < 0 || layers_[static_cast<size_t>(l)].next >= 0 ||
        !continues(layers_[static_cast<size_t>(l)], normal, surface))
      return addToOneOfMany(voxel, normal, weight, surface, data, share);
    addTo(l, normal, weight, data, share);  // nearly every point goes this way
    return l;
  }

  /// Box-filters `child` into octant `octant`. Returns the largest spread of the child's means over any of its
  /// groups of 2x2x2 voxels, layer by layer; infinite where layers had to be merged that face apart.
  float addChild(const BrickAccumulator& child, int octant);

  /// Returns a brick of the means, which may be rounded by `tolerance`.
  Brick finish(float tolerance) const;

 private:
  static constexpr float kTinyProduct = 1e-15f;  ///< The square of a smaller product underflows.

  /// Tells whether the surface is the same, and the angle between the normals (of any length) less than 45 degrees. It
  /// compares squares, without a root. Normals of tiny weights underflow: false.
  static bool continues(const LayerSum& layer, const vec3& normal, uint8_t surface) {
    const float along = dot(layer.normal, normal);
    return layer.surface == surface && along > kTinyProduct &&
           along * along >= kLayerCosine * kLayerCosine * dot(layer.normal, layer.normal) * dot(normal, normal);
  }
  void addTo(int32_t l, const vec3& normal, float weight, const float* data, float share) {
    LayerSum& layer = layers_[static_cast<size_t>(l)];
    layer.normal += normal;
    layer.weight += weight;
    float* to = data_.data() + static_cast<size_t>(l) * width_;
    forEachChannel(width_, [&](size_t k) { to[k] += share * data[k]; });
  }
  int32_t addToOneOfMany(int voxel, const vec3& normal, float weight, uint8_t surface, const float* data, float share);
  /// merged: there is no room for another layer, and the returned one faces elsewhere.
  int32_t findLayer(int voxel, const vec3& normal, uint8_t surface, bool& merged) const;
  int32_t findNearest(int voxel, const vec3& normal, uint8_t surface, bool& merged) const;

  size_t width_;
  std::array<int32_t, kBrickVoxels> head_;
  std::vector<LayerSum> layers_;
  std::vector<float> data_;          ///< Data of the layers, with room for more.
  std::vector<float> least_, most_;  ///< Extremes of the means of the layers that addChild() has added to.
};

}  // namespace tomales
