// Micropolygons a second through dice + hide: splitting, dicing, projecting, sampling and resolving a whole frame into
// points to shade, of which none is shaded, filtered or written. 1024 x 768 pixels, 16 samples each, shading rate 1,
// matte, one light; one thread, user seconds, the least of several runs. What counts is what was diced, seen or not.
//     bench_frame [RUNS] [SCENE]
#include <fmt/format.h>
#include <sys/resource.h>

#include <limits>

#include "reyes/base/parallel.h"
#include "reyes/base/stats.h"
#include "reyes/frame.h"
#include "reyes/rib.h"
#include "reyes/shader_registry.h"

extern const TmShaderLibrary* tomales_builtin_shaders(void);

namespace {

using namespace tomales;

struct Bench {
  std::string name, world;
};

/// Half of what is diced of spheres is their far side. step_px: motion over the shutter, each sphere another way.
std::string spheres(double step_px) {
  std::string out;
  for (int i = 0; i < 16 * 12; ++i) {
    const double x = i % 16 - 7.5, y = i / 16 - 5.5, turn = 2.4 * i, step = step_px / 64;
    const std::string from = fmt::format("Translate {} {} {} ", x, y, i % 3);
    out += "TransformBegin " + from;
    if (step_px > 0)
      out += fmt::format("MotionBegin [0 1] Translate 0 0 0 Translate {} {} 0 MotionEnd ", step * std::cos(turn),
                         step * std::sin(turn));
    out += "Sphere 0.62 -0.62 0.62 360 TransformEnd\n";
  }
  return out;
}

/// All of a sheet is seen.
std::string sheet(double step_px) {
  std::string out;
  if (step_px > 0)
    out += fmt::format("MotionBegin [0 1] Translate 0 0 0 Translate {0} {0} 0 MotionEnd ", step_px / 64 / std::sqrt(2));
  out += "Patch \"bicubic\" \"P\" [";
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) out += fmt::format("{} {} {} ", 6 * (i - 1.5), 4.5 * (j - 1.5), (i * 7 + j * 3) % 3);
  return out + "]\n";
}

Scene sceneOf(const std::string& world) {
  constexpr const char* kFrame =
      "Format 1024 768 1 PixelSamples 4 4 PixelFilter \"box\" 1 1 ShadingRate 1 Shutter 0 1 Projection "
      "\"orthographic\" "
      "ScreenWindow -8 8 -6 6 Clipping 0.1 100 Translate 0 0 10 WorldBegin "
      "LightSource \"distantlight\" 1 \"from\" [-1 1 -1] \"to\" [0 0 0] Surface \"matte\"\n";
  Log log(Log::Verbosity::Normal);
  std::vector<Scene> scenes;
  RibSettings settings;
  settings.onScene = [&](Scene&& s) { scenes.push_back(std::move(s)); };
  readRibText(kFrame + world + "WorldEnd\n", "bench.rib", settings, log);
  return std::move(scenes.at(0));
}

double userSeconds() {
  rusage used;
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_utime.tv_sec) + 1e-6 * static_cast<double>(used.ru_utime.tv_usec);
}

void measure(const Bench& bench, int runs) {
  double least_s = std::numeric_limits<double>::infinity(), diced = 0, visible = 0;
  for (int run = 0; run < runs; ++run) {
    Log log(Log::Verbosity::Normal);
    Stats stats;
    Scene scene = sceneOf(bench.world);
    ShaderRegistry registry(log);
    registry.addLibrary(tomales_builtin_shaders(), "built-in");
    ShadingSystem shading(scene, registry, nullptr, log, stats);
    const DeepFrame layout = layOutFrame(scene);
    const double begin_s = userSeconds();
    hideTiles(layout, scene, shading, {}, stats, log, {{}, [](size_t, DeepTile&&) {}, {}});
    least_s = std::min(least_s, userSeconds() - begin_s);
    diced = static_cast<double>(stats.geometry.micropolygonsDiced);
    visible = static_cast<double>(stats.geometry.micropolygonsVisible);
  }
  fmt::print("{:16} {:5.2f} M diced, {:5.2f} M seen, {:.3f} user s", bench.name, diced * 1e-6, visible * 1e-6, least_s);
  if (diced > 0) fmt::print(", {:.1f} M a second", 1e-6 * diced / least_s);
  fmt::print("\n");
}

}  // namespace

int main(int count, char** arguments) {
  const int runs = count > 1 ? std::max(1, std::atoi(arguments[1])) : 5;
  const std::string only = count > 2 ? arguments[2] : "";
  const ThreadLimit one(1);
  const Bench benches[] = {{"nothing", ""},
                           {"still-spheres", spheres(0)},
                           {"moving-spheres", spheres(8)},
                           {"still-sheet", sheet(0)},
                           {"moving-sheet", sheet(8)}};
  for (const Bench& b : benches)
    if (only.empty() || only == b.name) measure(b, runs);
}
