// A brick while data are added: sums and weights, not yet means. Private to gi.
#pragma once
#include "gi/brick.h"

namespace tomales {

/// What one layer of a voxel has been given so far. Half a line of the processor's cache.
struct alignas(32) LayerSum {
  vec3 normal{0.0f};  ///< Sum of weight * normal.
  float weight = 0;
  int32_t next = -1;  ///< Another layer of the same voxel.
  bool incoherent = false;
  uint8_t surface = 0;
};

class BrickAccumulator {
 public:
  explicit BrickAccumulator(size_t width) : width_(width) { clear(); }
  void clear();

  /// Adds to the layer of the voxel that faces as `normal`, of any length, does and is of the same surface,
  /// or to a new one. Of `data`, `share` times is added: the weight, if they are not sums already. Returns
  /// the layer.
  int32_t add(int voxel, const vec3& normal, float weight, uint8_t surface, const float* data, float share) {
    const int32_t l = head_[static_cast<size_t>(voxel)];
    if (l < 0 || layers_[static_cast<size_t>(l)].next >= 0 ||
        !continues(layers_[static_cast<size_t>(l)], normal, surface))
      return addToOneOfMany(voxel, normal, weight, surface, data, share);
    addTo(l, normal, weight, data, share);  // nearly always
    return l;
  }

  /// Box-filters `child` into octant `octant`. Returns the largest spread of the child's means over any of its
  /// groups of 2x2x2 voxels, layer by layer; infinite where layers had to be merged that face apart.
  float addChild(const BrickAccumulator& child, int octant);

  /// The means; `tolerance`: by which they may be off.
  Brick finish(float tolerance) const;

 private:
  static constexpr float kTinyProduct = 1e-15f;  ///< Its square is no float any more, or nearly none.

  /// Same surface, and less than 45 degrees between normals of any length: squares tell without a root. Those
  /// of tiny weights underflow: false.
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
  /// merged: there is no room for another, and the one that is found faces elsewhere.
  int32_t findLayer(int voxel, const vec3& normal, uint8_t surface, bool& merged) const;
  int32_t findNearest(int voxel, const vec3& normal, uint8_t surface, bool& merged) const;

  size_t width_;
  std::array<int32_t, kBrickVoxels> head_;
  std::vector<LayerSum> layers_;
  std::vector<float> data_;          ///< Of the layers, and room for more.
  std::vector<float> least_, most_;  ///< Means of the layers that addChild() has added to.
};

}  // namespace tomales
