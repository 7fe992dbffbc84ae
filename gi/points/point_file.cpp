#include "gi/point_file.h"

#include <fmt/format.h>

#include <numeric>
#include <utility>

#include "reyes/base/morton.h"
#include "reyes/base/packed_normal.h"

namespace tomales {
namespace {

constexpr char kPointKind[9] = "TMPOINTS";
constexpr uint32_t kPointVersion = 2;

}  // namespace

template <class A>
void fields(A& a, Bound3& x) {
  auto& [lo, hi] = x;
  each(a, lo, hi);
}

PointFileWriter::PointFileWriter(const std::string& path, const std::vector<CloudChannel>& channels)
    : file_(path, kPointKind, kPointVersion) {
  pending_.channels = channels;
  if (pending_.width() > kMostWidth)
    throw FileError(fmt::format("\"{}\": more than {} floats per point", path, kMostWidth));
}

void PointFileWriter::add(const vec3& P, const vec3& N, float radius, const float* values) {
  if (!isValidPoint(P, N, radius, {values, static_cast<size_t>(pending_.width())})) return;
  pending_.add(P, N, radius, values);
  if (pending_.count() < kChunkPoints) return;
  addChunk(pending_);
  pending_.clear();
}

void PointFileWriter::addChunk(const PointCloud& points) {
  if (points.count() == 0) return;
  std::vector<uint32_t> normals(points.count());
  std::transform(points.normal.begin(), points.normal.end(), normals.begin(), packNormal);
  Packer w;  // local, because each of many files that are written at once would keep its own
  const size_t floats = 5 + static_cast<size_t>(points.width());
  w.bytes.reserve(4 * sizeof(uint64_t) + points.count() * floats * sizeof(float));
  w.put(points.position, normals, points.radius, points.data);
  contents_.raw(w.bytes.data(), w.bytes.size());
  file_.add(w.bytes);
  bounds_.push_back(points.bound());
  written_ += points.count();
}

void PointFileWriter::finish(const MadeFrom& madeFrom) {
  addChunk(pending_);
  Packer header;
  putChannels(header, pending_.channels);
  for (const CloudChannel& c : pending_.channels) contents_.raw(c.name.data(), c.name.size());
  header.put(static_cast<uint64_t>(written_), bounds_, madeFrom, contents_.sum);
  file_.finish(header.bytes);
}

PointFile::PointFile(const std::string& path) : file_(path, kPointKind, kPointVersion) {
  const Bytes header = file_.takeHeader();
  Unpacker r{header};
  channels_ = getChannels(r, path);
  width_ = widthOf(channels_);
  each(r, count_, bounds_, madeFrom_, contents_);
  throwIfDamaged(r, path);
  if (bounds_.size() != file_.count())
    throw DamageError(path, fmt::format("\"{}\" is damaged: its chunks do not add up", path));
  if (!std::all_of(bounds_.begin(), bounds_.end(),
                   [](const Bound3& b) { return isFinite(b.lo) && isFinite(b.hi) && !b.empty(); }))
    throw DamageError(path, fmt::format("\"{}\" is damaged: a chunk has no place", path));
}

Bound3 PointFile::bound() const {
  Bound3 b;
  for (const Bound3& chunk : bounds_) b.extend(chunk);
  return b;
}

void PointFile::read(size_t chunk, PointCloud& to) const {
  const Bytes bytes = file_.read(static_cast<uint32_t>(chunk));
  Unpacker r{bytes};
  if (to.channels.empty()) to.channels = channels_;
  const auto positions = r.get<std::vector<vec3>>();
  const auto normals = r.get<std::vector<uint32_t>>();
  const auto radii = r.get<std::vector<float>>();
  const auto data = r.get<std::vector<float>>();
  throwIfDamaged(r, file_.path());
  const size_t n = positions.size();
  if (normals.size() != n || radii.size() != n || data.size() != n * static_cast<size_t>(to.width()))
    throw DamageError(file_.path(), fmt::format("\"{}\" is damaged: a chunk does not add up", file_.path()));
  const auto finite = [](float v) { return std::isfinite(v); };
  const Bound3& b = bounds_[chunk];  // the bound is finite, so all points within it are
  if (!std::all_of(positions.begin(), positions.end(),
                   [&](const vec3& P) {
                     return glm::all(glm::greaterThanEqual(P, b.lo)) && glm::all(glm::lessThanEqual(P, b.hi));
                   }) ||
      !std::all_of(radii.begin(), radii.end(), [](float radius) { return std::isfinite(radius) && radius >= 0; }) ||
      !std::all_of(data.begin(), data.end(), finite))
    throw DamageError(file_.path(),
                      fmt::format("\"{}\" is damaged: a point is not finite, or not where it should be", file_.path()));
  to.position.insert(to.position.end(), positions.begin(), positions.end());
  for (const uint32_t p : normals) to.normal.push_back(unpackNormal(p));
  to.radius.insert(to.radius.end(), radii.begin(), radii.end());
  to.data.insert(to.data.end(), data.begin(), data.end());
}

PointCloud PointFile::readAll() const {
  PointCloud cloud;
  cloud.channels = channels_;
  cloud.reserve(std::min<size_t>(count_, chunkCount() * PointFileWriter::kChunkPoints));
  for (size_t i = 0; i < chunkCount(); ++i) read(i, cloud);
  return cloud;
}

void writePointFile(const PointCloud& cloud, const std::string& path, const MadeFrom& madeFrom) {
  PointFileWriter file(path, cloud.channels);
  for (const uint32_t i : mortonOrder(cloud.position))
    file.add(cloud.position[i], cloud.normal[i], cloud.radius[i], cloud.at(i));
  file.finish(madeFrom);
}

}  // namespace tomales
