#include "gi/bricks/point_tiles.h"

#include "reyes/base/stop.h"

namespace tomales {
namespace {

constexpr int kSide = 1 << PointTiles::kDeepest;
constexpr uint64_t kPiles = 64;

size_t indexOf(const glm::ivec3& cell) { return static_cast<size_t>((cell.z * kSide + cell.y) * kSide + cell.x); }

/// Returns cell `number`, 0 .. kSide^3 - 1, along a Morton curve, in which neighbours are neighbours in space.
glm::ivec3 alongCurve(int number) {
  glm::ivec3 cell(0);
  for (int bit = 0; bit < PointTiles::kDeepest; ++bit)
    for (int k = 0; k < 3; ++k) cell[k] |= (number >> (3 * bit + k) & 1) << bit;
  return cell;
}

bool meet(const Bound3& a, const Bound3& b) {
  return glm::all(glm::lessThanEqual(a.lo, b.hi)) && glm::all(glm::greaterThanEqual(a.hi, b.lo));
}

}  // namespace

BrickCube cubeAround(const Bound3& b) {
  if (b.empty()) return {};
  const float longest = maxComponent(b.size());
  // The margin puts the farthest points inside, and gives a single point a volume.
  const float size = longest * 1.001f + 1e-5f * maxComponent(glm::max(glm::abs(b.lo), glm::abs(b.hi))) + 1e-30f;
  return {b.center() - vec3(0.5f * size), size};
}

PointTiles::PointTiles(const PointFile& file)
    : file_(file), cube_(cubeAround(file.bound())), counts_(kSide * kSide * kSide) {
  double sum = 0, values = 0;
  const auto width = static_cast<size_t>(widthOf(dataOf(file.channels())));
  for (size_t chunk = 0; chunk < file.chunkCount(); ++chunk) {
    PointCloud part;
    file.read(chunk, part);
    for (const vec3& P : part.position) ++counts_[indexOf(cellOf(P))];
    for (const float r : part.radius) largestRadius_ = std::max(largestRadius_, r);
    for (size_t i = 0; i < part.count(); ++i)
      for (size_t k = 0; k < width; ++k) sum += double{part.at(i)[k]};
    values += static_cast<double>(part.count() * width);
  }
  mean_ = values > 0 ? sum / values : 0;
}

glm::ivec3 PointTiles::cellOf(const vec3& P) const {
  glm::ivec3 cell(0);
  for (int k = 0; k < 3; ++k) {
    const float at = (P[k] - cube_.lo[k]) / cube_.size * static_cast<float>(kSide);
    // Where the cube is too large for floats, `at` is NaN and the point goes to the first cell.
    if (at > 0) cell[k] = at < kSide ? static_cast<int>(at) : kSide - 1;
  }
  return cell;
}

Bound3 PointTiles::box(int level, const glm::ivec3& place) const {
  const float size = std::ldexp(cube_.size, -level);
  return {cube_.lo + size * vec3(place), cube_.lo + size * vec3(place + 1)};
}

uint64_t PointTiles::count(int level, const glm::ivec3& place) const {
  const int width = kSide >> level;
  const glm::ivec3 first = place * width;
  uint64_t sum = 0;
  for (int z = 0; z < width; ++z)
    for (int y = 0; y < width; ++y)
      for (int x = 0; x < width; ++x) sum += counts_[indexOf(first + glm::ivec3(x, y, z))];
  return sum;
}

PointCloud PointTiles::around(const Bound3& box, float margin, float radiusScale) const {
  PointCloud out, part;
  out.channels = file_.channels();
  std::vector<size_t> chunks;
  for (size_t chunk = 0; chunk < file_.chunkCount(); ++chunk)
    if (meet(file_.chunkBound(chunk), box.grown(std::max(margin, largestRadius_ * radiusScale))))
      chunks.push_back(chunk);
  // Reserved memory that is not written to costs nothing; vectors that grow leave holes of half their size.
  out.reserve(chunks.size() * PointFileWriter::kChunkPoints);
  for (const size_t chunk : chunks) {
    part = {};
    file_.read(chunk, part);
    for (size_t i = 0; i < part.count(); ++i) {
      const vec3& P = part.position[i];
      if (meet({P, P}, box.grown(std::max(margin, part.radius[i] * radiusScale))))
        out.add(P, part.normal[i], part.radius[i], part.at(i));
    }
  }
  return out;
}

void PointTiles::writeCompact(const std::string& path) const {
  std::vector<uint8_t> pileOf(counts_.size());
  uint64_t before = 0;
  for (int number = 0; number < kSide * kSide * kSide; ++number) {
    const size_t cell = indexOf(alongCurve(number));
    pileOf[cell] = static_cast<uint8_t>(before * kPiles / std::max<uint64_t>(file_.count(), 1));
    before += counts_[cell];
  }
  PointFileWriter writer(path, file_.channels());
  PointCloud empty, part;
  empty.channels = file_.channels();
  std::vector<PointCloud> piles(kPiles, empty);
  for (size_t chunk = 0; chunk < file_.chunkCount(); ++chunk) {
    throwIfStopped();
    part = {};
    file_.read(chunk, part);
    for (size_t i = 0; i < part.count(); ++i) {
      PointCloud& pile = piles[pileOf[indexOf(cellOf(part.position[i]))]];
      pile.add(part.position[i], part.normal[i], part.radius[i], part.at(i));
      if (pile.count() < PointFileWriter::kChunkPoints) continue;
      writer.addChunk(pile);
      pile.clear();
    }
  }
  for (const PointCloud& pile : piles) writer.addChunk(pile);
  writer.finish(file_.madeFrom());
}

}  // namespace tomales
