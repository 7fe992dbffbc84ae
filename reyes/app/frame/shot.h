// A .dfb opened for a command: it edits the shot as the command line asks, provides its tiles and prepares its light.
#pragma once
#include <set>

#include "gi/icf.h"
#include "reyes/app/frame/frame_job.h"
#include "reyes/app/frame/ray_world.h"

namespace tomales {

class ShotJob {
 public:
  /// Returns null if the file cannot be read, which is reported.
  static std::unique_ptr<ShotJob> open(const RenderSettings& settings, Stats& stats, Log& log);

  /// Runs `tomales shade`.
  void shadePicture();
  /// Runs `tomales gather`.
  void gatherIrradiance();

 private:
  ShotJob(std::unique_ptr<DfbFile> file, const RenderSettings& settings, Stats& stats, Log& log);
  bool edit();
  bool openIrradiance();
  void prepareLight();
  /// Warns of edits that change bounced light, which records keep as it was when they were gathered.
  void warnOfStaleLight() const;
  /// Returns nothing if the bucket is damaged, which is reported.
  std::optional<DeepTile> load(size_t index);
  std::shared_ptr<const DeepTile> read(size_t index);
  /// Drops the records gathered before where --crop asks for new ones.
  void dropRecordsOfCrop(std::vector<PreparedCache>& caches) const;
  /// Copies the answers of buckets that --crop leaves as they were.
  bool copyAnswers(const std::set<uint32_t>& except, IcfWriter& out);
  bool recordAnswers(IcfWriter& out);

  std::unique_ptr<DfbFile> file_;
  RenderSettings settings_;
  Stats& stats_;
  Log& log_;
  Shot shot_;
  std::unique_ptr<IcfFile> irradiance_;
  std::vector<std::shared_ptr<LightCall>> lightsOfFile_;               ///< Before edits; likewise,
  std::vector<std::shared_ptr<const Attributes>> attributesOfFile_{};  ///< indexed by shade group.
  bool gathersAnew_ = false;  ///< True if records are given, and those that --crop shows are gathered anew.
  std::unique_ptr<ShaderRegistry> shaders_;
  std::unique_ptr<RayWorld> world_;
  std::unique_ptr<FrameJob> job_;
};

}  // namespace tomales
