// Composer: point clouds and brick maps of shaders, bake3d() and texture3d(). Baked points stay in memory until they
// are written. A file that is looked up is opened once. A brick map (.bkm) is then read brick by brick; a point cloud
// (.ptc) is read whole and turned into bricks. Threads: bake() and lookUp() may be called concurrently; write() is
// called after the last of them.
#pragma once
#include <map>
#include <mutex>

#include "gi/brick_map.h"
#include "gi/clouds/diffusion.h"
#include "gi/clouds/disks.h"
#include "reyes/base/log.h"
#include "reyes/cloud_services.h"

namespace tomales {

class CloudFiles final : public CloudServices {
 public:
  /// searchPath: folders separated by colons, for reading. Files are written below outputRoot, if it is not empty.
  explicit CloudFiles(std::string searchPath, std::string outputRoot = {})
      : searchPath_(std::move(searchPath)), outputRoot_(std::move(outputRoot)) {}

  bool bake(const CloudQuery&, const std::vector<CloudValue>&, std::string& problem) override;
  bool lookUp(const CloudQuery&, const std::vector<CloudValue>&, float* found, std::string& problem) override;
  bool photons(const CloudQuery&, const TmPhotonOptions&, TmVec3 E, std::string& problem) override;
  bool occlusion(const CloudQuery&, const DisksQuery&, float* covered, TmVec3 radiance, float* coarse,
                 std::string& problem) override;
  bool subsurface(const CloudQuery&, const TmSubsurfaceOptions&, TmVec3 out, std::string& problem) override;

  /// Tells whether anything has been baked yet.
  bool hasBaked() const;
  /// Writes all baked points as FILE.ptc. The points of a file are sorted by their contents, so that no bit depends on
  /// threads or buckets.
  void write(Log& log);

 private:
  struct Baked {
    PointCloud cloud;
    uint64_t dropped = 0;  ///< Points with values that no file may hold.
  };
  template <class Data>
  struct Opened {
    std::unique_ptr<const Data> data;  ///< Null: it could not be opened.
    std::string problem;
  };
  /// Opens a file. If `photons` is not null, a point cloud is a photon map, and what is opened is the irradiance of its
  /// nearest photons. Brick maps hold irradiance already.
  const Opened<BrickMap>& opened(const std::string& file, const TmPhotonOptions* photons = nullptr);
  /// Opens what `make` makes of all points of a file.
  template <class Data, class Key, class Make>
  const Opened<Data>& openedWhole(std::map<Key, Opened<Data>>& known, const Key& key, const std::string& file,
                                  const Make& make);

  const std::string searchPath_, outputRoot_;
  mutable std::mutex mutex_;
  std::map<std::string, Baked> baked_;
  /// The keys are file, estimator and greatest distance.
  std::map<std::tuple<std::string, int, float>, Opened<BrickMap>> opened_;
  std::map<std::string, Opened<Diffusion>> diffusing_;
  std::map<std::pair<std::string, std::string>, Opened<Disks>> disks_;  ///< The keys are file and channel.
  BrickCache cache_;
};

}  // namespace tomales
