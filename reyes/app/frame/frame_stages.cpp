#include "reyes/app/frame/frame_stages.h"

#include "reyes/base/parallel.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

ShadeContext contextOf(const FrameJob& job, const ShownLight& light) {
  ShadeContext context = job.shadeContext();
  context.onlyLightGroup = light.lights;
  context.indirect = light.indirect;
  return context;
}

}  // namespace

bool hideBuckets(FrameJob& job, const DeepFrame& layout, const TileSink& sink) {
  const StageTimer timer(job.stats(), "hide");
  const FrameControl control{job.meter().hiding(job.gathersBeside(false)), processStop(), job.settings().picture.seed};
  return hideTiles(layout, job.scene(), job.shading(), control, job.stats(), job.log(), sink);
}

bool shadeBuckets(FrameJob& job, std::span<const uint32_t> tiles, const TileAccess& access) {
  const StageTimer timer(job.stats(), "shade");
  const FrameControl control{job.meter().shading(), processStop(), job.settings().picture.seed};
  return shadeTiles(tiles, access, job.scene(), job.shading(), job.shadeContext(), control);
}

void showWindow(FrameJob& job, const DeepFrame& layout, const PixelRect& window, const ShownTiles& tiles,
                const ShownLight& light, const RowViewer& viewer, StopToken stop) {
  const ShadeContext context = contextOf(job, light);
  DeepFrame frame = layout;
  frame.crop = window;
  const FrameControl control{{}, stop, job.settings().picture.seed};
  const auto fill = [&](std::span<const uint32_t> asked, const TilePlace& put) {
    const auto take = [&](size_t index, DeepTile&& tile) {
      tiles.shaded(index, tile);
      put(index, std::move(tile));
    };
    shadeTiles(asked, {tiles.load, take}, job.scene(), job.shading(), context, control);
  };
  showFrame(frame, fill, viewer, job.scene().options, control);
}

void shadeApart(FrameJob& job, std::span<DeepTile> tiles, const ShownLight& light) {
  ShadeContext context = contextOf(job, light);
  context.purpose = Purpose::Sketch;
  parallelInOrder(tiles.size(), [&](size_t i) { shadeTile(tiles[i], job.scene(), job.shading(), context); });
}

}  // namespace tomales
