#include "gi/bricks/accumulate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tomales {
namespace {

/// Room for the six sides of a box and a few directions between. More layers than that in one voxel are foliage or
/// noise.
constexpr int kMostLayers = 12;
/// In a voxel of this many layers, surfaces that face alike share one. Coarse voxels meet many surfaces, and finer
/// voxels keep them apart.
constexpr int kSharedFrom = 6;
/// Bricks hold no larger values than this, so that differences of two values do not overflow.
constexpr float kLargestMean = std::numeric_limits<float>::max() / 4;

/// Sums of enormous light overflow, and files with numbers that are not finite count as damaged.
float heldMean(float mean) { return std::isnan(mean) ? mean : std::clamp(mean, -kLargestMean, kLargestMean); }

}  // namespace

void BrickAccumulator::clear() {
  head_.fill(-1);
  layers_.clear();
}

int32_t BrickAccumulator::findLayer(int voxel, const vec3& normal, uint8_t surface, bool& merged) const {
  // Nearly always one layer or none passes this test, which needs no root.
  const float length2 = dot(normal, normal);
  int32_t within = -1;
  int count = 0;
  bool doubtful = length2 == 0;
  for (int32_t l = head_[static_cast<size_t>(voxel)]; l >= 0; l = layers_[static_cast<size_t>(l)].next, ++count) {
    const LayerSum& layer = layers_[static_cast<size_t>(l)];
    const float along = dot(layer.normal, normal);
    // This is continues() without early exit: the branches would be random, and mispredicted.
    const bool candidate = static_cast<bool>((layer.surface == surface) & (along > 0));
    const bool near = static_cast<bool>(
        candidate & (along * along >= kLayerCosine * kLayerCosine * dot(layer.normal, layer.normal) * length2));
    doubtful |= (candidate & (along < kTinyProduct)) | (near & (within >= 0));
    within = near ? l : within;
  }
  return doubtful || (within < 0 && count >= kSharedFrom) ? findNearest(voxel, normal, surface, merged) : within;
}

int32_t BrickAccumulator::findNearest(int voxel, const vec3& normal, uint8_t surface, bool& merged) const {
  const bool oriented = normal != vec3(0.0f);
  const float length = glm::length(normal);
  int32_t own = -1, any = -1;
  float ownCosine = -2, anyCosine = -2;
  int count = 0;
  for (int32_t l = head_[static_cast<size_t>(voxel)]; l >= 0; l = layers_[static_cast<size_t>(l)].next, ++count) {
    const LayerSum& layer = layers_[static_cast<size_t>(l)];
    const vec3& mean = layer.normal;
    float cosine = -1;
    if (oriented && mean != vec3(0.0f))
      cosine = dot(mean, normal) / (glm::length(mean) * length);
    else if (!oriented && mean == vec3(0.0f))
      cosine = 1;
    if (cosine > anyCosine) {
      any = l;
      anyCosine = cosine;
    }
    if (cosine > ownCosine && layer.surface == surface) {
      own = l;
      ownCosine = cosine;
    }
  }
  if (ownCosine >= kLayerCosine) return own;
  const bool alike = anyCosine >= kLayerCosine;
  if (count < (alike ? kSharedFrom : kMostLayers)) return -1;
  merged = !alike;
  return any;
}

int32_t BrickAccumulator::addToOneOfMany(int voxel, const vec3& normal, float weight, uint8_t surface,
                                         const float* data, float share) {
  bool merged = false;
  int32_t l = findLayer(voxel, normal, surface, merged);
  if (l < 0) {
    l = static_cast<int32_t>(layers_.size());
    layers_.push_back({normal, weight, std::exchange(head_[static_cast<size_t>(voxel)], l), false, surface});
    if (data_.size() < layers_.size() * width_) data_.resize(2 * layers_.size() * width_);
    float* to = data_.data() + static_cast<size_t>(l) * width_;
    forEachChannel(width_, [&](size_t k) { to[k] = share * data[k]; });
    return l;
  }
  addTo(l, normal, weight, data, share);
  LayerSum& layer = layers_[static_cast<size_t>(l)];
  layer.incoherent |= merged;
  if (layer.surface != surface) layer.surface = 0;
  return l;
}

float BrickAccumulator::addChild(const BrickAccumulator& child, int octant) {
  constexpr int half = kBrickWidth / 2;
  const size_t firstNew = layers_.size();  // the octants of a brick share no voxel, so all layers that get data are new
  least_.clear();
  most_.clear();
  float spread = 0;
  const glm::ivec3 first = half * octantOffset(octant);
  for (int v = 0; v < kBrickVoxels; ++v) {
    if (child.head_[static_cast<size_t>(v)] < 0) continue;
    const int x = v % kBrickWidth, y = v / kBrickWidth % kBrickWidth, z = v / (kBrickWidth * kBrickWidth);
    const int to = voxelIndex(first.x + x / 2, first.y + y / 2, first.z + z / 2);
    for (int32_t l = child.head_[static_cast<size_t>(v)]; l >= 0; l = child.layers_[static_cast<size_t>(l)].next) {
      const LayerSum& sum = child.layers_[static_cast<size_t>(l)];
      const float* data = child.data_.data() + static_cast<size_t>(l) * width_;
      const auto layer = static_cast<size_t>(add(to, sum.normal, sum.weight, sum.surface, data, 1)),
                 into = layer - firstNew;
      layers_[layer].incoherent |= sum.incoherent;
      if (layers_[layer].incoherent) spread = kInfinity;
      if (least_.size() < (into + 1) * width_) {
        least_.resize((into + 1) * width_, kInfinity);
        most_.resize((into + 1) * width_, -kInfinity);
      }
      forEachChannel(width_, [&](size_t k) {
        const float mean = data[k] / sum.weight;
        float &lo = least_[into * width_ + k], &hi = most_[into * width_ + k];
        lo = std::min(lo, mean);
        hi = std::max(hi, mean);
        spread = std::max(spread, hi - lo);
      });
    }
  }
  return spread;
}

Brick BrickAccumulator::finish(float tolerance) const {
  Brick::Parts parts;
  parts.voxels.resize(layers_.size());
  parts.layers.resize(layers_.size());
  parts.data.resize(layers_.size() * width_);
  size_t i = 0;
  for (size_t v = 0; v < kBrickVoxels; ++v)
    for (int32_t l = head_[v]; l >= 0; l = layers_[static_cast<size_t>(l)].next) {
      const LayerSum& sum = layers_[static_cast<size_t>(l)];
      parts.voxels[i] = static_cast<uint16_t>(v);
      parts.layers[i] = {normalizeOr(sum.normal, vec3(0.0f)), sum.incoherent, sum.surface};
      const float* from = data_.data() + static_cast<size_t>(l) * width_;
      float* to = parts.data.data() + i * width_;
      forEachChannel(width_, [&](size_t k) { to[k] = heldMean(from[k] / sum.weight); });
      ++i;
    }
  return {parts, static_cast<int>(width_), tolerance};
}

}  // namespace tomales
