#include "reyes/prim/subdivision_input.h"

#include <fmt/format.h>

#include <algorithm>

namespace tomales {

void requireSubdividable(size_t largest, const std::vector<int>& vertexCounts, const std::vector<int>& vertices) {
  size_t first = 0;
  for (size_t f = 0; f < vertexCounts.size(); ++f) {
    const size_t count = static_cast<size_t>(vertexCounts[f]);
    if (count < 3 || count > largest)
      throw PrimError(fmt::format("face {} has {} vertices, where 3 to {} will do", f, count, largest));
    std::vector<int> sorted(vertices.begin() + static_cast<ptrdiff_t>(first),
                            vertices.begin() + static_cast<ptrdiff_t>(first + count));
    std::sort(sorted.begin(), sorted.end());
    if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
      throw PrimError(fmt::format("face {} has vertex {} more than once", f, *twice));
    first += count;
  }
}

/// OpenSubdiv's weights of the limit around a vertex grow with the square of its corners: the limit here is 250 MB.
std::optional<Crowd> crowdBeyondMeasure(const std::vector<int>& vertexCounts, const std::vector<int>& vertices,
                                        size_t vertexCount) {
  constexpr size_t kMost = 8192;
  std::vector<size_t> corners(vertexCount);
  size_t first = 0;
  for (const int count : vertexCounts) {
    const size_t n = static_cast<size_t>(count);
    for (size_t k = 0; k < n; ++k) corners[static_cast<size_t>(vertices[first + k])] += n - 2;
    first += n;
  }
  const auto most = std::find_if(corners.begin(), corners.end(), [](size_t n) { return n > kMost; });
  if (most == corners.end()) return {};
  return Crowd{static_cast<int>(most - corners.begin()), *most};
}

FaceVaryingChannel mergeFaceVarying(const Primvar& var, const std::vector<int>& vertices, size_t vertexCount) {
  const size_t width = static_cast<size_t>(var.width);
  FaceVaryingChannel out;
  std::vector<std::vector<int>> ofVertex(vertexCount);
  for (size_t k = 0; k < vertices.size(); ++k) {
    const float* value = &var.values[k * width];
    std::vector<int>& known = ofVertex[static_cast<size_t>(vertices[k])];
    const auto same = std::find_if(known.begin(), known.end(), [&](int i) {
      return std::equal(value, value + width, &out.values[static_cast<size_t>(i) * width]);
    });
    out.indices.push_back(same != known.end() ? *same : static_cast<int>(out.values.size() / width));
    if (same != known.end()) continue;
    known.push_back(out.indices.back());
    out.values.insert(out.values.end(), value, value + width);
  }
  return out;
}

}  // namespace tomales
