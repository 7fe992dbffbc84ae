#include "reyes/app/frame/frame_picture.h"

#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "reyes/app/frame/provenance.h"
#include "reyes/app/frame/turns_timer.h"
#include "reyes/app/watch/pixel_report.h"
#include "reyes/app/watch/preview.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

class PictureWriter {
 public:
  PictureWriter(FrameJob& job, const DeepFrame& layout)
      : job_(job), layout_(layout), frame_(layout), noise_(noiseOf(job)) {
    if (noise_ >= 0 && job.services()) job.services()->redrawRecords();
  }

  void write(const std::function<std::optional<DeepTile>(size_t tile)>& load);
  void hideAndWrite(const std::function<std::optional<DeepTile>(size_t tile)>& find,
                    const std::function<void(size_t tile, const DeepTile&)>& keep);

 private:
  /// Returns the index of the first array of ShadedPoints::variables for the noise; negative if there is none.
  static int noiseOf(FrameJob& job) {
    int first = -1;
    for (const Variable& v : outputOf(job.scene().options).variables)
      if (const SurfaceVariable* known = surfaceVariable(v.source); known && known->source == VariableSource::Noise)
        first = v.first;
    return first;
  }

  /// Stores how far the colours of a shaded tile differ from a second draw of all random numbers
  /// (VariableSource::Noise).
  void tellNoise(DeepTile& tile) const;
  /// Keeps the colours of a tile that is shaded as the finished picture has it, for a later run. A tile that is not
  /// shaded again bakes nothing, so no tile is kept once anything has been baked.
  void keepColors(size_t index, const DeepTile& tile) const {
    if (!job_.clouds().hasBaked()) keepShaded(job_.kept(), index, tile);
  }
  /// Puts a shaded tile where the rows of the picture find it.
  void place(size_t index, DeepTile&& tile, const TilePlace& put) const;
  void finish(const TileFill& fill);

  FrameJob& job_;
  const DeepFrame& layout_;
  DeepFrame frame_;  ///< The layout with its tiles.
  const int noise_;
};

void PictureWriter::tellNoise(DeepTile& tile) const {
  if (noise_ < 0) return;
  ShadeContext context = job_.shadeContext();
  context.seed = hashCombine(context.seed, randomStream("anew"));
  context.redrawn = true;
  context.purpose = Purpose::Sketch;
  DeepTile other = tile;
  other.shaded.clear();
  other.answers.clear();  // they are those of the first draw
  shadeTile(other, job_.scene(), job_.shading(), context);
  for (size_t b = 0; b < tile.shaded.size(); ++b) {
    ShadedPoints& shown = tile.shaded[b];
    const auto first = static_cast<size_t>(noise_);
    for (size_t k = 0; k < 3 && first + 3 <= shown.variables.size(); ++k)
      for (size_t i = 0; i < shown.Ci[k].size(); ++i)
        shown.variables[first + k][i] = (shown.Ci[k][i] - other.shaded[b].Ci[k][i]) / std::sqrt(2.0f);
  }
}

void PictureWriter::write(const std::function<std::optional<DeepTile>(size_t tile)>& load) {
  ShadeContext context = job_.shadeContext();
  const bool cut = stopRequested(), resumes = cut && job_.kept();
  if (cut) {
    // Without --resume the hidden buckets are shaded with direct light, until a second signal. With --resume such light
    // would be thrown away.
    job_.log().report(Severity::Warning, "interrupted", {},
                      resumes ? "interrupted: shaded buckets are written; the same command goes on from here"
                              : "interrupted: finished buckets are shaded with direct light and written");
    context.indirect = false;
    context.diffuseLimit = 0;  // shaders may ask for indirect light themselves, with a thousand rays per point
  }
  size_t shaded = 0;
  bool complete = true;
  const auto progress = job_.meter().shading();
  progress(0);
  finish([&](std::span<const uint32_t> tiles, const TilePlace& put) {
    const StageTimer timer(job_.stats(), "shade");
    const auto tell = [&, before = shaded](float share) {  // what is left is to write the last rows
      progress(0.99f * (static_cast<float>(before) + share * static_cast<float>(tiles.size())) /
               static_cast<float>(frame_.tileCount()));
    };
    const TileAccess access{[&](size_t index, DeepTile& tile) {
                              auto loaded = load(index);
                              if (!loaded) return false;
                              tile = std::move(*loaded);
                              return takeShaded(job_.kept(), index, tile) || !resumes;
                            },
                            [&](size_t index, DeepTile&& tile) {
                              if (!cut) tellNoise(tile);
                              if (!cut) keepColors(index, tile);
                              place(index, std::move(tile), put);
                            }};
    const FrameControl control{tell, cut ? StopToken() : processStop(), job_.settings().picture.seed};
    complete = shadeTiles(tiles, access, job_.scene(), job_.shading(), context, control) && complete;
    shaded += tiles.size();
  });
  if (!complete) job_.log().report(Severity::Warning, "interrupted", {}, "interrupted: finished buckets are written");
}

void PictureWriter::hideAndWrite(const std::function<std::optional<DeepTile>(size_t tile)>& find,
                                 const std::function<void(size_t tile, const DeepTile&)>& keep) {
  const auto progress = [of = job_.meter().hidingAndShading()](float share) {  // what is left is to write the last rows
    of(0.99f * share);
  };
  const FrameControl control{progress, processStop(), job_.settings().picture.seed};
  FrameHider hider(layout_, job_.scene(), job_.shading(), control, job_.stats(), job_.log());
  bool complete = true;
  std::atomic<bool> dropped{false};
  finish([&](std::span<const uint32_t> tiles, const TilePlace& put) {
    TurnsTimer timer(job_.stats(), "hide", "shade");
    const TileSink sink{{},
                        [&](size_t index, DeepTile&& tile) {
                          keep(index, tile);
                          const TurnsTimer::Turn turn(timer);
                          if (!takeShaded(job_.kept(), index, tile))
                            shadeTile(tile, job_.scene(), job_.shading(), job_.shadeContext());
                          tellNoise(tile);
                          if (stopRequested()) {  // as shadeTiles() does
                            dropped = true;
                            return;
                          }
                          keepColors(index, tile);
                          place(index, std::move(tile), put);
                        },
                        find};
    complete = hider.hide(tiles, sink) && complete;
  });
  if (!complete || dropped)
    job_.log().report(Severity::Warning, "interrupted", {}, "interrupted: finished buckets are written");
}

void PictureWriter::place(size_t index, DeepTile&& tile, const TilePlace& put) const {
  for (const auto& [x, y] : job_.settings().report.pixels)
    if (tile.rect.contains(x, y))
      std::fputs(pixelReport(tile, x, y, layOutFrame(job_.scene()).samplesPerPixel, job_.scene()).c_str(), stdout);
  put(index, std::move(tile));
}

void PictureWriter::finish(const TileFill& fill) {
  Preview* preview = job_.preview(frame_);
  const RowViewer viewer = preview ? [=](const Image& rows) { preview->show(rows); } : RowViewer{};
  const RenderSettings& settings = job_.settings();
  makeRoomForStatistics(job_.scene().options, settings);
  writeFrame(frame_, fill, viewer, job_.scene(), job_.shading(),
             {{}, processStop(), settings.picture.seed, pluginTrust(settings)}, job_.stats(), job_.log());
  if (job_.services()) job_.services()->reportAtlas(job_.stats());
  if (job_.rays()) job_.rays()->report(job_.stats());
  job_.closePreview();
  job_.clouds().write(job_.log());
  if (stopRequested()) return;
  std::error_code failed;
  if (!job_.sketchFile().empty()) std::filesystem::remove(job_.sketchFile(), failed);
  job_.meter().finish();
}

}  // namespace

void writePicture(FrameJob& job, const DeepFrame& layout,
                  const std::function<std::optional<DeepTile>(size_t tile)>& load) {
  PictureWriter(job, layout).write(load);
}

void hideAndWritePicture(FrameJob& job, const DeepFrame& layout,
                         const std::function<std::optional<DeepTile>(size_t tile)>& find,
                         const std::function<void(size_t tile, const DeepTile&)>& keep) {
  PictureWriter(job, layout).hideAndWrite(find, keep);
}

}  // namespace tomales
