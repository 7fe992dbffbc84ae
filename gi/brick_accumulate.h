// A brick while data are added: sums and weights, not yet means. Private to gi.
#pragma once
#include "gi/brick.h"

namespace tomales {

/// What one layer of a voxel has been given so far.
struct LayerSum {
  vec3 normal{0.0f};  ///< Sum of weight * normal.
  float weight = 0;
  int32_t next = -1;  ///< Another layer of the same voxel.
  bool incoherent = false;
  uint8_t surface = 0;
};

class BrickAccumulator {
 public:
  explicit BrickAccumulator(int width) : width_(width) { clear(); }
  void clear();

  /// Adds to the layer of the voxel that faces as `sum` does and is of the same surface, or to a new one. Of `data`, `share` times is added: the weight, if they are
  /// not sums already. Returns the layer.
  int32_t add(int voxel, const LayerSum& sum, const float* data, float share);

  /// Box-filters `child` into octant `octant`. Returns the largest spread of the child's means over any of its
  /// groups of 2x2x2 voxels, layer by layer; infinite where layers had to be merged that face apart.
  float addChild(const BrickAccumulator& child, int octant);

  /// The means; `tolerance`: by which they may be off.
  Brick finish(float tolerance) const;

 private:
  /// merged: there is no room for another, and the one that is found faces elsewhere.
  int32_t findLayer(int voxel, const LayerSum& like, bool& merged) const;

  int width_;
  std::array<int32_t, kBrickVoxels> head_;
  std::vector<LayerSum> layers_;
  std::vector<float> data_;
  std::vector<float> least_, most_;  ///< Means of the layers that addChild() has added to.
};

}  // namespace tomales
