#include "reyes/bindings/assimp/welding.h"

#include <bit>
#include <cstdint>

namespace tomales::model {
namespace {

/// -0 is 0.
uint32_t bitsOf(float f) { return std::bit_cast<uint32_t>(f + 0.0f); }

uint64_t hashOf(const aiVector3D& p) {
  uint64_t h = bitsOf(p.x) * 0x9e3779b97f4a7c15U;
  h = (h ^ (h >> 29) ^ bitsOf(p.y)) * 0xbf58476d1ce4e5b9U;
  h = (h ^ (h >> 32) ^ bitsOf(p.z)) * 0x94d049bb133111ebU;
  return h ^ (h >> 31);
}

}  // namespace

/// Open addressing: the table has the numbers of points, -1 where it is empty.
Welded weld(const aiMesh& mesh, const std::vector<int>& corners) {
  Welded out;
  out.pointOf.assign(mesh.mNumVertices, -1);
  const size_t size = std::bit_ceil(2 * std::min<size_t>(corners.size(), mesh.mNumVertices) + 2);
  std::vector<int> table(size, -1);
  for (const int corner : corners) {
    int& point = out.pointOf[static_cast<size_t>(corner)];
    if (point >= 0) continue;
    const aiVector3D& p = mesh.mVertices[corner];
    size_t at = hashOf(p) & (size - 1);
    const auto lies = [&](int k) {
      const vec3& q = out.points[static_cast<size_t>(k)];
      return q.x == p.x && q.y == p.y && q.z == p.z;
    };
    while (table[at] >= 0 && !lies(table[at])) at = (at + 1) & (size - 1);
    if (table[at] < 0) {
      table[at] = static_cast<int>(out.points.size());
      out.points.emplace_back(p.x, p.y, p.z);
      out.vertexOf.push_back(corner);
    } else {
      out.oneToOne = false;
    }
    point = table[at];
  }
  return out;
}

}  // namespace tomales::model
