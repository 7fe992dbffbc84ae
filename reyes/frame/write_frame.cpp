#include "reyes/frame.h"
#include "reyes/frame/sampling.h"

namespace tomales {

void writeFrame(const DeepFrame& frame, const Scene& scene, const ShadingSystem& shading, const FrameControl& control,
                Log& log) {
  constexpr int kBandRows = 64;  // a multiple of the rows of a tile (image.h)
  const Options& options = scene.options;
  const FrameOutput output = outputOf(options);
  const SamplePattern pattern = samplePattern(options, control.seed);
  const SampleOffsets offsets = sampleOffsets(pattern);
  const FrameFilter filter(frame, options, offsets);
  std::vector<std::unique_ptr<DisplayFile>> files;
  for (size_t i = 0; i < options.displays.size(); ++i)
    if (options.displays[i].type != "null")
      files.push_back(std::make_unique<DisplayFile>(filter.shape(), output, i, options, log));
  for (int y = frame.crop.y0; y < frame.crop.y1; y += kBandRows) {
    Image band = filter.rows(y, std::min(y + kBandRows, frame.crop.y1));
    expose(band, options);
    runImager(band, shading);
    for (const auto& file : files) file->write(band);
    if (control.progress)
      control.progress(static_cast<float>(y - frame.crop.y0) / static_cast<float>(frame.crop.height()));
  }
  for (const auto& file : files) file->close();
}

}  // namespace tomales
