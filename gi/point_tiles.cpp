#include "gi/point_tiles.h"

namespace tomales {
namespace {

constexpr int kSide = 1 << PointTiles::kDeepest;

bool meet(const Bound3& a, const Bound3& b) {
  return glm::all(glm::lessThanEqual(a.lo, b.hi)) && glm::all(glm::greaterThanEqual(a.hi, b.lo));
}

}  // namespace

BrickCube cubeAround(const Bound3& b) {
  if (b.empty()) return {};
  const float longest = maxComponent(b.size());
  // A margin, so that the farthest points lie inside and a single one has a volume at all.
  const float size = longest * 1.001f + 1e-5f * maxComponent(glm::max(glm::abs(b.lo), glm::abs(b.hi))) + 1e-30f;
  return {b.center() - vec3(0.5f * size), size};
}

PointTiles::PointTiles(const PointFile& file) : file_(file), cube_(cubeAround(file.bound())), counts_(kSide * kSide * kSide) {
  double sum = 0, values = 0;
  for (size_t chunk = 0; chunk < file.chunkCount(); ++chunk) {
    PointCloud part;
    file.read(chunk, part);
    for (const vec3& P : part.position) {
      const glm::ivec3 at = glm::clamp(glm::ivec3((P - cube_.lo) / cube_.size * static_cast<float>(kSide)), 0, kSide - 1);
      ++counts_[static_cast<size_t>((at.z * kSide + at.y) * kSide + at.x)];
    }
    for (const float r : part.radius) largestRadius_ = std::max(largestRadius_, r);
    for (const float v : part.data) sum += double{v};
    values += static_cast<double>(part.data.size());
  }
  mean_ = values > 0 ? sum / values : 0;
}

Bound3 PointTiles::box(int level, const glm::ivec3& place) const {
  const float size = std::ldexp(cube_.size, -level);
  const vec3 lo = cube_.lo + size * vec3(place);
  return {lo, lo + vec3(size)};
}

uint64_t PointTiles::count(int level, const glm::ivec3& place) const {
  const int width = kSide >> level;
  const glm::ivec3 first = place * width;
  uint64_t sum = 0;
  for (int z = 0; z < width; ++z)
    for (int y = 0; y < width; ++y)
      for (int x = 0; x < width; ++x) sum += counts_[static_cast<size_t>(((first.z + z) * kSide + first.y + y) * kSide + first.x + x)];
  return sum;
}

PointCloud PointTiles::around(const Bound3& box, float margin) const {
  PointCloud out, part;
  out.channels = file_.channels();
  for (size_t chunk = 0; chunk < file_.chunkCount(); ++chunk) {
    if (!meet(file_.chunkBound(chunk), box.grown(std::max(margin, largestRadius_)))) continue;
    part = {};
    file_.read(chunk, part);
    for (size_t i = 0; i < part.count(); ++i) {
      const vec3& P = part.position[i];
      if (meet({P, P}, box.grown(std::max(margin, part.radius[i])))) out.add(P, part.normal[i], part.radius[i], part.at(i));
    }
  }
  return out;
}

}  // namespace tomales
