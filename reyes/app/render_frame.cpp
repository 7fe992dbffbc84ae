#include "reyes/app/render_frame.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <mutex>

#include "gi/icf.h"
#include "reyes/app/frame_job.h"
#include "reyes/app/hide.h"
#include "reyes/app/interrupt.h"
#include "reyes/app/tile_store.h"

namespace tomales {
namespace {

constexpr int64_t kBytesOfTilePixel = 64;   ///< Of a shaded tile without its points and variables,
constexpr int64_t kBytesOfPoints = 192;     ///< and of its points; all for shading rate 1.
constexpr int64_t kBytesOfBucket = 96;      ///< Of lists of what is where.
constexpr int64_t kRowsInMemory = 128;      ///< Of pixels, while a picture is made row by row.
constexpr int64_t kUsualLimit = int64_t{1} << 31;

int64_t pixelsOf(const Scene& scene) {
  const PixelRect crop = Camera(scene.options).crop();
  return int64_t{crop.width()} * crop.height();
}

int64_t bytesOfTilePixel(const Scene& scene) {
  return kBytesOfTilePixel + outputOf(scene.options).floatsPerPoint * static_cast<int64_t>(sizeof(float));
}

/// A frame that cannot fit must not take the machine down with it.
bool fitsMemory(const Scene& scene, const DeepFrame& layout, Log& log) {
  const int64_t needed = layout.padded.width() * kRowsInMemory * bytesOfTilePixel(scene) +
                         static_cast<int64_t>(layout.tileCount()) * kBytesOfBucket;
  const int64_t there = int64_t{::sysconf(_SC_PHYS_PAGES)} * ::sysconf(_SC_PAGESIZE);
  if (needed < there && static_cast<int64_t>(layout.tileCount()) < kMostTiles) return true;
  log.report(Severity::Output, "frame-too-large", {},
             fmt::format("a frame of {} million pixels in {} buckets needs about {} GB, and the machine has {}: render it in parts with "
                         "--crop, or in larger buckets with --bucket-size",
                         pixelsOf(scene) / 1000000, layout.tileCount(), needed >> 30, there >> 30));
  return false;
}

/// Hidden buckets in a file beside the picture: with --resume all of them, those of an interrupted run among them; else those that
/// memory does not hold, in a file that is gone when the program is.
class BucketFile {
 public:
  BucketFile(const Scene& scene, int world, const RenderSettings& settings, Log& log)
      : picture_(scene.options.displays.front().name), layout_(layOutFrame(scene)), log_(log), resumes_(settings.resume) {
    if (!resumes_) return;
    const Shot shot{scene, layout_, settings.seed, sourcesOf(settings.files), std::filesystem::current_path().string(), world};
    std::string error;
    file_ = DfbWriter::create(picture_ + ".dfb", shot, true, error);
    if (!file_)
      log.report(Severity::Warning, "resume", {}, "buckets cannot be kept for --resume: " + error);
    else
      log.report(Severity::Info, "resume", {}, fmt::format("{} of {} buckets were finished before", file_->tilesKept(), layout_.tileCount()));
  }

  std::optional<DeepTile> tile(size_t index) const { return file_ ? file_->tile(index) : std::nullopt; }

  void keepForResume(size_t index, const DeepTile& tile) {
    if (resumes_ && file_ && !file_->has(index) && !file_->write(index, tile))
      log_.report(Severity::Warning, "resume", {}, "buckets cannot be kept for --resume: " + file_->error());
  }

  void spill(size_t index, const DeepTile& tile) {
    std::string error;
    {
      const std::lock_guard lock(opening_);
      if (!file_) file_ = openUnnamed(error);
    }
    if (!file_ || (!file_->has(index) && !file_->write(index, tile)))
      log_.report(Severity::Output, "spill", {},
                  "the frame's buckets do not fit into memory, nor into a file beside \"" + picture_ + "\", and some are left out: " +
                      (file_ ? file_->error() : error));
    ++spilled_;
  }
  int64_t spilled() const { return spilled_; }

  /// The picture is written: nothing is left to resume.
  void forget() {
    std::error_code problem;
    if (file_) std::filesystem::remove(file_->temporary(), problem);
  }

 private:
  std::unique_ptr<DfbWriter> openUnnamed(std::string& error) const {
    Shot layoutAlone;
    layoutAlone.frame = layout_;
    auto file = DfbWriter::create(fmt::format("{}.{}.dfb", picture_, ::getpid()), layoutAlone, false, error);
    std::error_code problem;
    if (file) std::filesystem::remove(file->temporary(), problem);
    return file;
  }

  const std::string picture_;
  const DeepFrame layout_;
  Log& log_;
  const bool resumes_;
  std::mutex opening_;
  std::unique_ptr<DfbWriter> file_;
  std::atomic<int64_t> spilled_{0};
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
  const DeepFrame layout = layOutFrame(scene);
  if (!displaysHaveFolders(scene.options, log) || !fitsMemory(scene, layout, log)) return;
  checkDisplays(scene.options, log);
  FrameJob job(scene, settings, stats, log);
  const bool given = !settings.irradiance.empty(), gathers = job.gathers() && (!given || settings.appendIrradiance);
  const int64_t limit_bytes = settings.memoryLimit.value_or(kUsualLimit);
  const bool streams = !gathers && pixelsOf(scene) * (bytesOfTilePixel(scene) + kBytesOfPoints) > limit_bytes;

  if (streams || given || settings.resume) job.openAll();
  BucketFile file(scene, world, settings, log);
  const auto find = [&](size_t i) { return file.tile(i); };
  if (streams || given) job.prepareRays();
  if (given && job.services() && !useIrradiance(scene, settings, *job.services(), log)) return;
  if (streams) {
    job.hideAndWrite(layout, find, [&](size_t i, const DeepTile& tile) { file.keepForResume(i, tile); });
  } else {
    TileStore store(layout.tileCount(), limit_bytes, find);
    const TileSink sink{{}, [&](size_t i, DeepTile&& tile) {
                          file.keepForResume(i, tile);
                          if (!store.keep(i, tile)) file.spill(i, tile);
                        }, find};
    job.hide(layout, sink);
    afterStage();
    if (!given) job.prepareRays();
    if (gathers) job.gather(layout, store.reader());
    afterStage();
    job.write(layout, [&](size_t i) { return store.take(i); });
  }
  if (settings.memoryLimit)
    log.report(Severity::Info, "memory-limit", {},
               streams ? "--memory-limit: the picture is made row by row, and the buckets of earlier rows are dropped"
                       : fmt::format("--memory-limit: {} of {} buckets rest in a file", file.spilled(), layout.tileCount()));
  if (!interrupted() && log.worst() != Severity::Output) file.forget();
}

}  // namespace tomales
