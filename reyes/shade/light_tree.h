// Noun: a binary tree over many lamps, each with a place and a power. For a point, a few lamps are drawn that stand for
// all. A cut through the tree (Walter et al. 2005, "Lightcuts") divides the lamps into clusters. From each cluster one
// lamp is drawn by its importance (Estevez and Kulla 2018). Its light is divided by its probability, so that the mean
// is right whatever the importance is. The importance knows no shadows, and only the normal of the surface. A cluster
// is divided if it may be bright, so clusters are chosen by the light that they give at best. Parts of a cluster are
// drawn by their expected light, from the mean and the variance of their lamps' places. Space: current. Threads: const
// members may be called concurrently.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

/// `power` is E/pi at a distance of 1 in front of the lamp. It is positive.
struct TreeLight {
  Bound3 bound;
  float power;
};

/// A point to be lit; N is 0 if light counts from all around. Only the first `lights` lamps of the tree shine there, so
/// that lists of lamps with a common beginning share a tree.
struct LightReceiver {
  vec3 P, N;
  uint32_t lights = ~0U;
};

/// Several lamps of which one is drawn, or one lamp with several samples.
struct LightCluster {
  uint32_t node;
  int samples;
};

/// A lamp that has been drawn from a cluster, and the probability of that.
struct DrawnLight {
  uint32_t light;
  float probability;
};

class LightTree {
 public:
  explicit LightTree(std::vector<TreeLight> lights);

  /// Divides the lamps into clusters. Together these have at most `most` samples, and a cluster of one lamp has at most
  /// `perLight`. Dividing ends earlier if no sample stands for more than kClusterShare of the expected light. `out` is
  /// overwritten. It is empty if no lamp shines there.
  void cut(const LightReceiver& at, int most, int perLight, std::vector<LightCluster>& out) const;
  /// Draws a lamp of each cluster by a number in [0, 1). Draws of many clusters in one call overlap in the processor.
  void draw(const LightReceiver& at, std::span<const LightCluster> clusters, std::span<const float> xi,
            std::span<DrawnLight> out) const;
  /// Returns the expected number of samples that a cut gives to a lamp.
  float expected(const LightReceiver& at, std::span<const LightCluster> cut, uint32_t light) const;
  /// Adds the lamps whose bounds a ray from P along the unit direction meets, in the order of the tree.
  void meet(const vec3& P, const vec3& direction, std::vector<uint32_t>& lights) const;

  /// A sample that stands for no more than this share of a point's light shows as no noise, so that finer clusters
  /// would only cost samples.
  static constexpr float kClusterShare = 0.005f;

 private:
  struct Node {
    vec3 center;
    float radius;    ///< Radius of the sphere around its bound.
    float power;     ///< Power of its lamps together.
    uint32_t right;  ///< The second child; the first one follows its parent. A leaf's is 0.
    uint32_t end;    ///< The index after the last node below it.
    uint32_t below;  ///< The lamp of a leaf; of another node, its index in parts_.
    uint32_t first;  ///< The least index of its lamps.
  };
  static constexpr int kParts = 4;
  /// Data for drawing about the nodes two levels below a node (one level if that is a leaf): the places of their lamps,
  /// weighted by power. They are adjacent, so that one instruction computes with all of them.
  struct alignas(64) Parts {
    std::array<std::array<float, kParts>, 3> mean{}, variance{};
    std::array<float, kParts> power{};  ///< 0 after the last part.
    std::array<uint32_t, kParts> node{};
  };
  uint32_t build(std::span<uint32_t> order);
  void fillParts();
  /// Returns the light of the lamps below a node, from its centre and with the best cosine of its sphere.
  float atBest(const LightReceiver& at, const Node& node) const;
  /// Returns the expected light of each part, up to a common factor. At least one is positive.
  static std::array<float, kParts> importance(const LightReceiver& at, const Parts& parts);
  /// Returns the importance() of a node's parts, and 0 for parts without lamps that shine there.
  std::array<float, kParts> importanceBelow(const LightReceiver& at, const Node& node) const;

  std::vector<TreeLight> lights_;
  std::vector<Node> nodes_;
  std::vector<Parts> parts_;      ///< For all nodes but leaves.
  std::vector<uint32_t> leafOf_;  ///< The node of each lamp.
};

}  // namespace tomales
