// Threads and parallel loops. oneTBB is used in parallel.cpp alone; Embree shares its pool.
// A loop body must be a function of its index, never of the thread that runs it.
#pragma once
#include <cstddef>
#include <functional>
#include <memory>

namespace tomales {

/// Calls body(begin, end) over [0, count) in chunks of at most `grain`, on all threads of the pool. The chunks are
/// [k*grain, (k+1)*grain): they never depend on the number of threads. While it waits, the caller works only on chunks
/// of this loop, so it may hold a lock that other loops need.
void parallelFor(size_t count, size_t grain, const std::function<void(size_t begin, size_t end)>& body);

/// Calls body(i) for every i of [0, count) on all threads; no call starts before those of smaller i have started.
void parallelInOrder(size_t count, const std::function<void(size_t i)>& body);

/// Limits the number of threads while this object lives; 0 stands for as many as the machine has.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Returns the number of threads that parallelFor uses now.
int threadCount();

}  // namespace tomales
