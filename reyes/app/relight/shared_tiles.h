// Shaded buckets that several parts of a layer need, because neighbouring parts overlap at their border. Threads:
// begin() and clear() while no other call runs, any otherwise.
#pragma once
#include <map>
#include <mutex>

#include "reyes/deep.h"

namespace tomales {

class SharedTiles {
 public:
  explicit SharedTiles(size_t layers) : layers_(layers) {}

  /// Call it before a part of a layer is shaded: it forgets the layer's buckets of any other edit.
  void begin(size_t layer, uint32_t edit);
  /// Returns false if the bucket is not there.
  bool load(size_t layer, size_t bucket, DeepTile& tile) const;
  void keep(size_t layer, size_t bucket, const DeepTile& tile);
  void drop(size_t layer, size_t bucket);
  void clear();

 private:
  struct Tile {
    std::shared_ptr<const DeepTile> outline;  ///< The bucket without points and colours, which all layers share.
    std::vector<ShadedPoints> shaded;
  };
  struct Tiles {
    uint32_t edit = 0;
    std::map<size_t, Tile> ofBuckets;
  };
  std::shared_ptr<const DeepTile> outlineOf(size_t bucket, const DeepTile& tile);

  mutable std::mutex mutex_;
  std::vector<Tiles> layers_;
  std::map<size_t, std::weak_ptr<const DeepTile>> outlines_;
};

}  // namespace tomales
