// The last part of a FrameJob: its tiles are shaded and become pictures.
#include <fmt/format.h>

#include <filesystem>

#include "reyes/app/frame/frame_job.h"
#include "reyes/app/frame/overrides.h"
#include "reyes/app/frame/turns_timer.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/app/watch/pixel_report.h"
#include "reyes/app/watch/preview.h"
#include "reyes/app/watch/sketch.h"
#include "reyes/base/parallel.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {

void FrameJob::beginNoise() {
  for (const Variable& v : outputOf(scene_.options).variables)
    if (const SurfaceVariable* known = surfaceVariable(v.source); known && known->source == VariableSource::Noise)
      noise_ = v.first;
  if (noise_ >= 0 && services_) services_->redrawRecords();
}

void FrameJob::tellNoise(DeepTile& tile) const {
  if (noise_ < 0) return;
  ShadeContext context = shadeContext();
  context.seed = hashCombine(context.seed, randomStream("anew"));
  context.redrawn = context.sketch = true;
  DeepTile other = tile;
  other.shaded.clear();
  other.answers.clear();  // they are those of the first draw
  tomales::shadeTile(other, scene_, *shading_, context);
  for (size_t b = 0; b < tile.shaded.size(); ++b) {
    ShadedPoints& shown = tile.shaded[b];
    const auto first = static_cast<size_t>(noise_);
    for (size_t k = 0; k < 3 && first + 3 <= shown.variables.size(); ++k)
      for (size_t i = 0; i < shown.Ci[k].size(); ++i)
        shown.variables[first + k][i] = (shown.Ci[k][i] - other.shaded[b].Ci[k][i]) / std::sqrt(2.0f);
  }
}

bool FrameJob::shade(std::span<const uint32_t> tiles, const ShadeSteps& steps) {
  const StageTimer timer(stats_, "shade");
  return shadeTiles(tiles, steps, scene_, *shading_, shadeContext(), control("shading", gathered_, 1));
}

void FrameJob::write(const DeepFrame& layout, const std::function<std::optional<DeepTile>(size_t tile)>& load) {
  ShadeContext context = shadeContext();
  const bool cut = interrupted(), resumes = cut && kept_;
  if (cut) {
    // Without --resume the hidden buckets are shaded with direct light, which a second signal ends too. With --resume
    // such light would be thrown away.
    log_.report(Severity::Warning, "interrupted", {},
                resumes ? "interrupted: shaded buckets are written; the same command goes on from here"
                        : "interrupted: finished buckets are shaded with direct light and written");
    context.indirect = false;
  }
  beginNoise();
  DeepFrame frame = layout;
  size_t shaded = 0;
  bool complete = true;
  const auto progress = meter_.pass("shading", gathered_, 1);
  progress(0);
  finish(frame, [&](std::span<const uint32_t> tiles, const TilePlace& put) {
    const StageTimer timer(stats_, "shade");
    const auto tell = [&, before = shaded](float share) {  // what is left is to write the last rows
      progress(0.99f * (static_cast<float>(before) + share * static_cast<float>(tiles.size())) /
               static_cast<float>(frame.tileCount()));
    };
    const ShadeSteps steps{[&](size_t index, DeepTile& tile) {
                             auto loaded = load(index);
                             if (!loaded) return false;
                             tile = std::move(*loaded);
                             return takeShaded(kept_, index, tile) || !resumes;
                           },
                           [&](size_t index, DeepTile&& tile) {
                             if (!cut) tellNoise(tile);
                             if (!cut) keepShaded(index, tile);
                             place(index, std::move(tile), put);
                           }};
    const FrameControl control{tell, cut ? nullptr : &interrupted(), settings_.picture.seed};
    complete = shadeTiles(tiles, steps, scene_, *shading_, context, control) && complete;
    shaded += tiles.size();
  });
  if (!complete) log_.report(Severity::Warning, "interrupted", {}, "interrupted: finished buckets are written");
}

void FrameJob::hideAndWrite(const DeepFrame& layout, const std::function<std::optional<DeepTile>(size_t tile)>& find,
                            const std::function<void(size_t tile, const DeepTile&)>& keep) {
  beginNoise();
  DeepFrame frame = layout;
  const FrameControl part = control("hiding and shading", 0, 1);
  FrameControl all = part;
  all.progress = [&](float share) { part.progress(0.99f * share); };  // what is left is to write the last rows
  FrameHider hider(layout, scene_, *shading_, all, stats_, log_);
  bool complete = true;
  std::atomic<bool> dropped{false};
  finish(frame, [&](std::span<const uint32_t> tiles, const TilePlace& put) {
    TurnsTimer timer(stats_, "hide", "shade");
    const TileSink sink{{},
                        [&](size_t index, DeepTile&& tile) {
                          keep(index, tile);
                          const TurnsTimer::Turn turn(timer);
                          if (!takeShaded(kept_, index, tile))
                            tomales::shadeTile(tile, scene_, *shading_, shadeContext());
                          tellNoise(tile);
                          if (interrupted()) {  // as shadeTiles() does
                            dropped = true;
                            return;
                          }
                          keepShaded(index, tile);
                          place(index, std::move(tile), put);
                        },
                        find};
    complete = hider.hide(tiles, sink) && complete;
  });
  if (!complete || dropped)
    log_.report(Severity::Warning, "interrupted", {}, "interrupted: finished buckets are written");
}

void FrameJob::show(const DeepFrame& layout, const ShownTiles& tiles, const ShownPart& part, const RowViewer& viewer,
                    const std::atomic<bool>& cancelled) {
  ShadeContext context = shadeContext();
  context.lights = part.lights;
  context.indirect = part.indirect;
  DeepFrame frame = layout;
  frame.crop = part.window;
  const FrameControl control{{}, &cancelled, settings_.picture.seed};
  const auto fill = [&](std::span<const uint32_t> asked, const TilePlace& put) {
    const auto take = [&](size_t index, DeepTile&& tile) {
      tiles.shaded(index, tile);
      put(index, std::move(tile));
    };
    shadeTiles(asked, {tiles.load, take}, scene_, *shading_, context, control);
  };
  showFrame(frame, fill, viewer, scene_.options, control);
}

void FrameJob::shadeApart(std::span<DeepTile> tiles, const std::string* lights, bool indirect) {
  ShadeContext context = shadeContext();
  context.lights = lights;
  context.indirect = indirect;
  context.sketch = true;
  parallelInOrder(tiles.size(), [&](size_t i) { tomales::shadeTile(tiles[i], scene_, *shading_, context); });
}

void FrameJob::place(size_t index, DeepTile&& tile, const TilePlace& put) const {
  for (const auto& [x, y] : settings_.report.pixels)
    if (tile.rect.contains(x, y))
      std::fputs(pixelReport(tile, x, y, layOutFrame(scene_).samplesPerPixel, scene_).c_str(), stdout);
  put(index, std::move(tile));
}

void FrameJob::writeSketch(const DeepFrame& layout, const TileReader& tiles) {
  constexpr int kStride = 4;
  const DisplayCall& first = scene_.options.displays.front();
  if (settings_.quality.isPilot || first.type == "null" ||
      !driverOf(first, scene_.options, pluginTrust(settings_)).empty())
    return;
  ShadeContext context = shadeContext();
  context.lightSamples = 1;
  context.indirect = false;
  context.sketch = true;
  const std::filesystem::path file(fileOf(first));
  sketchFile_ = (file.parent_path() / (file.stem().string() + ".sketch.exr")).string();
  writeImage(sketchFile_, sketch(layout, tiles, kStride, scene_, *shading_, context, interrupted()), false, log_);
}

void FrameJob::openPreview(const DeepFrame& layout) {
  if (!preview_ && !settings_.report.preview.empty())
    preview_ = std::make_unique<Preview>(settings_.report.preview, scene_.options.displays.front().name, layout, log_);
}

void FrameJob::finish(DeepFrame& frame, const TileFill& fill) {
  openPreview(frame);
  const RowViewer viewer = preview_ ? [&](const Image& rows) { preview_->show(rows); } : RowViewer{};
  writeFrame(frame, fill, viewer, scene_, *shading_,
             {{}, &interrupted(), settings_.picture.seed, pluginTrust(settings_)}, stats_, log_);
  if (services_) services_->reportAtlas(stats_);
  if (rays_) rays_->report(stats_);
  preview_.reset();
  clouds_.write(log_);
  if (interrupted()) return;
  std::error_code failed;
  if (!sketchFile_.empty()) std::filesystem::remove(sketchFile_, failed);
  meter_.finish();
}

}  // namespace tomales
