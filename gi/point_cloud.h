// Noun: a point cloud of oriented disks with any channels of data: photons, irradiance points and baked surfaces alike.
// Each point has a position, a normal, a radius and `width()` floats of data, channel after channel.
// Space: world, unless a file's header says otherwise (PRMan's bake3d "coordsystem"). It needs reyes/base alone.
// Threads: plain data.
#pragma once
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "reyes/base/chunk_file.h"
#include "reyes/base/pack.h"

namespace tomales {

struct CloudChannel {
  std::string name;
  int width = 1;  ///< Floats of one point.
  bool operator==(const CloudChannel&) const = default;
};

/// The last channel of clouds that tell surfaces apart: the number of the surface that a point lies on, 1 ..
/// kMostSurfaces; 0: not known; kAcrossWalls: a wall on the surface separates more light from less there. It is no
/// data: brick maps keep it with their layers (gi/bricks/brick.h).
inline const CloudChannel kSurfaceChannel{"__surface", 1};
constexpr int kMostSurfaces = 126, kAcrossWalls = kMostSurfaces + 1;
bool tellsSurfaces(const std::vector<CloudChannel>& channels);
std::vector<CloudChannel> dataOf(std::vector<CloudChannel> channels);  ///< The channels without kSurfaceChannel.
int widthOf(const std::vector<CloudChannel>& channels);                ///< Floats of one point.

constexpr int kMostWidth = 256;  ///< Floats of a point in a file.

/// Writes and reads channels as the headers of point clouds and brick maps hold them. Reading throws FileError, naming
/// `path`, where they are inconsistent.
void putChannels(Packer& w, const std::vector<CloudChannel>& channels);
std::vector<CloudChannel> getChannels(Unpacker& r, const std::string& path);

/// Checksums of what a file was made from; 0: not known.
struct MadeFrom {
  uint64_t world = 0;   ///< worldSum() of the scene that the light was traced in.
  uint64_t inputs = 0;  ///< Sum of the input files and of the settings.
};
template <class A>
void fields(A& a, MadeFrom& x) {
  auto& [world, inputs] = x;
  each(a, world, inputs);
}

/// Channels, with the facts about them that a cloud needs for every point.
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
  std::vector<float> radius;  ///< Radius of the disk or sphere; 0: infinitesimal.
  std::vector<float> data;    ///< width() floats for each point.

  size_t count() const { return position.size(); }
  int width() const { return channels.width(); }
  const float* at(size_t point) const { return data.data() + point * static_cast<size_t>(width()); }
  /// `values`: width() floats.
  void add(const vec3& P, const vec3& N, float r, const float* values);
  int surface(size_t point) const;  ///< Value of kSurfaceChannel; 0: not known.
  void reserve(size_t points);
  void clear();          ///< Keeps the channels.
  Bound3 bound() const;  ///< Bound of the positions.
};

/// Returns the offset of a channel's first float among those of a point; -1: there is none of this width (0: any
/// width).
int offsetOf(const std::vector<CloudChannel>& channels, const std::string& name, int width = 0);

/// Tells whether a file may hold this point: all values have to be finite, and the radius not negative.
bool isValidPoint(const vec3& P, const vec3& N, float radius, std::span<const float> values);

}  // namespace tomales
