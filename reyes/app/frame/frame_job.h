// Takes one frame through the stages, in the order of its members. Rays and global illumination are built if the scene
// asks for them.
#pragma once
#include <chrono>

#include "gi/clouds.h"
#include "reyes/app/frame/audit.h"
#include "reyes/app/frame/error_model.h"
#include "reyes/app/frame/kept_frame.h"
#include "reyes/app/settings.h"
#include "reyes/app/watch/progress.h"
#include "reyes/base/stats.h"
#include "reyes/frame.h"
#include "reyes/shader_registry.h"

namespace tomales {

class Preview;

/// The part of the frame that FrameJob::show() makes.
struct ShownPart {
  PixelRect window;                     ///< Inside of the frame's crop window.
  const std::string* lights = nullptr;  ///< ShadeContext::lights.
  bool indirect = true;
};

/// The tiles of FrameJob::show(), from any thread.
struct ShownTiles {
  std::function<bool(size_t index, DeepTile& tile)> load;  ///< See ShadeSteps::load.
  std::function<void(size_t index, const DeepTile& tile)> shaded;
};

class FrameJob {
 public:
  /// Pre: overrides have been applied to the scene. `shaders` outlives the job. Everything that goes wrong is in the
  /// log.
  FrameJob(Scene& scene, ShaderRegistry& shaders, const RenderSettings& settings, Stats& stats, Log& log);
  ~FrameJob();

  /// Sets the shares of the progress at which all is hidden, and then gathered, for commands that do not do it all.
  void setShares(float hidden, float gathered) {
    hidden_ = hidden;
    gathered_ = gathered;
  }
  /// Reads all procedurals that are still closed. Call it before `hide` if tiles leave that one by one, to a file or
  /// shaded: it then finds no new shade groups on its way.
  void openAll();
  /// Finds the openings to the sky for a scene that goes to a file, by rays that are dropped. Call it after openAll().
  void findOpenings();
  /// Hides all buckets and opens what it needs. Returns false if it was interrupted.
  bool hide(const DeepFrame& layout, const TileSink& sink);
  /// Keeps what is gathered and shaded for a later run, and takes over what an interrupted one has. Call it before rays
  /// are prepared. Null: nothing is kept.
  void keepWork(KeptWork* kept) { kept_ = kept; }
  /// Prepares rays against the scene itself.
  void prepareRays();
  /// Prepares rays against what `rays` provides when the first ray is wanted: for scenes without geometry.
  void prepareRays(RaySource rays);
  /// Gathers what the picture needs, and measures and tells its error, as the command line asks: with settings of the
  /// program's own choice where that names an error to reach. `gathers`: false if records are given.
  void light(const DeepFrame& layout, const TileReader& tiles, bool gathers);

  // The steps of light(), which may be repeated.
  /// Forgets what was gathered; light is gathered and shaded by these settings from now on.
  void setQuality(const LightQuality& quality);
  void setLightSamples(int lightSamples) { quality_.lightSamples = lightSamples; }
  /// Writes a coarse picture of the whole frame beside the first Display's file, in direct light, for those who stop
  /// before it is finished. It is removed when the Displays are written.
  void writeSketch(const DeepFrame& layout, const TileReader& tiles);
  /// Seconds since the frame began to be read.
  double elapsed_s() const;
  /// Gathers, warns of what the records show, and keeps light for later frames if the command line asks for it.
  void gather(const DeepFrame& layout, const TileReader& tiles);
  /// The first part of it, for records that may be gathered again: what is there is shown.
  void gatherShown(const DeepFrame& layout, const TileReader& tiles);
  /// The rest of it, for those that stay.
  void endGather(const DeepFrame& layout, const TileReader& tiles);
  void gatherRecords(const DeepFrame& layout, const TileReader& tiles, const std::function<void(float)>& progress = {},
                     const std::function<void(int)>& covered = {});
  /// Returns the plan that `--audit` asks for, at pixels that this seed decides.
  AuditPlan auditPlan(uint32_t seed) const;
  /// Measures the error of the picture that write() will make. The tiles are read once.
  AuditReport audit(const DeepFrame& layout, const TileReader& tiles, uint32_t seed);
  /// Tells it: by a message, and in the headers of the Displays and the statistics.
  void tellAudit(const AuditReport& report);
  /// Shades some tiles. Returns false if it was interrupted.
  bool shade(std::span<const uint32_t> tiles, const ShadeSteps& steps);
  /// Writes the picture, from tiles that are shaded as its rows need them. If hiding was interrupted, it is not again.
  void write(const DeepFrame& layout, const std::function<std::optional<DeepTile>(size_t tile)>& load);
  /// Writes the picture, from tiles that are hidden and shaded as its rows need them. `find` returns the tiles of an
  /// interrupted run; `keep` keeps those of this one.
  void hideAndWrite(const DeepFrame& layout, const std::function<std::optional<DeepTile>(size_t tile)>& find,
                    const std::function<void(size_t tile, const DeepTile&)>& keep);

  /// Shades a part of the picture for the viewer alone, before exposure and imager. It can be called again and again,
  /// and needs no write(). If it is cancelled, the viewer may get no rows.
  void show(const DeepFrame& layout, const ShownTiles& tiles, const ShownPart& part, const RowViewer& viewer,
            const std::atomic<bool>& cancelled);

  /// Shades tiles that are no picture, in the light of ShownPart.
  void shadeApart(std::span<DeepTile> tiles, const std::string* lights, bool indirect);

  bool gathers() const { return gathers_; }
  /// Tells whether gather() has to run, where records are given or not.
  bool gathersBeside(bool recordsGiven) const { return counts_ || (gathers_ && !recordsGiven); }
  /// Warns if records that stand in for a gather pass were made without one. `file` is where they come from.
  void checkRecords(const GiSettings& gathered, const std::string& file) const;
  const GiMethod& method() const { return *method_; }
  Scene& scene() { return scene_; }
  const Camera& camera() const { return camera_; }
  GiSettings giSettings() const;
  ShadeContext shadeContext() const;
  GiServices* services() const { return services_.get(); }
  ShadingSystem& shading() const { return *shading_; }
  /// Returns null if nothing traces rays. Pre: prepareRays().
  const RayTools* rayTools() const { return raySource_ ? raySource_() : nullptr; }
  FrameControl control(const char* pass, float begin, float end);
  /// Returns a callback for the progress of the maps that indirect light needs before anything is gathered.
  std::function<void(float)> lightProgress() { return meter_.pass("making maps of light", hidden_, lightMade()); }

 private:
  float lightMade() const { return 0.5f * (hidden_ + gathered_); }
  bool makesLight() const { return mode() == GiMode::Atlas || mode() == GiMode::Radiosity; }
  void warnAboutPixels() const;
  GiMode mode() const { return method_->mode; }
  bool traces() const { return mode() != GiMode::None || shading_->needsRays(); }
  /// Reads what rays may meet, on screen or not, before the first ray, which may go anywhere, and keeps it.
  void open(const std::function<bool(const Attributes&)>& wanted);
  int referenceLightSamples() const;
  bool steersLight() const;
  /// Keeps the colours of a tile that is shaded as the finished picture has it. A tile that is not shaded again bakes
  /// nothing, so no tile is kept once anything has been baked.
  void keepShaded(size_t index, const DeepTile& tile) const {
    if (!clouds_.hasBaked()) tomales::keepShaded(kept_, index, tile);
  }
  /// Prepares tellNoise(), if a Display shows it.
  void beginNoise();
  /// Stores how far another draw of all noise is from the colours of a shaded tile (VariableSource::Noise).
  void tellNoise(DeepTile& tile) const;
  /// Puts a shaded tile where the rows of the picture find it.
  void place(size_t index, DeepTile&& tile, const TilePlace& put) const;
  void finish(DeepFrame& frame, const TileFill& fill);
  /// Opens a viewer's picture if there is to be one.
  void openPreview(const DeepFrame& layout);

  Scene& scene_;
  const RenderSettings& settings_;
  Stats& stats_;
  Log& log_;
  LightQuality quality_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool gathers_ = false;
  int noise_ = -1;       ///< First of the arrays of ShadedPoints::variables that show noise; negative: none do.
  bool counts_ = false;  ///< Photons are counted at visible points.
  const Camera camera_;
  ProgressMeter meter_;
  float hidden_ = 0.3f, gathered_ = 0.7f;
  CloudFiles clouds_;
  KeptWork* kept_ = nullptr;
  std::unique_ptr<ShadingSystem> shading_;
  const GiMethod* method_ = nullptr;  ///< The method that the lights ask for, once they are bound.
  std::unique_ptr<RayScene> rays_;
  RaySource raySource_;
  std::unique_ptr<GiServices> services_;
  std::unique_ptr<Preview> preview_;
  std::string sketchFile_;  ///< Empty if there is none.
};

}  // namespace tomales
