// Noun: a point cloud. Oriented disks with any channels of data: photons, irradiance points and baked surfaces alike.
//   position, normal, radius of every point, then `width()` floats of data, channel after channel
// Space: world, unless a file's header says otherwise (PRMan's bake3d "coordsystem"). Over reyes/base alone.
// Threads: plain data.
#pragma once
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "reyes/base/chunk_file.h"
#include "reyes/base/math.h"

namespace tomales {

struct CloudChannel {
  std::string name;
  int width = 1;  ///< Floats of one point.
  bool operator==(const CloudChannel&) const = default;
};

/// The last channel of clouds that tell surfaces apart: which one a point lies on, 1 .. kMostSurfaces; 0: not known. No
/// datum of its own: brick maps keep it with their layers (gi/brick.h).
inline const CloudChannel kSurfaceChannel{"__surface", 1};
constexpr int kMostSurfaces = 127;
bool tellsSurfaces(const std::vector<CloudChannel>& channels);
std::vector<CloudChannel> dataOf(std::vector<CloudChannel> channels);  ///< Without kSurfaceChannel.
int widthOf(const std::vector<CloudChannel>& channels);                ///< Floats of one point.

constexpr int kMostWidth = 256;  ///< Floats of a point in a file.

/// As headers of point clouds and brick maps hold them. Reading throws FileError, naming `path`, where they do not add
/// up.
void putChannels(ByteWriter& w, const std::vector<CloudChannel>& channels);
std::vector<CloudChannel> getChannels(ByteReader& r, const std::string& path);

/// What a file was made of, as sums; 0: not known.
struct MadeFrom {
  uint64_t world = 0;   ///< worldSum() of the scene at the start of it all.
  uint64_t inputs = 0;  ///< What was read, and the settings.
};

/// What a cloud needs to know of its channels at every point.
class CloudChannels {
 public:
  CloudChannels() = default;
  CloudChannels(std::vector<CloudChannel> channels)
      : all_(std::move(channels)), width_(widthOf(all_)), tellsSurfaces_(tomales::tellsSurfaces(all_)) {}
  CloudChannels(std::initializer_list<CloudChannel> channels) : CloudChannels(std::vector<CloudChannel>(channels)) {}
  operator const std::vector<CloudChannel>&() const { return all_; }

  int width() const { return width_; }  ///< Floats of one point.
  bool tellsSurfaces() const { return tellsSurfaces_; }
  bool empty() const { return all_.empty(); }
  const CloudChannel& front() const { return all_.front(); }
  auto begin() const { return all_.begin(); }
  auto end() const { return all_.end(); }
  friend bool operator==(const CloudChannels& a, const CloudChannels& b) { return a.all_ == b.all_; }

 private:
  std::vector<CloudChannel> all_;
  int width_ = 0;
  bool tellsSurfaces_ = false;
};

struct PointCloud {
  CloudChannels channels;
  std::vector<vec3> position;
  std::vector<vec3> normal;   ///< Unit; zero: a point of a volume, a sphere.
  std::vector<float> radius;  ///< Of the disk or sphere; 0: infinitesimal.
  std::vector<float> data;    ///< width() floats a point.

  size_t count() const { return position.size(); }
  int width() const { return channels.width(); }
  const float* at(size_t point) const { return data.data() + point * static_cast<size_t>(width()); }
  /// `values`: width() floats.
  void add(const vec3& P, const vec3& N, float r, const float* values);
  int surface(size_t point) const;  ///< Of kSurfaceChannel; 0: not known.
  void reserve(size_t points);
  void clear();          ///< Keeps the channels.
  Bound3 bound() const;  ///< Of the positions.
};

/// First float of a channel among those of a point, -1: there is none of this width (0: of any).
int offsetOf(const std::vector<CloudChannel>& channels, const std::string& name, int width = 0);

/// What files may hold: all finite, no negative radius.
bool isValidPoint(const vec3& P, const vec3& N, float radius, std::span<const float> values);

}  // namespace tomales
