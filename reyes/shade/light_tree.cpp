#include "reyes/shade/light_tree.h"

#include <algorithm>
#include <numeric>

namespace tomales {
namespace {

/// Least cosine that counts. Lamps behind a surface may shine through it, so they keep some importance.
constexpr float kBehind = 0.1f;
/// A side of a division holds at least so many of its lamps; else the median divides, and the tree stays flat.
constexpr size_t kLeastSide = 16;

struct Refinable {
  float error, light;
  LampCluster cluster;
  bool operator<(const Refinable& o) const {
    return error != o.error ? error < o.error : cluster.node > o.cluster.node;
  }
};

}  // namespace

LightTree::LightTree(std::vector<TreeLamp> lamps) : lamps_(std::move(lamps)), leafOf_(lamps_.size()) {
  std::vector<uint32_t> order(lamps_.size());
  std::iota(order.begin(), order.end(), 0U);
  nodes_.reserve(2 * lamps_.size());
  if (!order.empty()) build(order);
}

uint32_t LightTree::build(std::span<uint32_t> order) {
  const auto index = static_cast<uint32_t>(nodes_.size());
  Bound3 bound, centers;
  float power = 0;
  for (const uint32_t l : order) {
    bound.extend(lamps_[l].bound);
    centers.extend(lamps_[l].bound.center());
    power += lamps_[l].power;
  }
  nodes_.push_back({bound.center(), 0.5f * glm::length(bound.size()), power, 0, 0, order[0]});
  if (order.size() > 1) {
    const vec3 size = centers.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto place = [&](uint32_t l) { return lamps_[l].bound.center()[axis]; };
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
    nodes_[index].right = build(order.subspan(count));
  } else {
    leafOf_[order[0]] = index;
  }
  nodes_[index].end = static_cast<uint32_t>(nodes_.size());
  return index;
}

float LightTree::estimate(const LampReceiver& at, const Node& node) const {
  const vec3 to = node.center - at.P;
  const float distance2 = dot(to, to), distance = std::sqrt(distance2), r = node.radius;
  float cosine = 1;  // that of the sphere's point that is farthest in front
  if (at.N != vec3(0.0f) && distance > r) cosine = std::clamp((dot(at.N, to) + r) / distance, kBehind, 1.0f);
  return node.power * cosine / std::max({distance2, r * r, 1e-20f});
}

void LightTree::cut(const LampReceiver& at, int most, int perLamp, std::vector<LampCluster>& out) const {
  out.clear();
  if (nodes_.empty()) return;
  thread_local std::vector<Refinable> heap;
  heap.clear();
  float light = 0;
  int samples = 0;
  const auto add = [&](uint32_t node, int n) {
    const float expected = estimate(at, nodes_[node]);
    const bool whole = nodes_[node].right == 0 && n >= perLamp;
    heap.push_back({whole ? 0 : expected / static_cast<float>(n), expected, {node, n}});
    std::push_heap(heap.begin(), heap.end());
    light += expected;
    samples += n;
  };
  add(0, 1);
  while (heap.front().error > kClusterShare * light) {
    const Refinable worst = heap.front();
    const bool leaf = nodes_[worst.cluster.node].right == 0;
    const int n = worst.cluster.samples, twice = std::min(2 * n, perLamp);
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

float LightTree::shareOfFirst(const LampReceiver& at, uint32_t node) const {
  const float a = estimate(at, nodes_[node + 1]), b = estimate(at, nodes_[nodes_[node].right]);
  return a + b > 0 ? a / (a + b) : 0.5f;  // lamps that are very dim and far off underflow
}

uint32_t LightTree::draw(const LampReceiver& at, uint32_t node, double xi, float& probability) const {
  probability = 1;
  while (nodes_[node].right != 0) {
    const float first = shareOfFirst(at, node);
    const bool isFirst = xi < double{first};
    xi = std::min(isFirst ? xi / double{first} : (xi - double{first}) / (1 - double{first}), 1 - 0x1p-52);
    probability *= isFirst ? first : 1 - first;
    node = isFirst ? node + 1 : nodes_[node].right;
  }
  return nodes_[node].lamp;
}

float LightTree::expected(const LampReceiver& at, std::span<const LampCluster> cut, uint32_t lamp) const {
  const uint32_t leaf = leafOf_[lamp];
  for (const LampCluster& c : cut) {
    uint32_t node = c.node;
    if (leaf < node || leaf >= nodes_[node].end) continue;
    float probability = 1;
    while (nodes_[node].right != 0) {
      const float first = shareOfFirst(at, node);
      const bool isFirst = leaf < nodes_[node].right;
      probability *= isFirst ? first : 1 - first;
      node = isFirst ? node + 1 : nodes_[node].right;
    }
    return probability * static_cast<float>(c.samples);
  }
  return 0;
}

void LightTree::meet(const vec3& P, const vec3& direction, std::vector<uint32_t>& lamps) const {
  for (uint32_t node = 0; node < nodes_.size();) {
    const Node& n = nodes_[node];
    const vec3 to = n.center - P;
    const float along = dot(to, direction), r = 1.0001f * n.radius;
    const bool near = dot(to, to) <= r * r || (along > 0 && dot(to, to) - along * along <= r * r);
    if (near && n.right == 0) lamps.push_back(n.lamp);
    node = near ? node + 1 : n.end;
  }
}

}  // namespace tomales
