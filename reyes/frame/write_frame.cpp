#include <fmt/format.h>

#include <cmath>

#include "reyes/base/parallel.h"
#include "reyes/frame.h"
#include "reyes/frame/display_files.h"
#include "reyes/frame/matte_names.h"
#include "reyes/frame/moving_band.h"
#include "reyes/frame/sampling.h"

namespace tomales {
namespace {

constexpr int kBandRows = 64;  // a multiple of the rows of a tile (image.h)

/// Warns of noise where surfaces move far, are far out of focus, or are thinner than the samples are apart.
void warnOfNoise(const PixelNoise& noise, const Options& options, Log& log) {
  constexpr double kUncertain = 0.2;
  const double share = noise.light > 0 ? noise.error / noise.light : 0;
  if (!(share > kUncertain) || !std::isfinite(share)) return;  // infinite light has no share
  log.report(Severity::Warning, "pixel-noise", {},
             fmt::format("pixels are uncertain by {:.0f} % in the mean: {} x {} samples are few for what moves, is out "
                         "of focus or thinner than a pixel "
                         "(PixelSamples, --pixel-samples)",
                         100 * share, options.xSamples, options.ySamples));
}

/// Replaces differences by their magnitudes. They have signs while they are filtered, so that they can cancel in a
/// pixel.
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
  const bool cut = control.stop.requested();
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
    if (control.stop.requested()) return;
    viewer(filter.rows(y, end));
  }
}

}  // namespace tomales
