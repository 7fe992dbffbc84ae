// A .dfb opened for a command: edited as the command line asks, its tiles handed out, its light prepared.
#pragma once
#include "gi/icf.h"
#include "reyes/app/frame_job.h"
#include "reyes/app/ray_world.h"

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
  DeepFrame loadAll();
  bool load(size_t index, DeepTile& tile);
  bool recordAnswers(DeepFrame& frame, bool loading, IcfWriter& out);

  std::unique_ptr<DfbFile> file_;
  RenderSettings settings_;
  Stats& stats_;
  Log& log_;
  Shot shot_;
  std::unique_ptr<IcfFile> irradiance_;
  std::unique_ptr<RayWorld> world_;
  std::unique_ptr<FrameJob> job_;
};

}  // namespace tomales
