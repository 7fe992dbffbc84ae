#include "reyes/image/resolved_frame.h"

#include <bit>

#include "reyes/base/parallel.h"
#include "reyes/image/weights.h"

namespace tomales {

ResolvedFrame::ResolvedFrame(const DeepFrame& frame, const FrameOutput& output, const Options& options)
    : frame_(frame), output_(output), options_(options), resolved_(frame.tileCount()), noise_(frame.tileCount()) {
  compositors_.push_back(takeCompositor());
  width_ = compositors_[0]->width();
  extras_ = compositors_[0]->extras();
}

void ResolvedFrame::resolve(size_t index, const DeepTile& tile) {
  std::unique_ptr<Compositor> compositor = takeCompositor();
  resolved_[index] = std::make_unique<ResolvedTile>(compositor->resolve(tile));
  noise_[index] = noiseOf(*resolved_[index], width_, frame_.samplesPerPixel);
  const std::lock_guard lock(mutex_);
  compositors_.push_back(std::move(compositor));
}

TOMALES_HOT ResolvedFrame::TileNoise ResolvedFrame::noiseOf(const ResolvedTile& tile, int width, int samples) {
  TileNoise out;
  if (samples < 2) return out;
  const auto all = static_cast<float>(samples);
  const float* color = tile.values.data();
  const Contribution* seen = tile.contributions.data();
  for (size_t pixel = 0; pixel + 1 < tile.first.size(); ++pixel) {
    float sum = 0, squares = 0;
    for (const Contribution* end = tile.contributions.data() + tile.first[pixel + 1]; seen != end;
         ++seen, color += width) {
      const float light = luminance(vec3(color[0], color[1], color[2])),
                  count = static_cast<float>(std::popcount(seen->samples));
      sum += count * light;
      squares += count * light * light;
    }
    const float mean = sum / all, variance = (squares / all - mean * mean) / (all - 1);
    if (!(mean > 0)) continue;
    out.sums.light += mean;
    out.sums.error += std::sqrt(std::max(variance, 0.0f));
    ++out.lit;
  }
  return out;
}

PixelNoise ResolvedFrame::noise() const {
  constexpr int64_t kEnough = 1000;
  PixelNoise out;
  int64_t lit = 0;
  for (const TileNoise& tile : noise_) {
    out.light += tile.sums.light;
    out.error += tile.sums.error;
    lit += tile.lit;
  }
  return lit < kEnough ? PixelNoise{} : out;
}

std::unique_ptr<Compositor> ResolvedFrame::takeCompositor() {
  const std::lock_guard lock(mutex_);
  if (compositors_.empty()) return std::make_unique<Compositor>(output_, options_, frame_.samplesPerPixel);
  std::unique_ptr<Compositor> taken = std::move(compositors_.back());
  compositors_.pop_back();
  return taken;
}

void ResolvedFrame::resolveRows(int y0, int y1) {
  const size_t first = firstTileOf(y0), last = firstTileOf(y1 - 1) + static_cast<size_t>(frame_.columns);
  parallelFor(last - first, 1, [&](size_t begin, size_t) {
    const size_t index = first + begin;
    const PixelRect rect = frame_.rectOf(index);
    if (resolved_[index]) return;
    if (const DeepTile* tile = finishedTile(frame_, rect.x0, rect.y0)) resolve(index, *tile);
  });
}

void ResolvedFrame::forgetAbove(int y) {
  for (const size_t end = firstTileOf(y); forgotten_ < end; ++forgotten_) resolved_[forgotten_].reset();
}

size_t ResolvedFrame::firstTileOf(int y) const {
  return static_cast<size_t>(frame_.rowOf(std::clamp(y, frame_.padded.y0, frame_.padded.y1 - 1))) *
         static_cast<size_t>(frame_.columns);
}

ResolvedFrame::TileRun ResolvedFrame::runFrom(int x, int y) const {
  const int right = x - frame_.padded.x0, column = right / frame_.bucketWidth, row = frame_.rowOf(y);
  const auto& tile =
      resolved_[static_cast<size_t>(row) * static_cast<size_t>(frame_.columns) + static_cast<size_t>(column)];
  const int left = column * frame_.bucketWidth, tileWidth = std::min(frame_.bucketWidth, frame_.padded.width() - left);
  return {tile.get(),
          static_cast<size_t>((y - frame_.padded.y0 - row * frame_.bucketHeight) * tileWidth + right - left),
          frame_.padded.x0 + left + tileWidth};
}

}  // namespace tomales
