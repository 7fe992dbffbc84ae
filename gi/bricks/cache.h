// Verb: bricks on demand, the least recently used dropped first under one byte budget for all maps
// (Christensen and Batali 2004, section 3.4). Threads: every member may be called concurrently; a brick is read once,
// however many threads ask.
#pragma once
#include <functional>
#include <memory>

#include "gi/bricks/brick.h"
#include "reyes/base/stats.h"

namespace tomales {

using BrickPtr = std::shared_ptr<const Brick>;

class BrickCache {
 public:
  static constexpr size_t kDefaultBytes = 10 << 20;  ///< The paper's size.

  explicit BrickCache(size_t bytes = kDefaultBytes);
  ~BrickCache();

  /// Returns brick `brick` of map `map`, from the cache or from `read`.
  BrickPtr get(uint32_t map, uint32_t brick, const std::function<Brick()>& read);
  /// Returns a number for a map, different from all others.
  uint32_t addMap();

  int64_t lookups() const;
  int64_t misses() const;
  size_t bytes() const;  ///< Bytes held now; never above the budget.

 private:
  struct Shard;
  std::unique_ptr<Shard[]> shards_;
  std::atomic<uint32_t> maps_{0};
};

}  // namespace tomales
