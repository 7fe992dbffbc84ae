#include "reyes/shade/light_tree.h"

#include <algorithm>
#include <numeric>

namespace tomales {
namespace {

/// Lamps behind a surface may shine through it, so they keep this share of their light from the front.
constexpr float kBehind = 0.1f;
/// Least cosine that counts for a draw: bumps may turn a surface to a lamp that grazes it.
constexpr float kGrazing = 0.02f;
/// Least squared distance, so that light is finite at a lamp.
constexpr float kNearest = 1e-20f;
/// Each side of a division has at least this many lamps; otherwise the division is at the median, so that the tree
/// stays flat.
constexpr size_t kLeastSide = 16;

struct Refinable {
  float error, light;
  LightCluster cluster;
  bool operator<(const Refinable& o) const {
    return error != o.error ? error < o.error : cluster.node > o.cluster.node;
  }
};

/// A draw on its way down the tree.
struct Descent {
  double xi;
  float probability;
  uint32_t node;
  size_t number;
};

/// The places of some lamps, weighted by their power.
struct Places {
  double power;
  glm::dvec3 mean, variance;
};

/// Returns the places of one lamp, taken as uniform over its bound.
Places placesOf(const TreeLight& light) {
  const glm::dvec3 size(light.bound.size());
  return {double{light.power}, glm::dvec3(light.bound.center()), size * size / 12.0};
}

Places joined(const Places& a, const Places& b) {
  const double power = a.power + b.power, share = b.power / power;
  const glm::dvec3 apart = b.mean - a.mean;
  return {power, a.mean + share * apart,
          (1 - share) * a.variance + share * b.variance + share * (1 - share) * apart * apart};
}

}  // namespace

LightTree::LightTree(std::vector<TreeLight> lights) : lights_(std::move(lights)), leafOf_(lights_.size()) {
  std::vector<uint32_t> order(lights_.size());
  std::iota(order.begin(), order.end(), 0U);
  nodes_.reserve(2 * lights_.size());
  if (!order.empty()) build(order);
  fillParts();
}

void LightTree::fillParts() {
  std::vector<Places> places(nodes_.size());
  parts_.reserve(nodes_.size() / 2);
  for (uint32_t n = static_cast<uint32_t>(nodes_.size()); n-- > 0;) {  // from the leaves up
    Node& node = nodes_[n];
    if (node.right == 0) {
      places[n] = placesOf(lights_[node.below]);
      continue;
    }
    places[n] = joined(places[n + 1], places[node.right]);
    node.below = static_cast<uint32_t>(parts_.size());
    Parts& parts = parts_.emplace_back();
    size_t k = 0;
    const auto add = [&](uint32_t part) {
      for (int axis = 0; axis < 3; ++axis) {
        parts.mean[static_cast<size_t>(axis)][k] = static_cast<float>(places[part].mean[axis]);
        parts.variance[static_cast<size_t>(axis)][k] = static_cast<float>(places[part].variance[axis]);
      }
      parts.power[k] = nodes_[part].power;
      parts.node[k++] = part;
    };
    for (const uint32_t child : {n + 1, node.right}) {
      const bool leaf = nodes_[child].right == 0;
      add(leaf ? child : child + 1);
      if (!leaf) add(nodes_[child].right);
    }
  }
}

uint32_t LightTree::build(std::span<uint32_t> order) {
  const auto index = static_cast<uint32_t>(nodes_.size());
  Bound3 bound, centers;
  float power = 0;
  for (const uint32_t l : order) {
    bound.extend(lights_[l].bound);
    centers.extend(lights_[l].bound.center());
    power += lights_[l].power;
  }
  nodes_.push_back({bound.center(), 0.5f * glm::length(bound.size()), power, 0, 0, order[0],
                    *std::min_element(order.begin(), order.end())});
  if (order.size() > 1) {
    const vec3 size = centers.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto place = [&](uint32_t l) { return lights_[l].bound.center()[axis]; };
    const float half = centers.center()[axis];
    auto middle = std::stable_partition(order.begin(), order.end(), [&](uint32_t l) { return place(l) < half; });
    const auto first = static_cast<size_t>(middle - order.begin()), least = order.size() / kLeastSide + 1;
    if (first < least || order.size() - first < least) {
      middle = order.begin() + static_cast<ptrdiff_t>(order.size() / 2);
      std::sort(order.begin(), order.end(),
                [&](uint32_t a, uint32_t b) { return place(a) != place(b) ? place(a) < place(b) : a < b; });
    }
    const auto count = static_cast<size_t>(middle - order.begin());
    build(order.first(count));
    const uint32_t right = build(order.subspan(count));  // before nodes_[index], which moves meanwhile
    nodes_[index].right = right;
  } else {
    leafOf_[order[0]] = index;
  }
  nodes_[index].end = static_cast<uint32_t>(nodes_.size());
  return index;
}

float LightTree::atBest(const LightReceiver& at, const Node& node) const {
  const vec3 to = node.center - at.P;
  const float distance2 = dot(to, to), distance = std::sqrt(distance2), r = node.radius;
  float cosine = 1;  // of the point of the sphere that is farthest in front
  if (at.N != vec3(0.0f) && distance > r) cosine = std::clamp((dot(at.N, to) + r) / distance, kBehind, 1.0f);
  return node.power * cosine / std::max({distance2, r * r, kNearest});
}

void LightTree::cut(const LightReceiver& at, int most, int perLight, std::vector<LightCluster>& out) const {
  out.clear();
  if (nodes_.empty() || at.lights == 0) return;
  thread_local std::vector<Refinable> heap;
  heap.clear();
  float light = 0;
  int samples = 0;
  const auto add = [&](uint32_t node, int n) {
    if (nodes_[node].first >= at.lights) return;
    const float expected = atBest(at, nodes_[node]);
    const bool whole = nodes_[node].right == 0 && n >= perLight;
    heap.push_back({whole ? 0 : expected / static_cast<float>(n), expected, {node, n}});
    std::push_heap(heap.begin(), heap.end());
    light += expected;
    samples += n;
  };
  add(0, 1);
  while (heap.front().error > kClusterShare * light) {
    const Refinable worst = heap.front();
    const bool leaf = nodes_[worst.cluster.node].right == 0;
    const int n = worst.cluster.samples, twice = std::min(2 * n, perLight);
    if (samples + (leaf ? twice - n : 1) > most) break;
    std::pop_heap(heap.begin(), heap.end());
    heap.pop_back();
    light -= worst.light;
    samples -= n;
    if (leaf) {
      add(worst.cluster.node, twice);
      continue;
    }
    add(worst.cluster.node + 1, 1);
    add(nodes_[worst.cluster.node].right, 1);
  }
  for (const Refinable& r : heap) out.push_back(r.cluster);
}

// Where it is inlined, compilers unroll the loop before they make vectors of it.
[[gnu::noinline]] std::array<float, LightTree::kParts> LightTree::importance(const LightReceiver& at,
                                                                             const Parts& parts) {
  std::array<float, kParts> out;
  const auto& [mx, my, mz] = parts.mean;
  const auto& [vx, vy, vz] = parts.variance;
  const vec3 n2 = 2 / kPi * at.N * at.N;
  for (size_t k = 0; k < kParts; ++k) {
    const float x = mx[k] - at.P.x, y = my[k] - at.P.y, z = mz[k] - at.P.z;
    const float along = at.N.x * x + at.N.y * y + at.N.z * z;
    const float front = 0.5f * (along + std::sqrt(along * along + n2.x * vx[k] + n2.y * vy[k] + n2.z * vz[k]));
    const float distance2 = std::max(std::max(x * x + y * y + z * z, vx[k] + vy[k] + vz[k]), kNearest),
                near = 1 / std::sqrt(distance2);
    out[k] = parts.power[k] * near * near * std::max((front + kBehind * (front - along)) * near, kGrazing);
  }
  if (!(out[0] + out[1] + out[2] + out[3] > 0))  // lamps that are very dim and far off underflow
    for (size_t k = 0; k < kParts; ++k) out[k] = parts.power[k] > 0 ? 1.0f : 0.0f;
  return out;
}

std::array<float, LightTree::kParts> LightTree::importanceBelow(const LightReceiver& at, const Node& node) const {
  const Parts& all = parts_[node.below];
  if (at.lights >= lights_.size()) return importance(at, all);
  Parts lit = all;
  for (size_t k = 0; k < kParts; ++k)
    if (nodes_[lit.node[k]].first >= at.lights) lit.power[k] = 0;
  return importance(at, lit);
}

void LightTree::draw(const LightReceiver& at, std::span<const LightCluster> clusters, std::span<const float> xi,
                     std::span<DrawnLight> out) const {
  thread_local std::vector<Descent> open;
  open.clear();
  const auto put = [&](const Descent& d) {
    const Node& node = nodes_[d.node];
    if (node.right != 0) return true;
    out[d.number] = {node.below, d.probability};
    return false;
  };
  for (size_t i = 0; i < clusters.size(); ++i)
    if (const Descent d{double{xi[i]}, 1, clusters[i].node, i}; put(d)) open.push_back(d);
  while (!open.empty()) {
    size_t left = 0;
    for (Descent d : open) {
      const Node& node = nodes_[d.node];
      const Parts& parts = parts_[node.below];
      const std::array<float, kParts> light = importanceBelow(at, node);
      const std::array<float, kParts> before{0, light[0], light[0] + light[1], light[0] + light[1] + light[2]};
      const float all = before[3] + light[3];
      const double x = d.xi * double{all};
      const auto k =
          static_cast<size_t>(int{x >= double{before[1]}} + int{x >= double{before[2]}} + int{x >= double{before[3]}});
      d.xi = std::min((x - double{before[k]}) / double{light[k]}, 1 - 0x1p-52);
      d.probability *= light[k] / all;
      d.node = parts.node[k];
      if (put(d)) open[left++] = d;
    }
    open.resize(left);
  }
}

float LightTree::expected(const LightReceiver& at, std::span<const LightCluster> cut, uint32_t light) const {
  const uint32_t leaf = leafOf_[light];
  for (const LightCluster& c : cut) {
    uint32_t node = c.node;
    if (leaf < node || leaf >= nodes_[node].end) continue;
    float probability = 1;
    while (nodes_[node].right != 0) {
      const Parts& parts = parts_[nodes_[node].below];
      const std::array<float, kParts> power = importanceBelow(at, nodes_[node]);
      size_t k = 0;
      while (leaf >= nodes_[parts.node[k]].end) ++k;
      probability *= power[k] / (power[0] + power[1] + power[2] + power[3]);
      node = parts.node[k];
    }
    return probability * static_cast<float>(c.samples);
  }
  return 0;
}

void LightTree::meet(const vec3& P, const vec3& direction, std::vector<uint32_t>& lights) const {
  for (uint32_t node = 0; node < nodes_.size();) {
    const Node& n = nodes_[node];
    const vec3 to = n.center - P;
    const float along = dot(to, direction), r = 1.0001f * n.radius;
    const bool near = dot(to, to) <= r * r || (along > 0 && dot(to, to) - along * along <= r * r);
    if (near && n.right == 0) lights.push_back(n.below);
    node = near ? node + 1 : n.end;
  }
}

}  // namespace tomales
