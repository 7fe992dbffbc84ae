#include "gi/bricks/cache.h"

#include <algorithm>
#include <mutex>
#include <unordered_map>

#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr size_t kShards = 16;         // Each shard has its own lock and share of the budget.
constexpr size_t kBytesOfEntry = 192;  // Bytes for the index, the queue and the allocator, roughly.

}  // namespace

struct BrickCache::Shard {
  struct Entry {
    BrickPtr brick;
    int64_t used;  ///< Number of the last lookup that asked for it.
  };
  /// An entry of the eviction queue, a heap with the least recently used brick in front. A lookup writes nothing but
  /// Entry::used; an entry whose `used` is out of date gets its right place when it comes to the front.
  struct Turn {
    int64_t used;
    uint64_t key;
    bool operator<(const Turn& other) const { return used > other.used; }
  };
  std::mutex mutex;
  std::unordered_map<uint64_t, Entry> held;
  std::vector<Turn> turns;  ///< One for each brick that is held.
  size_t budget = 0, bytes = 0;
  int64_t lookups = 0, misses = 0;

  static size_t bytesOf(const Brick& brick) { return brick.bytes().capacity() + sizeof(Brick) + kBytesOfEntry; }

  void makeRoom() {
    while (bytes > budget && !turns.empty()) {
      std::pop_heap(turns.begin(), turns.end());
      const auto entry = held.find(turns.back().key);
      if (turns.back().used != entry->second.used) {
        turns.back().used = entry->second.used;
        std::push_heap(turns.begin(), turns.end());
        continue;
      }
      bytes -= bytesOf(*entry->second.brick);
      held.erase(entry);
      turns.pop_back();
    }
  }
};

BrickCache::BrickCache(size_t bytes) : shards_(new Shard[kShards]) {
  for (size_t i = 0; i < kShards; ++i) shards_[i].budget = bytes / kShards;
}

BrickCache::~BrickCache() = default;

uint32_t BrickCache::addMap() { return maps_++; }

BrickPtr BrickCache::get(uint32_t map, uint32_t brick, const std::function<Brick()>& read) {
  const uint64_t key = uint64_t{map} << 32 | brick;
  Shard& shard = shards_[hashCombine(map, brick) % kShards];
  const std::lock_guard lock(shard.mutex);
  ++shard.lookups;
  if (const auto found = shard.held.find(key); found != shard.held.end()) {
    found->second.used = shard.lookups;
    return found->second.brick;
  }
  ++shard.misses;
  auto made = std::make_shared<const Brick>(read());
  shard.bytes += Shard::bytesOf(*made);
  shard.held[key] = {made, shard.lookups};
  shard.turns.push_back({shard.lookups, key});
  std::push_heap(shard.turns.begin(), shard.turns.end());
  shard.makeRoom();
  return made;
}

int64_t BrickCache::lookups() const {
  int64_t sum = 0;
  for (size_t i = 0; i < kShards; ++i) {
    const std::lock_guard lock(shards_[i].mutex);
    sum += shards_[i].lookups;
  }
  return sum;
}

int64_t BrickCache::misses() const {
  int64_t sum = 0;
  for (size_t i = 0; i < kShards; ++i) {
    const std::lock_guard lock(shards_[i].mutex);
    sum += shards_[i].misses;
  }
  return sum;
}

size_t BrickCache::bytes() const {
  size_t sum = 0;
  for (size_t i = 0; i < kShards; ++i) {
    const std::lock_guard lock(shards_[i].mutex);
    sum += shards_[i].bytes;
  }
  return sum;
}

}  // namespace tomales
