#include "gi/point_cloud.h"

#include <fmt/format.h>

namespace tomales {

bool tellsSurfaces(const std::vector<CloudChannel>& channels) {
  return !channels.empty() && channels.back() == kSurfaceChannel;
}

std::vector<CloudChannel> dataOf(std::vector<CloudChannel> channels) {
  if (tellsSurfaces(channels)) channels.pop_back();
  return channels;
}

int widthOf(const std::vector<CloudChannel>& channels) {
  int sum = 0;
  for (const CloudChannel& c : channels) sum += c.width;
  return sum;
}

void putChannels(Packer& w, const std::vector<CloudChannel>& channels) {
  w.put(static_cast<uint32_t>(channels.size()));
  for (const CloudChannel& c : channels) w.put(c.name, c.width);
}

std::vector<CloudChannel> getChannels(Unpacker& r, const std::string& path) {
  std::vector<CloudChannel> out;
  const auto count = r.get<uint32_t>();
  int width = 0;
  for (uint32_t i = 0; i < count; ++i) {
    std::string name = r.get<std::string>();
    out.push_back({std::move(name), r.get<int>()});
    throwIfDamaged(r, path);
    if (out.back().width < 1 || out.back().width > kMostWidth - width)
      throw FileError(fmt::format("\"{}\": its channels are too many or damaged", path));
    width += out.back().width;
  }
  return out;
}

int PointCloud::surface(size_t point) const {
  if (!channels.tellsSurfaces()) return 0;
  const float told = at(point)[width() - 1];
  return told >= 1 && told <= kAcrossWalls ? static_cast<int>(told) : 0;
}

void PointCloud::add(const vec3& P, const vec3& N, float r, const float* values) {
  position.push_back(P);
  normal.push_back(N);
  radius.push_back(r);
  data.insert(data.end(), values, values + width());
}

void PointCloud::reserve(size_t points) {
  position.reserve(points);
  normal.reserve(points);
  radius.reserve(points);
  data.reserve(points * static_cast<size_t>(width()));
}

void PointCloud::clear() {
  position.clear();
  normal.clear();
  radius.clear();
  data.clear();
}

Bound3 PointCloud::bound() const {
  Bound3 b;
  for (const vec3& p : position) b.extend(p);
  return b;
}

int offsetOf(const std::vector<CloudChannel>& channels, const std::string& name, int width) {
  int offset = 0;
  for (const CloudChannel& c : channels) {
    if (c.name == name) return width == 0 || c.width == width ? offset : -1;
    offset += c.width;
  }
  return -1;
}

bool isValidPoint(const vec3& P, const vec3& N, float radius, std::span<const float> values) {
  // Zero times a finite value is zero; zero times infinity or NaN is NaN.
  const vec3 ofPlace = 0.0f * P + 0.0f * N;
  float sum = ofPlace.x + ofPlace.y + ofPlace.z + 0.0f * radius;
  for (const float v : values) sum += 0.0f * v;
  return sum == 0 && radius >= 0;
}

}  // namespace tomales
