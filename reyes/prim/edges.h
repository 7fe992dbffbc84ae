// Which edges of a mesh join two faces. Private to the primitives.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

namespace tomales {

class EdgeFaces {
 public:
  /// Sizes and indices that requireFaces has passed.
  EdgeFaces(const std::vector<int>& vertexCounts, const std::vector<int>& vertices) {
    sides_.reserve(vertices.size());
    size_t first = 0;
    for (int count : vertexCounts) {
      for (int k = 0; k < count; ++k)
        sides_.push_back(key(vertices[first + k], vertices[first + (k + 1) % count]));
      first += static_cast<size_t>(count);
    }
    std::sort(sides_.begin(), sides_.end());
  }

  /// Faces at the edge between vertices a and b; 0 if there is no such edge.
  int count(int a, int b) const {
    const auto [first, last] = std::equal_range(sides_.begin(), sides_.end(), key(a, b));
    return static_cast<int>(last - first);
  }

 private:
  static uint64_t key(int a, int b) {
    return static_cast<uint64_t>(std::min(a, b)) << 32 | static_cast<uint32_t>(std::max(a, b));
  }
  std::vector<uint64_t> sides_;  // an edge as often as faces have it
};

}  // namespace tomales
