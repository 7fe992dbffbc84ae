// One frame through the stages, in the order of its members; rays and global illumination are built if the scene asks
// for them.
#pragma once
#include "gi/clouds.h"
#include "reyes/app/settings.h"
#include "reyes/app/watch/progress.h"
#include "reyes/base/stats.h"
#include "reyes/frame.h"
#include "reyes/shader_registry.h"

namespace tomales {

class Preview;

class FrameJob {
 public:
  /// Pre: overrides have been applied to the scene. Everything that goes wrong is in the log.
  FrameJob(Scene& scene, const RenderSettings& settings, Stats& stats, Log& log);
  ~FrameJob();

  /// Reads all procedurals that are still closed. Before `hide` where tiles leave it one by one, in a file or shaded:
  /// it then finds no shade groups on its way.
  void openAll();
  /// All buckets; opens what it needs. False: interrupted.
  bool hide(const DeepFrame& layout, const TileSink& sink);
  /// Rays against the scene itself.
  void prepareRays();
  /// Rays against what `rays` brings when the first is wanted: for scenes without geometry.
  void prepareRays(RaySource rays);
  void gather(const DeepFrame& layout, const TileReader& tiles);
  /// Some tiles. False: interrupted.
  bool shade(std::span<const uint32_t> tiles, const ShadeSteps& steps);
  /// The picture, of tiles that are shaded as its rows need them. They must not be interrupted any more if hiding was.
  void write(const DeepFrame& layout, const std::function<std::optional<DeepTile>(size_t tile)>& load);
  /// The picture, of tiles that are hidden and shaded as its rows need them. `find`: what an interrupted run has left;
  /// `keep`: what this one leaves.
  void hideAndWrite(const DeepFrame& layout, const std::function<std::optional<DeepTile>(size_t tile)>& find,
                    const std::function<void(size_t tile, const DeepTile&)>& keep);

  bool gathers() const { return gathers_; }
  /// Warns if records that stand in for a gather pass were made without one. file: where they come from.
  void checkRecords(const GiSettings& gathered, const std::string& file) const;
  const GiMethod& method() const { return *method_; }
  const Camera& camera() const { return camera_; }
  GiSettings giSettings() const;
  GiServices* services() { return services_.get(); }
  ShadingSystem& shading() { return *shading_; }
  FrameControl control(float begin, float end);
  /// Is told how far the maps are that indirect light is made of before anything is gathered.
  std::function<void(float)> lightProgress() { return meter_.stage(kHidden, kLightMade); }

 private:
  /// Shares of a frame that are done when its stages end.
  static constexpr float kHidden = 0.3f, kLightMade = 0.5f, kGathered = 0.7f;
  bool makesLight() const { return mode() == GiMode::Atlas || mode() == GiMode::Radiosity; }
  void warnAboutPixels() const;
  GiMode mode() const { return method_->mode; }
  bool traces() const { return mode() != GiMode::None || shading_->needsRays(); }
  /// A ray may go anywhere, so what rays may meet is read before the first of them, on screen or not, and kept.
  void open(const std::function<bool(const Attributes&)>& wanted);
  int referenceLightSamples() const;
  ShadeContext shadeContext() const;
  /// A shaded tile, for the rows of the picture.
  void place(size_t index, DeepTile&& tile, const TilePlace& put) const;
  void finish(DeepFrame& frame, const TileFill& fill);
  /// Opens a viewer's picture if there is to be one.
  void openPreview(const DeepFrame& layout);

  Scene& scene_;
  const RenderSettings& settings_;
  Stats& stats_;
  Log& log_;
  bool gathers_ = false;
  const Camera camera_;
  ShaderRegistry registry_;
  ProgressMeter meter_;
  CloudFiles clouds_;
  std::unique_ptr<ShadingSystem> shading_;
  const GiMethod* method_ = nullptr;  ///< As the lights ask, once they are bound.
  std::unique_ptr<RayScene> rays_;
  RaySource raySource_;
  std::unique_ptr<GiServices> services_;
  std::unique_ptr<Preview> preview_;
};

/// Hours of rendering must not end at a folder that never existed. False: reported.
bool hasFolder(const std::string& file, const SourceLoc& where, Log& log);
/// Only if it is relative: scenes of modellers name folders of their project. One that cannot be made is found out when
/// the file is written.
void makeFolderOf(const std::string& file);
/// Makes those that are relative. What goes to display drivers needs none.
bool displaysHaveFolders(const Options& options, const PluginTrust& trust, Log& log);

}  // namespace tomales
