// Private to the primitives: finds the edges of a mesh that join two faces.
#pragma once
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace tomales {

class EdgeFaces {
 public:
  /// Sizes and indices must have passed requireFaces().
  EdgeFaces(const std::vector<int>& vertexCounts, const std::vector<int>& vertices) {
    const int most = vertices.empty() ? -1 : *std::max_element(vertices.begin(), vertices.end());
    end_.assign(static_cast<size_t>(most) + 2, 0);
    forSides(vertexCounts, vertices, [&](int a, int) { ++end_[static_cast<size_t>(a) + 1]; });
    std::partial_sum(end_.begin(), end_.end(), end_.begin());
    others_.resize(vertices.size());
    // Filling moves each list's end, which began one place early, to its final place.
    forSides(vertexCounts, vertices, [&](int a, int b) { others_[end_[static_cast<size_t>(a)]++] = b; });
    for (int a = 0; a <= most; ++a) std::sort(others_.begin() + firstOf(a), others_.begin() + lastOf(a));
  }

  /// Returns the number of faces at the edge between vertices a and b; 0 if there is no such edge.
  int count(int a, int b) const {
    if (a > b) std::swap(a, b);
    if (a < 0 || static_cast<size_t>(a) + 1 >= end_.size()) return 0;
    const auto [first, last] = std::equal_range(others_.begin() + firstOf(a), others_.begin() + lastOf(a), b);
    return static_cast<int>(last - first);
  }

 private:
  /// Calls f(lesser vertex, greater one) for every side of every face.
  template <class F>
  static void forSides(const std::vector<int>& vertexCounts, const std::vector<int>& vertices, const F& f) {
    size_t first = 0;
    for (const int count : vertexCounts) {
      for (int k = 0; k < count; ++k) {
        const int a = vertices[first + static_cast<size_t>(k)],
                  b = vertices[first + static_cast<size_t>(k + 1 < count ? k + 1 : 0)];
        f(std::min(a, b), std::max(a, b));
      }
      first += static_cast<size_t>(count);
    }
  }
  ptrdiff_t firstOf(int a) const { return a > 0 ? static_cast<ptrdiff_t>(end_[static_cast<size_t>(a) - 1]) : 0; }
  ptrdiff_t lastOf(int a) const { return static_cast<ptrdiff_t>(end_[static_cast<size_t>(a)]); }

  // Indexed by vertex: the greater ends of its sides, sorted, each as often as faces have the edge.
  std::vector<int> others_;
  std::vector<size_t> end_;  // Indexed by vertex: end of its list.
};

}  // namespace tomales
