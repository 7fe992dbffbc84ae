#include "reyes/app/relight/sketch_points.h"

namespace tomales {
namespace {

/// Limit of the answers of interpolated light at a point: there is one for each layer, and for each normal that edits
/// of bumps make.
constexpr size_t kMostAnswersOfPoint = 32;

}  // namespace

void SketchPoints::add(size_t bucket, const DeepTile& tile, size_t to) {
  const std::lock_guard lock(mutex_);
  if (!taken_.insert(bucket).second) return;
  const ivec2 middle(window_.x0 + kCoarseStep / 2, window_.y0 + kCoarseStep / 2);
  addCorners(tile, kCoarseStep, middle, reduced_[to].tile, reduced_[to].corners);
}

void SketchPoints::forgetRays() {
  for (Reduced& r : reduced_) r.tile.answers.clear();
}

std::vector<vec3> SketchPoints::shade(ShotJob& job) {
  RayAnswers none;
  none.recording = none.recordsStay = true;
  std::vector<DeepTile> tiles;
  for (Reduced& r : reduced_) {
    if (r.tile.answers.empty()) r.tile.answers.assign(r.tile.batches.size(), none);
    for (size_t b = 0; b < r.tile.batches.size(); ++b)
      if (auto& kept = r.tile.answers[b].interpolated;
          kept.size() > kMostAnswersOfPoint * static_cast<size_t>(r.tile.batches[b].count()))
        kept.clear();
    r.tile.shaded.clear();
    tiles.push_back(std::move(r.tile));
  }
  job.shadeApart(tiles);
  const int columns = (window_.width() + kCoarseStep - 1) / kCoarseStep,
            rows = (window_.height() + kCoarseStep - 1) / kCoarseStep;
  std::vector<vec3> out(static_cast<size_t>(columns) * static_cast<size_t>(rows), vec3(0.0f));
  for (size_t t = 0; t < tiles.size(); ++t) {
    reduced_[t].tile = std::move(tiles[t]);
    for (const Corner& c : reduced_[t].corners) {
      const int column = (c.x - window_.x0) / kCoarseStep, row = (c.y - window_.y0) / kCoarseStep;
      if (c.x >= window_.x0 && c.y >= window_.y0 && column < columns && row < rows)
        out[static_cast<size_t>(row * columns + column)] = reduced_[t].tile.shaded[c.batch].color(c.point);
    }
  }
  return out;
}

}  // namespace tomales
