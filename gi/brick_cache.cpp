#include "gi/brick_cache.h"

#include <list>
#include <mutex>
#include <unordered_map>

#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr size_t kShards = 16;  // each with its own lock and share of the budget
constexpr size_t kBytesOfEntry = 192;  // of the list, the index and the allocator, in about

}  // namespace

struct BrickCache::Shard {
  struct Entry {
    uint64_t key;
    BrickPtr brick;
  };
  std::mutex mutex;
  std::list<Entry> byUse;  ///< The last used first.
  std::unordered_map<uint64_t, std::list<Entry>::iterator> index;
  size_t budget = 0, bytes = 0;
  int64_t lookups = 0, misses = 0;

  static size_t bytesOf(const Brick& brick) { return brick.bytes().capacity() + sizeof(Brick) + kBytesOfEntry; }

  void makeRoom() {
    while (bytes > budget && !byUse.empty()) {
      bytes -= bytesOf(*byUse.back().brick);
      index.erase(byUse.back().key);
      byUse.pop_back();
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
  if (const auto found = shard.index.find(key); found != shard.index.end()) {
    shard.byUse.splice(shard.byUse.begin(), shard.byUse, found->second);
    return found->second->brick;
  }
  ++shard.misses;
  auto made = std::make_shared<const Brick>(read());
  shard.bytes += Shard::bytesOf(*made);
  shard.byUse.push_front({key, made});
  shard.index[key] = shard.byUse.begin();
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
