#include "reyes/base/parallel.h"

#include <pthread.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

#include "reyes/base/deep_stack.h"

// oneTBB is not built for ThreadSanitizer, which therefore does not see that a loop starts after its caller's writes
// and ends before its caller's reads. These calls state that.
#ifdef __SANITIZE_THREAD__
extern "C" void __tsan_acquire(void*);
extern "C" void __tsan_release(void*);
#define TOMALES_TSAN(call) call
#else
#define TOMALES_TSAN(call) (void)0
#endif

namespace tomales {
namespace {

void* call(void* body) {
  (*static_cast<const std::function<void()>*>(body))();
  return nullptr;
}

}  // namespace

void runOnDeepStack(const std::function<void()>& body) {
  constexpr size_t kStack_bytes = kMostBounces * kBounceStack_bytes;
  const tbb::global_control pool(tbb::global_control::thread_stack_size, kStack_bytes);
  // The stack of the process's first thread ends where ulimit -s says.
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStack_bytes);
  pthread_t thread;
  const bool started = pthread_create(&thread, &attributes, call, const_cast<std::function<void()>*>(&body)) == 0;
  pthread_attr_destroy(&attributes);
  if (started)
    pthread_join(thread, nullptr);
  else
    body();
}

struct ThreadLimit::Impl {
  explicit Impl(size_t threads) : control(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control control;  // registers its own address: never copy one
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0) impl_ = std::make_unique<Impl>(static_cast<size_t>(threads));
}
ThreadLimit::~ThreadLimit() = default;

int threadCount() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void parallelFor(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
  if (count == 0) return;
  const size_t chunks = (count + grain - 1) / grain;
  [[maybe_unused]] char start, end;
  TOMALES_TSAN(__tsan_release(&start));
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(
        size_t{0}, chunks,
        [&](size_t c) {
          TOMALES_TSAN(__tsan_acquire(&start));
          body(c * grain, std::min(count, (c + 1) * grain));
          TOMALES_TSAN(__tsan_release(&end));
        },
        tbb::simple_partitioner());
  });
  TOMALES_TSAN(__tsan_acquire(&end));
}

void parallelInOrder(size_t count, const std::function<void(size_t)>& body) {
  std::atomic<size_t> next{0};
  parallelFor(count, 1, [&](size_t, size_t) { body(next++); });
}

}  // namespace tomales
