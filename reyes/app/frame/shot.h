// A .dfb opened for a command: it edits the shot as the command line asks, provides its tiles and prepares its light.
#pragma once
#include <set>

#include "reyes/app/frame/frame_stages.h"
#include "reyes/app/frame/light_edits.h"
#include "reyes/app/frame/ray_world.h"
#include "reyes/app/frame/shot_files.h"
#include "reyes/base/stop.h"

namespace tomales {

class ShotJob {
 public:
  /// Returns null if a file cannot be read, which is reported.
  static std::unique_ptr<ShotJob> open(const RenderSettings& settings, Stats& stats, Log& log);
  /// Does the same with files that are open already; one job at a time may use them.
  static std::unique_ptr<ShotJob> open(std::shared_ptr<ShotFiles> files, const RenderSettings& settings, Stats& stats,
                                       Log& log);
  ~ShotJob();
  int frame() const { return shot_.scene.options.frame; }

  /// Runs `tomales shade`.
  void shadePicture();
  /// Runs `tomales gather`.
  void gatherIrradiance();

  /// Prepares for show(): the picture is R G B A Z, and what `more` names as DisplayCall::mode does; it goes to no
  /// file.
  void prepareToShow(const std::string& more = "");
  /// Chooses what show() shows from now on: the direct and bounced light of one group alone, or of all lights if
  /// `lights` is null. Records without shares do not know what a group bounces: then it shows the group's direct light
  /// and, if `indirect`, the bounced light of all lights. `lights` must outlive those calls.
  void choose(const std::string* lights, bool indirect);
  /// Shades tiles that are no picture as show() would.
  void shadeApart(std::span<DeepTile> tiles);
  /// Returns the names of lights and objects whose bounced light is as it was gathered, before an edit of them.
  std::vector<std::string> staleLight() const;
  void show(const PixelRect& window, const ShownTiles& tiles, const RowViewer& viewer, StopToken stop);

  const Shot& shot() const { return shot_; }
  const FrameJob& job() const { return *job_; }  ///< Pre: prepareToShow(), as for the next two.
  const LightEdits& lightEdits() const { return lightEdits_; }
  const std::vector<std::string>& shareGroups() const { return job_->services()->shareGroups(); }

 private:
  ShotJob(std::shared_ptr<ShotFiles> files, const RenderSettings& settings, Stats& stats, Log& log);
  bool edit();
  void prepareLight();
  void prepareShares();
  /// Returns the records that an interrupted run has gathered, with --resume; null if nothing is kept.
  std::unique_ptr<Checkpoint> keptGather() const;
  /// Warns of edits that change bounced light, which records keep as it was when they were gathered.
  void warnOfStaleLight() const;
  /// Drops given records where --crop asks for new ones.
  void dropRecordsOfCrop(std::vector<PreparedCache>& caches) const;
  /// Scales given records to the edited strength of lights, so that they fit beside new ones.
  void takeEdits(std::vector<PreparedCache>& caches) const;
  /// Returns the lights that are stored with the records as those that made them. Where an edit changes more than the
  /// strength of a light, this is the light that made the given records, so that they still count as stale.
  std::vector<std::shared_ptr<LightCall>> lightsOfRecords() const;
  /// Copies the answers of buckets that --crop leaves as they were.
  bool copyAnswers(const std::set<uint32_t>& except, IcfWriter& out);
  std::shared_ptr<const DeepTile> read(size_t index) const;
  bool recordAnswers(IcfWriter& out);

  const std::shared_ptr<ShotFiles> files_;
  RenderSettings settings_;
  Stats& stats_;
  Log& log_;
  Shot shot_;
  std::vector<std::shared_ptr<const Attributes>> attributesOfFile_{};  ///< Before edits; indexed by shade group.
  LightEdits lightEdits_;
  ShownLight shown_;          ///< What choose() has been given.
  bool gathers_ = false;      ///< True if records are made for a file.
  bool gathersAnew_ = false;  ///< True if records are given, and those that --crop shows are gathered anew.
  std::unique_ptr<RayWorld> world_;
  std::unique_ptr<Checkpoint> kept_;
  std::unique_ptr<FrameJob> job_;
};

}  // namespace tomales
