#include "gi/brick_accumulate.h"

#include <utility>

namespace tomales {
namespace {

/// Six sides of a box and a few between: more directions than that in one voxel are foliage or noise.
constexpr int kMostLayers = 12;
/// From so many on, surfaces that face alike share one: coarse voxels meet many, and are not asked what finer ones know.
constexpr int kSharedFrom = 6;

}  // namespace

void BrickAccumulator::clear() {
  head_.fill(-1);
  layers_.clear(), data_.clear();
}

int32_t BrickAccumulator::findLayer(int voxel, const LayerSum& like, bool& merged) const {
  const vec3& normal = like.normal;
  const bool oriented = normal != vec3(0.0f);
  const float length2 = dot(normal, normal);
  if (const int32_t only = head_[static_cast<size_t>(voxel)]; oriented && only >= 0 && layers_[static_cast<size_t>(only)].next < 0) {
    const auto& [mean, weight, next, incoherent, surface] = layers_[static_cast<size_t>(only)];  // nearly always so, and needs no root
    const float along = surface == like.surface ? dot(mean, normal) : 0.0f;
    // Squares of tiny weights underflow; then the roots below decide.
    if (along > 1e-15f && along * along >= kLayerCosine * kLayerCosine * dot(mean, mean) * length2) return only;
  }
  const float length = glm::length(normal);
  int32_t own = -1, any = -1;
  float ownCosine = -2, anyCosine = -2;
  int count = 0;
  for (int32_t l = head_[static_cast<size_t>(voxel)]; l >= 0; l = layers_[static_cast<size_t>(l)].next, ++count) {
    const auto& [mean, weight, next, incoherent, surface] = layers_[static_cast<size_t>(l)];
    float cosine = -1;
    if (oriented && mean != vec3(0.0f))
      cosine = dot(mean, normal) / (glm::length(mean) * length);
    else if (!oriented && mean == vec3(0.0f))
      cosine = 1;
    if (cosine > anyCosine) any = l, anyCosine = cosine;
    if (cosine > ownCosine && surface == like.surface) own = l, ownCosine = cosine;
  }
  if (ownCosine >= kLayerCosine) return own;
  const bool alike = anyCosine >= kLayerCosine;
  if (count < (alike ? kSharedFrom : kMostLayers)) return -1;
  merged = !alike;
  return any;
}

int32_t BrickAccumulator::add(int voxel, const LayerSum& sum, const float* data, float share) {
  bool merged = false;
  int32_t l = findLayer(voxel, sum, merged);
  if (l < 0) {
    l = static_cast<int32_t>(layers_.size());
    layers_.push_back(sum);
    layers_.back().next = std::exchange(head_[static_cast<size_t>(voxel)], l);
    for (int k = 0; k < width_; ++k) data_.push_back(share * data[k]);
    return l;
  }
  LayerSum& layer = layers_[static_cast<size_t>(l)];
  layer.normal += sum.normal;
  layer.weight += sum.weight;
  layer.incoherent |= merged | sum.incoherent;
  if (layer.surface != sum.surface) layer.surface = 0;
  float* to = data_.data() + l * width_;
  for (int k = 0; k < width_; ++k) to[k] += share * data[k];
  return l;
}

float BrickAccumulator::addChild(const BrickAccumulator& child, int octant) {
  constexpr int half = kBrickWidth / 2;
  const auto width = static_cast<size_t>(width_);
  const size_t firstNew = layers_.size();  // the octants of a brick share no voxel, so all that is added to is new
  least_.clear(), most_.clear();
  float spread = 0;
  for (int v = 0; v < kBrickVoxels; ++v) {
    if (child.head_[static_cast<size_t>(v)] < 0) continue;
    const int x = v % kBrickWidth, y = v / kBrickWidth % kBrickWidth, z = v / (kBrickWidth * kBrickWidth);
    const int to = voxelIndex((octant & 1 ? half : 0) + x / 2, (octant & 2 ? half : 0) + y / 2, (octant & 4 ? half : 0) + z / 2);
    for (int32_t l = child.head_[static_cast<size_t>(v)]; l >= 0; l = child.layers_[static_cast<size_t>(l)].next) {
      const LayerSum& sum = child.layers_[static_cast<size_t>(l)];
      const float* data = child.data_.data() + static_cast<size_t>(l) * width;
      const auto into = static_cast<size_t>(add(to, sum, data, 1)) - firstNew;
      if (layers_[into + firstNew].incoherent) spread = kInfinity;
      if (least_.size() < (into + 1) * width) least_.resize((into + 1) * width, kInfinity), most_.resize((into + 1) * width, -kInfinity);
      for (size_t k = 0; k < width; ++k) {
        const float mean = data[k] / sum.weight;
        float &lo = least_[into * width + k], &hi = most_[into * width + k];
        lo = std::min(lo, mean), hi = std::max(hi, mean);
        spread = std::max(spread, hi - lo);
      }
    }
  }
  return spread;
}

Brick BrickAccumulator::finish(float tolerance) const {
  Brick::Parts parts;
  parts.voxels.reserve(layers_.size()), parts.layers.reserve(layers_.size()), parts.data.reserve(data_.size());
  for (size_t v = 0; v < kBrickVoxels; ++v)
    for (int32_t l = head_[v]; l >= 0; l = layers_[static_cast<size_t>(l)].next) {
      const LayerSum& sum = layers_[static_cast<size_t>(l)];
      parts.voxels.push_back(static_cast<uint16_t>(v));
      parts.layers.emplace_back(normalizeOr(sum.normal, vec3(0.0f)), sum.incoherent, sum.surface);
      for (int k = 0; k < width_; ++k) parts.data.push_back(data_[static_cast<size_t>(l * width_ + k)] / sum.weight);
    }
  return {parts, width_, tolerance};
}

}  // namespace tomales
