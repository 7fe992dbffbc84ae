// One core: megabytes of RIB that become requests in a second.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "reyes/base/rng.h"
#include "reyes/rib/parser.h"

namespace tomales::rib {
namespace {

std::string points(bool binary) {
  std::string out = binary ? "" : "Points \"P\" [";
  const uint32_t count = 3'000'000;
  if (binary) {
    out = "Points \"P\" \xcb";
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(count >> shift & 0xff);
  }
  for (uint32_t i = 0; i < count; ++i) {
    const float f = unitFloat(hash32(i)) * 20 - 10;
    if (!binary) {
      out += fmt::format("{:.6g}{}", f, i % 12 == 11 ? '\n' : ' ');
      continue;
    }
    const uint32_t bits = __builtin_bit_cast(uint32_t, f);
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(bits >> shift & 0xff);
  }
  return out + (binary ? "" : "]\n");
}

std::string indices() {
  std::string out = "PointsPolygons [";
  for (int i = 0; i < 500'000; ++i) out += "4 ";
  out += "] [";
  for (int i = 0; i < 2'000'000; ++i) out += fmt::format("{} ", i / 3);
  return out + "] \"P\" [0 0 0]\n";
}

std::string manyObjects() {
  std::string out;
  for (int i = 0; i < 50'000; ++i)
    out += fmt::format(
        "AttributeBegin\n  Translate {:.4f} {:.4f} 0\n  Color [1 0.5 {:.3f}]\n  Surface \"plastic\" \"float "
        "Kd\" "
        "[0.7]\n  Sphere 1 -1 1 360\nAttributeEnd\n",
        i * 0.1, i * 0.37, i * 1e-5);
  return out;
}

void parse(benchmark::State& state, const std::string& text) {
  size_t requests = 0;
  for (auto _ : state) {
    Log log(Log::Verbosity::Quiet);
    Dictionary dictionary;
    const auto stream = ByteStream::fromMemory(text);
    Parser parser(*stream, "bench.rib", dictionary, log);
    while (parser.next()) ++requests;
  }
  state.SetBytesProcessed(static_cast<int64_t>(text.size()) * static_cast<int64_t>(state.iterations()));
  benchmark::DoNotOptimize(requests);
}

void build(benchmark::State& state, const std::string& text) {
  for (auto _ : state) {
    Log log(Log::Verbosity::Quiet);
    readRibText("WorldBegin\n" + text + "WorldEnd\n", "bench.rib", {}, log);
  }
  state.SetBytesProcessed(static_cast<int64_t>(text.size()) * static_cast<int64_t>(state.iterations()));
}

BENCHMARK_CAPTURE(parse, ascii_floats, points(false))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(parse, ascii_integers, indices())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(parse, binary_floats, points(true))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(parse, many_small_requests, manyObjects())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build, many_small_objects, manyObjects())->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tomales::rib
