// Noun: a point cloud on disk (.ptc), the one container for photons, irradiance points and baked data. It is written as
// a stream and read chunk by chunk, so that neither needs the whole cloud in memory.
//   points chunk    at most kChunkPoints points: positions, normals (octahedral, 2 x 16 bits; 0: none), radii, data
//   header          channels, the count of points, the bound of every chunk, MadeFrom, and a sum of the points
// Threads: a reader may be shared; a writer belongs to one thread.
#pragma once
#include "gi/point_cloud.h"
#include "reyes/base/chunk_file.h"
#include "reyes/base/pack.h"

namespace tomales {

class PointFileWriter {
 public:
  static constexpr size_t kChunkPoints = 1 << 14;

  /// Throws FileError, like every member.
  PointFileWriter(const std::string& path, const std::vector<CloudChannel>& channels);
  /// Adds a point; one that isValidPoint() refuses is left out.
  void add(const vec3& P, const vec3& N, float radius, const float* values);
  /// Adds at most kChunkPoints valid points, as a chunk of their own.
  void addChunk(const PointCloud& points);
  const std::vector<CloudChannel>& channels() const { return pending_.channels; }
  size_t count() const { return written_ + pending_.count(); }
  void finish(const MadeFrom& madeFrom = {});

 private:
  ChunkWriter file_;
  ContentSum contents_;
  PointCloud pending_;
  size_t written_ = 0;
  std::vector<Bound3> bounds_;
};

class PointFile {
 public:
  explicit PointFile(const std::string& path);  ///< Throws FileError.
  const std::vector<CloudChannel>& channels() const { return channels_; }
  int width() const { return width_; }  ///< Floats of one point's data.
  uint64_t count() const { return count_; }
  const MadeFrom& madeFrom() const { return madeFrom_; }
  uint64_t contents() const { return contents_; }  ///< Checksum of the channels and points, in their order.
  Bound3 bound() const;
  size_t chunkCount() const { return bounds_.size(); }
  const Bound3& chunkBound(size_t chunk) const { return bounds_[chunk]; }
  void read(size_t chunk, PointCloud& to) const;  ///< Appends to `to`; throws FileError.
  PointCloud readAll() const;
  const std::string& path() const { return file_.path(); }
  uint64_t fileBytes() const { return file_.fileBytes(); }

 private:
  ChunkReader file_;
  std::vector<CloudChannel> channels_;
  int width_ = 0;
  uint64_t count_ = 0, contents_ = 0;
  MadeFrom madeFrom_;
  std::vector<Bound3> bounds_;
};

/// Writes a cloud, sorted along a Morton curve, so that chunks are compact in space. Throws FileError.
void writePointFile(const PointCloud& cloud, const std::string& path, const MadeFrom& madeFrom = {});

}  // namespace tomales
