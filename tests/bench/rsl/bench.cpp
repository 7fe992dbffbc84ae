// Shaders of some weight in RSL against the same by hand: a plain loop over points, and one over vectors of points.
// bench_rsl tests/bench/rsl/shaders [NAME...]. The three run by turns on one thread; the least of many runs counts.
// Prints JSON: nanoseconds a point of processor time, greatest differences of the pictures, and the geometric means.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "reyes/rsl.h"
#include "tests/bench/rsl/loops.h"

namespace {

using namespace tomales;
using namespace tomales::bench;

constexpr int kRuns = 60, kCalls = 40;

/// The processor time of this thread, so that what else runs on the machine counts little.
double now_ns() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}
template <class Call>
double timeOf(const Call& call) {
  const double start_ns = now_ns();
  for (int k = 0; k < kCalls; ++k) call();
  return (now_ns() - start_ns) / (kCalls * kPoints);
}

/// What a shader left: Ci, or Cl of a light.
std::vector<float> pictureOf(const Batch& batch, bool light) {
  std::vector<float> out;
  const TmVec3& c = light ? batch.grid.Cl : batch.grid.Ci;
  for (const float* x : {c.x, c.y, c.z}) out.insert(out.end(), x, x + kPoints);
  return out;
}

/// The difference that all but one in a hundred values keep to: a loop by hand rounds otherwise, and a step that is
/// missed by a bit is not what is asked here.
double differenceOf(const std::vector<float>& a, const std::vector<float>& b) {
  std::vector<float> all;
  for (size_t k = 0; k < a.size(); ++k) all.push_back(std::abs(a[k] - b[k]));
  std::sort(all.begin(), all.end());
  return static_cast<double>(all[all.size() * 99 / 100]);
}

struct Row {
  std::string name;
  double rsl = 1e30, fused = 1e30, vectors = 1e30, fusedDifference = 0, vectorDifference = 0;
};

Row measured(const std::string& file, const Loop& fused, const Loop& vectors) {
  const auto text = RslFile::compile(file, {});
  if (text->errors() > 0) {
    std::fputs(text->messages().c_str(), stderr);
    std::exit(2);
  }
  const TmShader& shader = *text->library()->shaders[0];
  Batch batch;
  batch.bind(shader);
  Row row{std::string(fused.name)};
  const auto ours = [&] { shader.shade(&batch.grid); };
  const bool light = shader.kind == TM_LIGHT;
  ours();
  const std::vector<float> picture = pictureOf(batch, light);
  fused.run(batch);
  row.fusedDifference = differenceOf(picture, pictureOf(batch, light));
  vectors.run(batch);
  row.vectorDifference = differenceOf(picture, pictureOf(batch, light));
  for (int k = 0; k < kRuns; ++k) {
    row.rsl = std::min(row.rsl, timeOf(ours));
    row.vectors = std::min(row.vectors, timeOf([&] { vectors.run(batch); }));
    if (k % 4 == 0) row.fused = std::min(row.fused, timeOf([&] { fused.run(batch); }));
  }
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("bench_rsl tests/bench/rsl/shaders [NAME...]\n", stderr);
    return 2;
  }
  const auto wanted = [&](std::string_view name) {
    return argc == 2 || std::find(argv + 2, argv + argc, name) != argv + argc;
  };
  double toVectors = 0, toFused = 0;
  int count = 0;
  fmt::print("{{\"shaders\": [");
  for (size_t k = 0; k < fusedLoops().size(); ++k) {
    const Loop &fused = fusedLoops()[k], &vectors = vectorLoops()[k];
    if (!wanted(fused.name)) continue;
    const Row r = measured(fmt::format("{}/{}.sl", argv[1], fused.name), fused, vectors);
    fmt::print(
        "{}\n  {{\"name\": \"{}\", \"rsl\": {:.2f}, \"vectors\": {:.2f}, \"fused\": {:.2f}, \"rsl/vectors\": "
        "{:.2f}, \"rsl/fused\": {:.2f}, \"differences\": [{:.1g}, {:.1g}]}}",
        count++ ? "," : "", r.name, r.rsl, r.vectors, r.fused, r.rsl / r.vectors, r.rsl / r.fused, r.vectorDifference,
        r.fusedDifference);
    std::fflush(stdout);
    toVectors += std::log(r.rsl / r.vectors);
    toFused += std::log(r.rsl / r.fused);
  }
  fmt::print("],\n\"geometric mean of rsl/vectors\": {:.2f}, \"of rsl/fused\": {:.2f}}}\n", std::exp(toVectors / count),
             std::exp(toFused / count));
}
