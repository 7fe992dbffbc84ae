// A frame that is prepared: its shaders are bound, and rays and global illumination are built if the scene asks for
// them. Its stages are hiding (frame_stages.h), light (frame_light.h) and the picture (frame_picture.h).
#pragma once
#include <chrono>

#include "gi/clouds.h"
#include "reyes/app/frame/error_model.h"
#include "reyes/app/frame/frame_meter.h"
#include "reyes/app/frame/kept_frame.h"
#include "reyes/app/settings.h"
#include "reyes/base/stats.h"
#include "reyes/frame.h"
#include "reyes/shader_registry.h"

namespace tomales {

class Preview;

class FrameJob {
 public:
  /// Pre: overrides have been applied to the scene. `shaders` outlives the job. Everything that goes wrong is in the
  /// log.
  FrameJob(Scene& scene, ShaderRegistry& shaders, const RenderSettings& settings, Stats& stats, Log& log);
  ~FrameJob();

  /// Sets the shares of the progress at which hiding and gathering are finished, for commands that leave out a stage.
  void setShares(float hidden, float gathered) { meter_.setShares(hidden, gathered); }
  /// Reads all procedurals that are still closed. Call it before hiding if tiles are written or shaded one by one:
  /// hiding then meets no new shade groups.
  void openAll();
  /// Finds the openings to the sky for a scene that goes to a file, by rays that are dropped. Call it after openAll().
  void findOpenings();
  /// Keeps what is gathered and shaded for a later run, and takes over the work of an interrupted one. Call it before
  /// rays are prepared. With null nothing is kept.
  void useCheckpoint(Checkpoint* kept) { kept_ = kept; }
  /// Prepares rays against the scene itself.
  void prepareRays();
  /// Prepares rays against what `rays` provides when the first ray is wanted: for scenes without geometry.
  void prepareRays(RaySource rays);
  /// Forgets what was gathered; light is gathered and shaded by these settings from now on.
  void setQuality(const LightQuality& quality);
  void setLightSamples(int lightSamples) { quality_.lightSamples = lightSamples; }
  const LightQuality& quality() const { return quality_; }

  /// Tells whether irradiance is gathered at points of the picture.
  bool gathers() const { return gathers_; }
  /// Tells whether photons are counted at points of the picture.
  bool counts() const { return counts_; }
  /// Tells whether light has to be gathered or counted, if records are given or if not.
  bool gathersBeside(bool recordsGiven) const { return counts_ || (gathers_ && !recordsGiven); }
  const GiMethod& method() const { return *method_; }
  GiMode mode() const { return method_->mode; }
  GiSettings giSettings() const;
  ShadeContext shadeContext() const;

  Scene& scene() { return scene_; }
  const RenderSettings& settings() const { return settings_; }
  Stats& stats() { return stats_; }
  Log& log() { return log_; }
  const Camera& camera() const { return camera_; }
  ShadingSystem& shading() const { return *shading_; }
  GiServices* services() const { return services_.get(); }
  Checkpoint* kept() const { return kept_; }
  CloudFiles& clouds() { return clouds_; }
  /// Returns null if nothing traces rays, or if rays are prepared against another source than the scene.
  const RayScene* rays() const { return rays_.get(); }
  /// Returns null if nothing traces rays. Pre: prepareRays().
  const RayTools* rayTools() const { return raySource_ ? raySource_() : nullptr; }

  FrameMeter& meter() { return meter_; }
  /// Seconds since the frame began to be read.
  double elapsed_s() const;
  /// Returns the viewer of the picture, which it opens; null if none is wanted.
  Preview* preview(const DeepFrame& layout);
  void closePreview();
  /// The file of a coarse picture for those who stop before the frame is finished; empty if there is none.
  const std::string& sketchFile() const { return sketchFile_; }
  void setSketchFile(std::string file) { sketchFile_ = std::move(file); }

 private:
  void warnAboutPixels() const;
  bool traces() const { return mode() != GiMode::None || shading_->needsRays(); }
  /// Reads what rays may meet, on screen or not, before the first ray, which may go anywhere, and keeps it.
  void open(const std::function<bool(const Attributes&)>& wanted);
  int referenceLightSamples() const;

  Scene& scene_;
  const RenderSettings& settings_;
  Stats& stats_;
  Log& log_;
  LightQuality quality_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool gathers_ = false, counts_ = false;
  const Camera camera_;
  FrameMeter meter_;
  CloudFiles clouds_;
  Checkpoint* kept_ = nullptr;
  std::unique_ptr<ShadingSystem> shading_;
  const GiMethod* method_ = nullptr;  ///< The method that the lights ask for, once they are bound.
  std::unique_ptr<RayScene> rays_;
  RaySource raySource_;
  std::unique_ptr<GiServices> services_;
  std::unique_ptr<Preview> preview_;
  std::string sketchFile_;
};

}  // namespace tomales
