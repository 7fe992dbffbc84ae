#include "reyes/app/frame/render_frame.h"

#include <fmt/format.h>
#include <unistd.h>

#include "gi/icf.h"
#include "reyes/app/frame/bucket_file.h"
#include "reyes/app/frame/empty_frame.h"
#include "reyes/app/frame/frame_light.h"
#include "reyes/app/frame/frame_picture.h"
#include "reyes/app/frame/frame_stages.h"
#include "reyes/app/frame/outputs.h"
#include "reyes/app/frame/provenance.h"
#include "reyes/app/frame/tile_store.h"
#include "reyes/app/frame/unused_options.h"
#include "reyes/base/process.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

/// Memory in bytes for a pixel of a shaded tile at shading rate 1, without its points and variables.
constexpr int64_t kBytesOfTilePixel = 64;
constexpr int64_t kBytesOfPoints = 192;  ///< Memory for its points at shading rate 1.
constexpr int64_t kBytesOfBucket = 96;   ///< Memory for each bucket's place in lists.
constexpr int64_t kRowsInMemory = 128;   ///< Rows of pixels in memory, while a picture is made row by row.
constexpr int64_t kUsualLimit = int64_t{1} << 30;

int64_t pixelsOf(const Scene& scene) {
  const PixelRect crop = Camera(scene.options).crop();
  return int64_t{crop.width()} * crop.height();
}

int64_t bytesOfTilePixel(const Scene& scene) {
  return kBytesOfTilePixel + outputOf(scene.options).floatsPerPoint * static_cast<int64_t>(sizeof(float));
}

/// Refuses a frame that cannot fit, which could stop the whole machine.
bool fitsMemory(const Scene& scene, const DeepFrame& layout, Log& log) {
  const int64_t needed = layout.padded.width() * kRowsInMemory * bytesOfTilePixel(scene) +
                         static_cast<int64_t>(layout.tileCount()) * kBytesOfBucket;
  const int64_t there = int64_t{::sysconf(_SC_PHYS_PAGES)} * ::sysconf(_SC_PAGESIZE);
  if (needed < there && static_cast<int64_t>(layout.tileCount()) < kMostTiles) return true;
  log.report(Severity::Output, "frame-too-large", {},
             fmt::format("a frame of {} million pixels in {} buckets needs about {} GB, and the machine has {}: render "
                         "it in parts with "
                         "--crop, or in larger buckets with --bucket-size",
                         pixelsOf(scene) / 1000000, layout.tileCount(), needed >> 30, there >> 30));
  return false;
}

/// Returns the memory for hidden buckets: --memory-limit minus the present memory, not counting `held` bytes of
/// buckets, and minus the size that caches may grow to.
int64_t tileBudget(const RenderSettings& settings, int64_t held) {
  if (!settings.resources.memoryLimit) return kUsualLimit;
  const int64_t caches =
      textureShare(*settings.resources.memoryLimit) + static_cast<int64_t>(brickCacheBytes(settings.resources));
  return std::max<int64_t>(0, *settings.resources.memoryLimit - (residentBytes() - held) - caches);
}

void reportMemory(int64_t limit, const std::string& done, const Stats& stats, Log& log) {
  const auto MB = [](int64_t bytes) { return static_cast<double>(bytes) / 1e6; };
  log.report(Severity::Info, "memory-limit", {},
             fmt::format("--memory-limit: {}; textures get {:.0f} MB at most; {:.0f} MB were used at the peak", done,
                         MB(textureShare(limit)), MB(peakResidentBytes())));
  if (peakResidentBytes() > limit)
    log.report(Severity::Note, "memory-exceeded", {},
               fmt::format("--memory-limit {:.0f} MB cannot be kept, {:.0f} MB were used: besides the program itself "
                           "geometry took {:.1f} MB, grids {:.1f}, what rays "
                           "meet {:.1f}",
                           MB(limit), MB(peakResidentBytes()), MB(stats.memoryBytes.geometry),
                           MB(stats.memoryBytes.grids), MB(stats.raytrace.bytes)));
}

/// Tells whether buckets may be shaded and filtered right after hiding, while they are in the cache, row by row. They
/// may not if that would take more geometry into memory, or if the scene asks for another order.
bool mayStream(const Scene& scene) { return scene.procedurals.empty() && scene.options.bucketOrder == "horizontal"; }

/// Returns false if the file cannot be read, which is reported.
bool useIrradiance(const Scene& scene, const RenderSettings& settings, FrameJob& job, Log& log) {
  std::string error;
  const auto file = IcfFile::open(settings.stored.irradiance, error);
  if (!file) {
    log.report(Severity::Error, "icf-read", {std::make_shared<std::string>(settings.stored.irradiance), 0},
               "cannot be read as an irradiance cache: " + error);
    return false;
  }
  IrradianceShot given = file->takeShot();
  moveToCamera(given, scene.cameraFromWorldAtOpen());
  if (!settings.stored.appendIrradiance) checkRecords(given.settings, settings.stored.irradiance, job, log);
  job.services()->useCaches(std::move(given.caches));
  return true;
}

/// Tells whether rows of the picture may be written before the last bucket is hidden.
bool mayWriteEarly(const Scene& scene, const RenderSettings& settings, bool gathers, int64_t budget_bytes) {
  // An audit looks at all rows before the first one is written, because its result goes into the pictures' headers.
  if (gathers || settings.quality.audits() || settings.quality.chooses()) return false;
  const bool large = pixelsOf(scene) * (bytesOfTilePixel(scene) + kBytesOfPoints) > budget_bytes;
  // A preview wants the first rows first.
  return large || !settings.report.preview.empty() || mayStream(scene);
}

using TileFinder = std::function<std::optional<DeepTile>(size_t tile)>;

/// A frame whose buckets are all hidden before the first one is shaded.
struct StagedFrame {
  FrameJob& job;
  const DeepFrame& layout;
  BucketFile& file;
  TileFinder find;       ///< Finds buckets that `file` holds.
  int64_t budget_bytes;  ///< Memory for buckets.
  bool gathers;          ///< Light is gathered.
  bool hasGivenRecords;  ///< Records of light come from a file.
  std::function<void()> afterStage;
};

/// Hides all buckets, gathers light, and writes the picture. Returns false if it is a pilot, which leaves nothing.
bool renderInStages(const StagedFrame& frame) {
  const auto& [job, layout, file, find, budget_bytes, gathers, hasGivenRecords, afterStage] = frame;
  const RenderSettings& settings = job.settings();
  const bool isLimited = settings.resources.memoryLimit.has_value();
  // The geometry that rays will meet needs an unknown amount of memory too.
  const bool leavesRoom = isLimited && gathers && !hasGivenRecords;
  TileStore store(layout.tileCount(), leavesRoom ? budget_bytes / 2 : budget_bytes, find);
  const TileStore::Spill spill = [&frame](size_t i, const DeepTile& tile) { frame.file.spill(i, tile); };
  const TileSink sink{{},
                      [&](size_t i, DeepTile&& tile) {
                        frame.file.keepForResume(i, tile);
                        if (!store.keep(i, tile)) spill(i, tile);
                      },
                      settings.picture.resume ? find : nullptr};
  hideBuckets(job, layout, sink);
  returnFreeMemory();  // frees the grids
  afterStage();
  if (isLimited && job.method().makesMaps)
    store.shrinkTo(0, spill);  // photons need the room; buckets are loaded again when they are read
  if (!hasGivenRecords) job.prepareRays();
  if (isLimited) {
    store.shrinkTo(tileBudget(settings, store.held_bytes()), spill);
    returnFreeMemory();
  }
  FrameLight(job, layout, store.reader()).make(gathers);
  if (settings.quality.isPilot) return false;
  afterStage();
  writePicture(job, layout, [&](size_t i) { return store.take(i); });
  return true;
}

}  // namespace

void renderFrame(Scene& scene, ShaderRegistry& shaders, int world, const RenderSettings& settings, Stats& stats,
                 Log& log, const std::function<void()>& afterStage) {
  if (!cropHasPixels(scene, log)) return;
  const DeepFrame layout = layOutFrame(scene);
  if (!displaysAreWritable(scene.options, settings, log) || !fitsMemory(scene, layout, log)) return;
  checkDisplays(scene.options, log);
  FrameJob job(scene, shaders, settings, stats, log);
  const bool given = !settings.stored.irradiance.empty(),
             gathers = job.gathersBeside(given && !settings.stored.appendIrradiance);
  if (!writesMapsAlone(scene.options, settings)) warnOfUnusedOptions(settings, job.method(), log);
  if (gathers) describeGather(scene.options, settings);
  if (!settings.stored.bakedFolder.empty() && !(gathers && job.gathers()) && !job.method().usesBaked)
    log.report(Severity::Warning, "baked-unused", {},
               "--baked: nothing is gathered that could be kept; it is for --gi gather, atlas or baked");
  const int64_t budget_bytes = tileBudget(settings, 0);
  const bool streams = mayWriteEarly(scene, settings, gathers, budget_bytes);

  if (streams || given || settings.picture.resume) job.openAll();
  BucketFile file(scene, layout, world, settings, log);
  const std::unique_ptr<Checkpoint> kept = checkpointOf(scene, shaders, layout, settings, log);
  job.useCheckpoint(kept.get());
  const TileFinder find = [&](size_t i) { return file.tile(i); };
  if (streams || given) job.prepareRays();
  if (given && job.services() && !useIrradiance(scene, settings, job, log)) return;
  if (streams)
    hideAndWritePicture(job, layout, find, [&](size_t i, const DeepTile& tile) { file.keepForResume(i, tile); });
  else if (!renderInStages({.job = job,
                            .layout = layout,
                            .file = file,
                            .find = find,
                            .budget_bytes = budget_bytes,
                            .gathers = gathers,
                            .hasGivenRecords = given,
                            .afterStage = afterStage}))
    return file.forget();
  if (settings.resources.memoryLimit)
    reportMemory(*settings.resources.memoryLimit,
                 streams ? "the picture was made row by row, and the buckets of earlier rows were dropped"
                         : fmt::format("{} of {} buckets rested in a file", file.spilled(), layout.tileCount()),
                 stats, log);
  if (stopRequested() || log.worst() == Severity::Output) return;
  file.forget();
  if (kept) kept->forget();
}

}  // namespace tomales
