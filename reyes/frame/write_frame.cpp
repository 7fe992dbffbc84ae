#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "reyes/base/parallel.h"
#include "reyes/frame.h"
#include "reyes/frame/sampling.h"

namespace tomales {
namespace {

/// Names of objects are Attribute "identifier" "name"; names of materials are "shadinggroup" or their surface shader.
MatteNames matteNames(const Scene& scene) {
  MatteNames out;
  for (const ShadeGroup& group : scene.groups) {
    const Attributes& a = *group.attributes;
    const Param* given = findParam(a.user, "identifier:shadinggroup");
    const std::string surface = a.surface ? a.surface->name : "defaultsurface";
    out.materials.push_back(given && !given->strings.empty() ? given->strings[0] : surface);
    out.objects.push_back(a.name.empty() ? objectName(group) : a.name);
  }
  return out;
}

/// Keeps those tiles of a frame in memory that some rows of pixels need, and has the tiles below filled.
class MovingBand {
 public:
  MovingBand(DeepFrame& frame, FrameFilter& filter, const TileFill& fill, const Options& options)
      : frame_(frame),
        filter_(filter),
        fill_(fill),
        reach_(static_cast<int>(filterReach(options).y)),
        needed_(tilesOf(frame, options)) {
    std::sort(needed_.begin(), needed_.end());
    frame.hold(0, 0);
  }

  /// Returns the share of the tiles of the whole picture that have been filled.
  float finished() const {
    return needed_.empty() ? 1.0f : static_cast<float>(finished_) / static_cast<float>(needed_.size());
  }

  void moveTo(int y0, int y1) {
    const int first = frame_.rowOf(std::max(y0 - reach_, frame_.padded.y0));
    const int last = frame_.rowOf(std::min(y1 + reach_, frame_.padded.y1) - 1) + 1;
    frame_.hold(first, last);
    const auto from = needed_.begin() + static_cast<std::ptrdiff_t>(filled_);
    const auto to = std::lower_bound(from, needed_.end(), static_cast<uint32_t>(last * frame_.columns));
    filled_ = static_cast<size_t>(to - needed_.begin());
    // Tiles are filled column by column: threads that begin far apart in the list should begin far apart in the picture
    // (FrameHider::hide).
    const auto columns = static_cast<uint32_t>(frame_.columns);
    std::stable_sort(from, to, [columns](uint32_t a, uint32_t b) { return a % columns < b % columns; });
    fill_({from, to}, [this](size_t index, DeepTile&& tile) {
      ++finished_;
      // resolves it now, while it is in the cache
      filter_.resolve(index, tile);
      if (!filter_.needsTiles()) return;
      tile.forgetPoints();
      frame_.tile(index) = std::move(tile);
    });
  }

 private:
  DeepFrame& frame_;
  FrameFilter& filter_;
  const TileFill& fill_;
  const int reach_;
  std::vector<uint32_t> needed_;
  size_t filled_ = 0;
  std::atomic<size_t> finished_{0};
};

/// The files of the Displays, and the rows to be written to them.
class DisplayFiles {
 public:
  explicit DisplayFiles(Stats& stats) : stats_(stats) {}
  void add(std::unique_ptr<DisplayFile> file) { files_.push_back(std::move(file)); }

  /// Pre: no rows are being written.
  void take(Image rows, const FrameFilter& filter, int y0, int y1) {
    for (const auto& file : files_) {
      const std::optional<DeepMerge> merge = file->deep();
      deep_.push_back(merge ? filter.deepRows(y0, y1, *merge) : DeepRows{});
    }
    rows_ = std::move(rows);
  }
  void write() {
    if (!rows_) return;
    const StageTimer timer(stats_, "write", threadCpuSeconds);
    for (size_t i = 0; i < files_.size(); ++i)
      files_[i]->deep() ? files_[i]->write(deep_[i]) : files_[i]->write(*rows_);
    rows_.reset();
    deep_.clear();
  }
  void close(float finished) {
    write();
    const StageTimer timer(stats_, "write", threadCpuSeconds);
    for (const auto& file : files_)
      if (file->close(finished)) stats_.addOutput(file->written());
  }

 private:
  Stats& stats_;
  std::vector<std::unique_ptr<DisplayFile>> files_;
  std::optional<Image> rows_;
  std::vector<DeepRows> deep_;  ///< Indexed by file.
};

constexpr int kBandRows = 64;  // a multiple of the rows of a tile (image.h)

/// Warns of noise where surfaces move far, are far out of focus, or are thinner than the samples are apart.
void warnOfNoise(const PixelNoise& noise, const Options& options, Log& log) {
  constexpr double kUncertain = 0.2;
  const double share = noise.light > 0 ? noise.error / noise.light : 0;
  if (share <= kUncertain) return;
  log.report(Severity::Warning, "pixel-noise", {},
             fmt::format("pixels are uncertain by {:.0f} % in the mean: {} x {} samples are few for what moves, is out "
                         "of focus or thinner than a pixel "
                         "(PixelSamples, --pixel-samples)",
                         100 * share, options.xSamples, options.ySamples));
}

/// Differences have signs while they are filtered, so that what cancels in a pixel does. Shown is how large they are.
void showSizeOfNoise(const FrameOutput& output, Image& band) {
  for (const Channel& c : output.channels) {
    const SurfaceVariable* known =
        c.variable >= 0 ? surfaceVariable(output.variables[static_cast<size_t>(c.variable)].source) : nullptr;
    if (!known || known->source != VariableSource::Noise) continue;
    for (size_t i = static_cast<size_t>(c.first); i < band.pixels.size(); i += band.channels.size())
      for (size_t k = i; k < i + static_cast<size_t>(c.width()); ++k) band.pixels[k] = std::abs(band.pixels[k]);
  }
}

}  // namespace

void writeFrame(DeepFrame& frame, const TileFill& fill, const RowViewer& viewer, const Scene& scene,
                const ShadingSystem& shading, const FrameControl& control, Stats& stats, Log& log) {
  const Options& options = scene.options;
  const FrameOutput output = outputOf(options);
  const SamplePattern pattern = samplePattern(options, control.seed);
  const SampleOffsets offsets = sampleOffsets(pattern);
  const MatteNames names = matteNames(scene);
  const View view = viewOf(Camera(options), scene.cameraFromWorldAtOpen());
  FrameFilter filter(frame, options, offsets, names);
  MovingBand tiles(frame, filter, fill, options);
  DisplayFiles files(stats);
  for (size_t i = 0; i < options.displays.size(); ++i)
    if (options.displays[i].type != "null")
      files.add(std::make_unique<DisplayFile>(filter.shape(), output, i, options, log, view, names, control.trust));
  for (int y = frame.crop.y0; y < frame.crop.y1; y += kBandRows) {
    const int end = std::min(y + kBandRows, frame.crop.y1);
    // One thread writes rows while the others hide and shade those below.
    parallelFor(2, 1, [&](size_t job, size_t) { job == 0 ? tiles.moveTo(y, end) : files.write(); });
    const StageTimer timer(stats, "image");
    Image band = filter.rows(y, end);
    showSizeOfNoise(output, band);
    expose(band, options);
    runImager(band, shading);
    if (viewer) viewer(band);
    files.take(std::move(band), filter, y, end);
    if (control.progress)
      control.progress(static_cast<float>(end - frame.crop.y0) / static_cast<float>(frame.crop.height()));
  }
  const bool cut = control.cancelled && *control.cancelled;
  files.close(cut ? std::min(tiles.finished(), std::nextafter(1.0f, 0.0f)) : 1.0f);
  warnOfNoise(filter.noise(), options, log);
  shading.warnOfLightNoise();
}

void showFrame(DeepFrame& frame, const TileFill& fill, const RowViewer& viewer, const Options& options,
               const FrameControl& control) {
  const SamplePattern pattern = samplePattern(options, control.seed);
  const SampleOffsets offsets = sampleOffsets(pattern);
  FrameFilter filter(frame, options, offsets);
  MovingBand tiles(frame, filter, fill, options);
  for (int y = frame.crop.y0; y < frame.crop.y1; y += kBandRows) {
    const int end = std::min(y + kBandRows, frame.crop.y1);
    tiles.moveTo(y, end);
    if (control.cancelled && *control.cancelled) return;
    viewer(filter.rows(y, end));
  }
}

}  // namespace tomales
