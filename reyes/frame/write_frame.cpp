#include "reyes/frame.h"
#include "reyes/frame/sampling.h"

namespace tomales {
namespace {

/// Objects go by Attribute "identifier" "name", materials by "shadinggroup" or their surface shader.
MatteNames matteNames(const Scene& scene) {
  MatteNames out;
  for (const ShadeGroup& group : scene.groups) {
    const Attributes& a = *group.attributes;
    const auto shading = a.user.find("identifier:shadinggroup");
    const bool given = shading != a.user.end() && !shading->second.strings.empty();
    out.materials.push_back(given ? shading->second.strings[0] : a.surface ? a.surface->name : "defaultsurface");
    const bool named = !a.name.empty() || group.exampleObject < 0;
    out.objects.push_back(named ? a.name : objectName(scene.objects[static_cast<size_t>(group.exampleObject)]));
  }
  return out;
}

}  // namespace

void writeFrame(const DeepFrame& frame, const Scene& scene, const ShadingSystem& shading, const FrameControl& control,
                Log& log) {
  constexpr int kBandRows = 64;  // a multiple of the rows of a tile (image.h)
  const Options& options = scene.options;
  const FrameOutput output = outputOf(options);
  const SamplePattern pattern = samplePattern(options, control.seed);
  const SampleOffsets offsets = sampleOffsets(pattern);
  const MatteNames names = matteNames(scene);
  const View view = viewOf(Camera(options), scene.cameraFromWorldAtOpen());
  const FrameFilter filter(frame, options, offsets, names);
  std::vector<std::unique_ptr<DisplayFile>> files;
  for (size_t i = 0; i < options.displays.size(); ++i)
    if (options.displays[i].type != "null")
      files.push_back(std::make_unique<DisplayFile>(filter.shape(), output, i, options, log, view, names));
  for (int y = frame.crop.y0; y < frame.crop.y1; y += kBandRows) {
    const int end = std::min(y + kBandRows, frame.crop.y1);
    Image band = filter.rows(y, end);
    expose(band, options);
    runImager(band, shading);
    for (const auto& file : files) {
      const std::optional<DeepMerge> merge = file->deep();
      if (merge)
        file->write(filter.deepRows(y, end, *merge));
      else
        file->write(band);
    }
    if (control.progress)
      control.progress(static_cast<float>(y - frame.crop.y0) / static_cast<float>(frame.crop.height()));
  }
  for (const auto& file : files) file->close();
}

}  // namespace tomales
