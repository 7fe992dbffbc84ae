// The kernels of compiled shaders over 256 points, and a plain loop over the function of one point that each of them
// stands for (of the C library where there is one), with the same flags. Prints JSON: nanoseconds a point.
#include <chrono>
#include <cstdio>

#include "tests/unit/rsl_kernels/references.h"

namespace {

using namespace tomales::compiler;
constexpr int kBlocks = 16, kPoints = kBlocks * kBlock;

/// The least of many runs, in nanoseconds a point.
template <class Call>
double timeOf(const Call& call) {
  double least = 1e30;
  for (int run = 0; run < 40; ++run) {
    const int repeats = 20;
    const auto start = std::chrono::steady_clock::now();
    for (int r = 0; r < repeats; ++r) call();
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
    least = std::min(least, took.count() / (repeats * kPoints));
  }
  return least;
}

/// Arguments of one shape after another, as arrays of the plain loop.
template <class T>
T valueAt(const float* plane, int i) {
  T value;
  for (size_t c = 0; c < sizeof value / sizeof(float); ++c)
    reinterpret_cast<float*>(&value)[c] = plane[c * kPoints + static_cast<size_t>(i)];
  return value;
}

struct Bench {
  bool first = true;
  std::vector<Values> in;
  Values out{16, kBlocks, true};

  void fill(Op op) {
    Numbers numbers(7);
    in.clear();
    for (const Entry& e : entries()) {
      if (e.op != op) continue;
      for (char letter : e.takes) {
        in.emplace_back(floatsOf(letter), kBlocks, true);
        for (float& x : in.back().data) x = numbers.within(0.1f, 0.9f);
      }
    }
  }
  template <class Plain>
  void print(Op op, const Plain& plain) {
    std::vector<Lanes> lanes;
    for (Values& v : in) lanes.push_back(v.lanes());
    const Kernel kernel = kernelOf(op);
    const double ours = timeOf([&] { kernel(kBlocks, out.lanes(), lanes.data()); }), theirs = timeOf(plain);
    for (const Entry& e : entries())
      if (e.op == op)
        std::printf("%s\n  \"%s\": {\"kernel\": %.2f, \"plain\": %.2f}", first ? "{" : ",", e.name.c_str(), ours,
                    theirs);
    first = false;
  }
  template <class F, class Out, class... In>
  void loop(Op op, const F& f, Out (F::*)(In...) const) {
    loopOver<Out, std::decay_t<In>...>(op, f, std::index_sequence_for<In...>());
  }
  template <class Out, class... In, class F, size_t... argument>
  void loopOver(Op op, const F& f, std::index_sequence<argument...>) {
    fill(op);
    float* const to = out.data.data();
    const float* const from[] = {in[argument].data.data()...};
    print(op, [&] {
      for (int i = 0; i < kPoints; ++i) {
        const Out result = f(valueAt<In>(from[argument], i)...);
        for (size_t c = 0; c < sizeof result / sizeof(float); ++c)
          to[c * kPoints + static_cast<size_t>(i)] = reinterpret_cast<const float*>(&result)[c];
      }
    });
  }
  template <class F>
  void bits(Op op, const F& f) {
    loop(op, f, &F::operator());
  }
  template <class F>
  void library(Op op, const F& f) {
    if constexpr (std::is_invocable_v<F, float>)
      loopOver<float, float>(op, f, std::index_sequence_for<float>());
    else
      loopOver<float, float, float>(op, f, std::index_sequence_for<float, float>());
  }
};

}  // namespace

int main() {
  Bench bench;
  visitReferences(bench);
  std::puts("\n}");
}
