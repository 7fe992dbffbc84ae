#include "reyes/app/render_frame.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "gi/icf.h"
#include "reyes/app/frame_job.h"
#include "reyes/app/hide.h"
#include "reyes/app/interrupt.h"

namespace tomales {
namespace {

constexpr int64_t kBytesOfTilePixel = 64;  ///< Of a shaded tile without its points and variables,
constexpr int64_t kBytesOfPoints = 192;    ///< and of its points; all for shading rate 1.
constexpr int64_t kUsualLimit = int64_t{1} << 31;

int64_t pixelsOf(const Scene& scene) {
  const PixelRect crop = Camera(scene.options).crop();
  return int64_t{crop.width()} * crop.height();
}

int64_t bytesOfTilePixel(const Scene& scene) {
  return kBytesOfTilePixel + outputOf(scene.options).floatsPerPoint * static_cast<int64_t>(sizeof(float));
}

/// A frame that cannot fit must not take the machine down with it.
bool fitsMemory(const Scene& scene, Log& log) {
  const int64_t needed = pixelsOf(scene) * bytesOfTilePixel(scene);
  const int64_t there = int64_t{::sysconf(_SC_PHYS_PAGES)} * ::sysconf(_SC_PAGESIZE);
  if (needed < there) return true;
  log.report(Severity::Output, "frame-too-large", {},
             fmt::format("a frame of {} million pixels needs about {} GB, and the machine has {}: render it in parts with --crop",
                         pixelsOf(scene) / 1000000, needed >> 30, there >> 30));
  return false;
}

/// The buckets of an interrupted run, and those that this one finishes.
class Checkpoint {
 public:
  Checkpoint(const Scene& scene, int world, const RenderSettings& settings, Log& log) : log_(log) {
    if (!settings.resume) return;
    const Shot shot{scene, layOutFrame(scene), settings.seed, sourcesOf(settings.files), std::filesystem::current_path().string(), world};
    std::string error;
    file_ = DfbWriter::create(scene.options.displays.front().name + ".dfb", shot, true, error);
    if (!file_)
      log.report(Severity::Warning, "resume", {}, "buckets cannot be kept for --resume: " + error);
    else
      log.report(Severity::Info, "resume", {}, fmt::format("{} of {} buckets were finished before", file_->tilesKept(), shot.frame.tiles.size()));
  }
  std::optional<DeepTile> tile(size_t index) const { return file_ ? file_->tile(index) : std::nullopt; }
  void keep(size_t index, const DeepTile& tile) {
    if (file_ && !file_->has(index) && !file_->write(index, tile))
      log_.report(Severity::Warning, "resume", {}, "buckets cannot be kept for --resume: " + file_->error());
  }
  /// The picture is written: nothing is left to resume.
  void forget() {
    std::error_code problem;
    if (file_) std::filesystem::remove(file_->temporary(), problem);
  }

 private:
  Log& log_;
  std::unique_ptr<DfbWriter> file_;
};

/// False: the file cannot be read, which is reported.
bool useIrradiance(const Scene& scene, const RenderSettings& settings, GiServices& services, Log& log) {
  std::string error;
  const auto file = IcfFile::open(settings.irradiance, error);
  if (!file) {
    log.report(Severity::Error, "icf-read", {std::make_shared<std::string>(settings.irradiance), 0},
               "cannot be read as an irradiance cache: " + error);
    return false;
  }
  IrradianceShot given = file->takeShot();
  moveToCamera(given, scene.cameraFromWorldAtOpen());
  services.useCaches(std::move(given.caches));
  return true;
}

}  // namespace

void renderFrame(Scene& scene, int world, const RenderSettings& settings, Stats& stats, Log& log,
                 const std::function<void()>& afterStage) {
  if (!displaysHaveFolders(scene.options, log) || !fitsMemory(scene, log)) return;
  checkDisplays(scene.options, log);
  DeepFrame frame = layOutFrame(scene);
  FrameJob job(scene, settings, stats, log);
  const bool given = !settings.irradiance.empty(), gathers = job.gathers() && (!given || settings.appendIrradiance);
  const bool streams = !gathers && pixelsOf(scene) * (bytesOfTilePixel(scene) + kBytesOfPoints) > settings.memoryLimit.value_or(kUsualLimit);
  if (settings.memoryLimit)
    log.report(Severity::Info, "memory-limit", {},
               streams ? "--memory-limit: buckets are shaded as they are hidden, and their points dropped"
                       : "--memory-limit: the frame is kept whole" + std::string(gathers ? ", because the gather pass walks over all of it" : ""));

  if (streams || given || settings.resume) job.openAll();
  Checkpoint checkpoint(scene, world, settings, log);
  if (streams || given) job.prepareRays();
  if (given && job.services() && !useIrradiance(scene, settings, *job.services(), log)) return;
  const DeepFrame layout = frame;
  const TileSink sink{{}, [&](size_t i, DeepTile&& tile) {
                        checkpoint.keep(i, tile);
                        if (streams) job.shadeTile(tile);
                        frame.tiles[i] = std::move(tile);
                      }, [&](size_t i) { return checkpoint.tile(i); }};
  frame.complete = job.hide(layout, sink);
  afterStage();
  if (!streams) {
    if (!given) job.prepareRays();
    if (gathers) job.gather(frame);
    afterStage();
    job.shade(frame);
  }
  afterStage();
  job.write(frame);
  if (frame.complete && !interrupted() && log.worst() != Severity::Output) checkpoint.forget();
}

}  // namespace tomales
