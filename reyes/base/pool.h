// Memory for small objects that are freed at about the same time. It is handed out in order from a few blocks, and
// freed with the last of the objects. Threads: one at a time takes; any may give back.
#pragma once
#include <algorithm>
#include <memory>
#include <vector>

#include "reyes/base/simd.h"

namespace tomales {

class Pool {
 public:
  /// block_bytes: the size of a block, which should be about as much as will be taken.
  explicit Pool(size_t block_bytes) : block_bytes_(block_bytes) {}
  Pool(const Pool&) = delete;

  /// Returns memory that starts on a cache line.
  void* take(size_t size) {
    constexpr size_t kLine = CacheAligned<std::byte>::kLine;
    const size_t need = (size + kLine - 1) / kLine * kLine;
    if (left_ < need) {
      left_ = std::max(need, block_bytes_);
      blocks_.emplace_back(CacheAligned<std::byte>().allocate(left_));
      next_ = blocks_.back().get();
      bytes_ += left_;
    }
    std::byte* const taken = next_;
    next_ += need;
    left_ -= need;
    return taken;
  }
  size_t bytes() const { return bytes_; }

 private:
  struct Free {
    void operator()(std::byte* p) const { CacheAligned<std::byte>().deallocate(p, 0); }
  };
  const size_t block_bytes_;
  std::vector<std::unique_ptr<std::byte, Free>> blocks_;
  std::byte* next_ = nullptr;
  size_t left_ = 0, bytes_ = 0;
};

/// An allocator for containers, which takes from a pool, if there is one. The pool must outlive them.
template <class T>
struct FromPool {
  using value_type = T;
  FromPool(Pool* p = nullptr) : pool(p) {}
  template <class U>
  FromPool(const FromPool<U>& o) : pool(o.pool) {}
  T* allocate(size_t n) { return pool ? static_cast<T*>(pool->take(n * sizeof(T))) : CacheAligned<T>().allocate(n); }
  void deallocate(T* p, size_t n) {
    if (!pool) CacheAligned<T>().deallocate(p, n);
  }
  bool operator==(const FromPool&) const = default;
  using propagate_on_container_move_assignment = std::true_type;
  FromPool select_on_container_copy_construction() const { return {}; }  ///< Copies do not use the pool.
  Pool* pool;
};
template <class T>
using PooledVector = std::vector<T, FromPool<T>>;

/// An allocator for std::allocate_shared: the object that it makes keeps the pool alive.
template <class T>
struct KeepingPool {
  using value_type = T;
  explicit KeepingPool(std::shared_ptr<Pool> p) : pool(std::move(p)) {}
  template <class U>
  KeepingPool(const KeepingPool<U>& o) : pool(o.pool) {}
  T* allocate(size_t n) { return static_cast<T*>(pool->take(n * sizeof(T))); }
  void deallocate(T*, size_t) {}
  bool operator==(const KeepingPool&) const = default;
  std::shared_ptr<Pool> pool;
};

}  // namespace tomales
