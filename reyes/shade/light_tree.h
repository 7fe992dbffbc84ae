// Noun: a binary tree over many lamps, each of a place and a power, from which few are drawn that stand for all at a
// point. A cut through the tree (Walter et al. 2005, "Lightcuts") divides the lamps into clusters. From each cluster
// one lamp is drawn by its importance (Estevez and Kulla 2018). Its light is divided by its probability, so that the
// mean is right whatever the importance is. It knows no shadows, and of the surface its normal alone. Space: current.
// Threads: const members may be called concurrently.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

/// `power` is E/pi at a distance of 1, of a lamp that is seen from the front. It is positive.
struct TreeLamp {
  Bound3 bound;
  float power;
};

/// A point that asks; N is 0 where light counts from all around.
struct LampReceiver {
  vec3 P, N;
};

/// Lamps of which one is drawn, or one lamp with some samples.
struct LampCluster {
  uint32_t node;
  int samples;
};

class LightTree {
 public:
  explicit LightTree(std::vector<TreeLamp> lamps);

  /// Divides the lamps into clusters. Together these have at most `most` samples, and a cluster of one lamp has at most
  /// `perLamp`. Dividing ends earlier if no sample stands for more than kClusterShare of the light that is expected.
  /// `out` is overwritten.
  void cut(const LampReceiver& at, int most, int perLamp, std::vector<LampCluster>& out) const;
  /// Draws a lamp of a cluster by a number in [0, 1).
  uint32_t draw(const LampReceiver& at, uint32_t node, double xi, float& probability) const;
  /// Returns the expected number of samples that a cut gives to a lamp.
  float expected(const LampReceiver& at, std::span<const LampCluster> cut, uint32_t lamp) const;
  /// Adds the lamps whose bounds a ray from P along the unit direction meets, in the order of the tree.
  void meet(const vec3& P, const vec3& direction, std::vector<uint32_t>& lamps) const;

  /// A sample that stands for no more than this share of a point's light shows as no noise, so that finer clusters
  /// would only cost samples.
  static constexpr float kClusterShare = 0.005f;

 private:
  struct Node {
    vec3 center;
    float radius;    ///< Radius of the sphere around its bound.
    float power;     ///< Power of its lamps together.
    uint32_t right;  ///< The second child; the first one follows its parent. A leaf's is 0.
    uint32_t end;    ///< The number behind the last node below it.
    uint32_t lamp;   ///< The lamp of a leaf.
  };
  uint32_t build(std::span<uint32_t> order);
  /// Returns the light that is expected of the lamps below a node.
  float estimate(const LampReceiver& at, const Node& node) const;
  float shareOfFirst(const LampReceiver& at, uint32_t node) const;

  std::vector<TreeLamp> lamps_;
  std::vector<Node> nodes_;
  std::vector<uint32_t> leafOf_;  ///< The node of each lamp.
};

}  // namespace tomales
