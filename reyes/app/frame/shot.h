// A .dfb opened for a command: edited as the command line asks, its tiles handed out, its light prepared.
#pragma once
#include <set>

#include "gi/icf.h"
#include "reyes/app/frame/frame_job.h"
#include "reyes/app/frame/ray_world.h"
#include "reyes/app/frame/tile_store.h"

namespace tomales {

class ShotJob {
 public:
  /// Null: the file cannot be read, which is reported.
  static std::unique_ptr<ShotJob> open(const RenderSettings& settings, Stats& stats, Log& log);

  /// `tomales shade`
  void shadePicture();
  /// `tomales gather`
  void gatherIrradiance();

 private:
  ShotJob(std::unique_ptr<DfbFile> file, const RenderSettings& settings, Stats& stats, Log& log);
  bool edit();
  bool openIrradiance();
  void prepareLight();
  /// Nothing: its bucket is damaged, which is reported.
  std::optional<DeepTile> load(size_t index);
  /// What was gathered before goes, where --crop asks for it anew.
  void dropRecordsOfCrop(std::vector<PreparedCache>& caches) const;
  /// Those of buckets that --crop leaves as they were.
  bool copyAnswers(const std::set<uint32_t>& except, IcfWriter& out);
  bool recordAnswers(TileStore& tiles, IcfWriter& out);

  std::unique_ptr<DfbFile> file_;
  RenderSettings settings_;
  Stats& stats_;
  Log& log_;
  Shot shot_;
  std::unique_ptr<IcfFile> irradiance_;
  bool gathersAnew_ = false;  ///< What --crop shows, with records of elsewhere given.
  std::unique_ptr<RayWorld> world_;
  std::unique_ptr<FrameJob> job_;
};

}  // namespace tomales
