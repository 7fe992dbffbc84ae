#include "reyes/app/relight/shared_tiles.h"

namespace tomales {

void SharedTiles::begin(size_t layer, uint32_t edit) {
  if (layers_[layer].edit != edit) layers_[layer] = {edit, {}};
}

bool SharedTiles::load(size_t layer, size_t bucket, DeepTile& tile) const {
  const std::lock_guard lock(mutex_);
  const auto& known = layers_[layer].ofBuckets;
  const auto found = known.find(bucket);
  if (found == known.end()) return false;
  tile = *found->second.outline;
  tile.shaded = found->second.shaded;
  return true;
}

void SharedTiles::keep(size_t layer, size_t bucket, const DeepTile& tile) {
  const std::lock_guard lock(mutex_);
  auto& known = layers_[layer].ofBuckets;
  if (!known.contains(bucket)) known.emplace(bucket, Tile{outlineOf(bucket, tile), tile.shaded});
}

void SharedTiles::drop(size_t layer, size_t bucket) {
  const std::lock_guard lock(mutex_);
  layers_[layer].ofBuckets.erase(bucket);
}

void SharedTiles::clear() {
  for (Tiles& layer : layers_) layer = {};
}

// Pre: the mutex is locked.
std::shared_ptr<const DeepTile> SharedTiles::outlineOf(size_t bucket, const DeepTile& tile) {
  std::weak_ptr<const DeepTile>& known = outlines_[bucket];
  auto outline = known.lock();
  if (!outline) {
    DeepTile made = withoutPoints(tile);
    made.shaded.clear();
    outline = std::make_shared<const DeepTile>(std::move(made));
    known = outline;
  }
  return outline;
}

}  // namespace tomales
