// Portable vectorisation: hot loops are plain loops in functions marked TOMALES_HOT, which the compiler
// builds for SSE2, AVX2 and AVX-512 and the loader picks by CPU. IEEE operations without contraction give
// the same bits in every width, so dispatch never changes a picture (docs/decisions/0005).
#pragma once
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

// Sanitizer runtimes are not ready when the loader runs ifunc resolvers, so builds with sanitizers have one version.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(TOMALES_SANITIZED)
#define TOMALES_HOT __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define TOMALES_HOT
#endif

namespace tomales {

constexpr int kLanes = 16;  ///< Arrays that shaders and kernels see are padded to this many floats.
inline int padded(int count) { return (count + kLanes - 1) / kLanes * kLanes; }

/// Allocates memory of a std::vector that starts on a cache line.
template <class T>
struct CacheAligned {
  using value_type = T;
  CacheAligned() = default;
  template <class U>
  CacheAligned(const CacheAligned<U>&) {}
  // It aligns by hand, because glibc's aligned allocation bypasses its caches of freed blocks, and grids come and go by
  // the million.
  T* allocate(size_t n) {
    char* block = static_cast<char*>(::operator new(n * sizeof(T) + kLine));
    void** aligned = reinterpret_cast<void**>(block + kLine - reinterpret_cast<uintptr_t>(block) % kLine);
    aligned[-1] = block;
    return reinterpret_cast<T*>(aligned);
  }
  void deallocate(T* p, size_t) { ::operator delete(reinterpret_cast<void**>(p)[-1]); }
  static constexpr uintptr_t kLine = 64;
  bool operator==(const CacheAligned&) const { return true; }
};
template <class T>
using AlignedVector = std::vector<T, CacheAligned<T>>;

/// Does the same as CacheAligned, but elements without a value are not set to zero. It suits memory that is written
/// before it is read.
template <class T>
struct Unset : CacheAligned<T> {
  using value_type = T;
  Unset() = default;
  template <class U>
  Unset(const Unset<U>&) {}
  template <class U>
  void construct(U* p) {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Args>
  void construct(U* p, Args&&... args) {
    ::new (static_cast<void*>(p)) U(static_cast<Args&&>(args)...);
  }
};
template <class T>
using UnsetVector = std::vector<T, Unset<T>>;

}  // namespace tomales
