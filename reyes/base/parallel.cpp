#include "reyes/base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace tomales {

struct ThreadLimit::Impl {
  explicit Impl(size_t threads) : control(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control control;  // registers its own address: never copy one
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0)
    impl_ = std::make_unique<Impl>(static_cast<size_t>(threads));
}
ThreadLimit::~ThreadLimit() = default;

int threadCount() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void parallelFor(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
  if (count == 0) return;
  const size_t chunks = (count + grain - 1) / grain;
  tbb::parallel_for(size_t{0}, chunks,
                    [&](size_t c) { body(c * grain, std::min(count, (c + 1) * grain)); },
                    tbb::simple_partitioner());
}

}  // namespace tomales
