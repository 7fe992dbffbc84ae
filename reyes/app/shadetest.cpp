#include "reyes/app/shadetest.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>

#include "reyes/app/render.h"
#include "reyes/dice.h"
#include "reyes/image.h"
#include "reyes/rib.h"
#include "reyes/shade.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// A unit square that faces the eye from five units away, under an ambient and a distant light.
std::string sceneFor(const TmShader& shader, const std::string& path) {
  const char* request = shader.kind == TM_LIGHT ? "LightSource \"{}\" \"tested\"" : shader.kind == TM_DISPLACEMENT ? "Displacement \"{}\"" : "Surface \"{}\"";
  return "Option \"searchpath\" \"string shader\" [\"" + path + "\"]\nProjection \"perspective\" \"fov\" [20]\nWorldBegin\n" +
         (shader.kind == TM_LIGHT ? "" : "LightSource \"ambientlight\" \"a\" \"intensity\" [0.2] LightSource \"distantlight\" \"d\" \"to\" [0.3 -0.4 1]\n") +
         (shader.kind == TM_SURFACE ? "" : "Surface \"matte\"\n") + fmt::format(fmt::runtime(request), shader.name) +
         "\nTranslate 0 0 5\nPatch \"bilinear\" \"P\" [-.5 .5 0  .5 .5 0  -.5 -.5 0  .5 -.5 0]\nWorldEnd\n";
}

/// A name, or the first shader of a plugin. Null: there is none, which is reported.
const TmShader* findShader(const std::string& name, ShaderRegistry& registry, Log& log) {
  if (fs::path(name).extension() == ".so") {
    ShaderRegistry plugin(log);
    if (!plugin.loadPlugin(fs::absolute(name).string())) return nullptr;
    registry.loadPlugin(fs::absolute(name).string());
    return plugin.all().empty() ? nullptr : plugin.all().front();
  }
  for (const TmKind kind : {TM_SURFACE, TM_DISPLACEMENT, TM_LIGHT})
    if (const TmShader* shader = registry.find(name, kind, ".")) return shader;
  log.report(Severity::Error, "shadetest", {}, "no surface, displacement or light shader \"" + name + "\" is built in or in this folder");
  return nullptr;
}

ShadePoints pointsOf(const Scene& scene, const ShadingSystem& shading, const std::array<int, 2>& size) {
  ShadePoints points(0, 0, shading.wantsSteps(0));
  for (int j = 0; j < size[1]; ++j)
    for (int i = 0; i < size[0]; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(size[0]), v = (static_cast<float>(j) + 0.5f) / static_cast<float>(size[1]);
      const int k = points.add(static_cast<uint32_t>(j * size[0] + i));
      evaluatePoint(scene, 0, 0, u, v, points, k);
      if (points.hasSteps()) evaluateSteps(scene, 0, 0, u, v, 0.5f / static_cast<float>(std::max(size[0], size[1])), points, k);
      points.channel(kDu)[k] = 1 / static_cast<float>(size[0]), points.channel(kDv)[k] = 1 / static_cast<float>(size[1]);
      points.set3(kIx, k, points.position(k)), points.channel(kTime)[k] = -1;
    }
  return points;
}

/// Nanoseconds of one call, from as many as a fifth of a second holds.
template <class Call>
double timeOf(const Call& call) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  int calls = 0;
  double elapsed_s = 0;
  for (; elapsed_s < 0.2; ++calls) {
    call();
    elapsed_s = std::chrono::duration<double>(Clock::now() - start).count();
  }
  return 1e9 * elapsed_s / calls;
}

void say(const char* what, const vec3& v) { std::puts(fmt::format("{}: {:.6g} {:.6g} {:.6g}", what, v.x, v.y, v.z).c_str()); }

void testDisplacement(const Scene& scene, const ShadingSystem& shading, const std::array<int, 2>& size) {
  const Grid still = dice(scene, 0, 0, UvRect{}, size[0] - 1, size[1] - 1, 1);
  Grid moved;
  const double time_ns = timeOf([&] { moved = still, shading.displace(moved); });
  float longest = 0;
  for (int i = 0; i < still.vertexCount(); ++i) longest = std::max(longest, glm::length(moved.position(0, i) - still.position(0, i)));
  std::puts(fmt::format("nanoseconds a point: {:.1f}\nlongest displacement: {:.6g}", time_ns / still.vertexCount(), longest).c_str());
}

void testSurface(const ShadetestCommand& command, const Scene& scene, const ShadingSystem& shading, Log& log) {
  const ShadePoints points = pointsOf(scene, shading, command.grid);
  ShadedPoints out;
  const double time_ns = timeOf([&] { shading.shade(points, {}, out); });
  vec3 low(kInfinity), high(-kInfinity), mean(0);
  Image image;
  image.width = image.displayWidth = command.grid[0], image.height = image.displayHeight = command.grid[1];
  image.channels = {"R", "G", "B"};
  for (int i = 0; i < points.count(); ++i) {
    const vec3 c = out.color(i);
    low = glm::min(low, c), high = glm::max(high, c), mean += c / static_cast<float>(points.count());
    image.pixels.insert(image.pixels.end(), {c.x, c.y, c.z});
  }
  std::puts(fmt::format("nanoseconds a point: {:.1f}", time_ns / points.count()).c_str());
  say("Ci least", low), say("Ci mean", mean), say("Ci greatest", high);
  if (!command.output.empty()) writeImage(command.output, image, fs::path(command.output).extension() == ".png", log);
}

}  // namespace

int shadetestCommand(const ShadetestCommand& command) {
  Log log;
  Stats stats;
  ShaderRegistry registry(log);
  registry.addLibrary(tomales_builtin_shaders(), "built-in");
  const TmShader* shader = findShader(command.shader, registry, log);
  if (!shader || shader->kind > TM_LIGHT) {
    if (shader) log.report(Severity::Error, "shadetest", {}, "volumes and imagers have nothing to shade on a grid");
    return std::max(exitCodeOf(log), kUnreadable);
  }
  RibSettings rib;
  rib.onScene = [&](Scene&& scene) {
    const ShadingSystem shading(scene, registry, nullptr, log, stats);
    std::puts(fmt::format("shader: {}\npoints: {} x {}", shader->name, command.grid[0], command.grid[1]).c_str());
    if (shader->kind == TM_DISPLACEMENT)
      testDisplacement(scene, shading, command.grid);
    else
      testSurface(command, scene, shading, log);
  };
  readRibText(sceneFor(*shader, "."), "shadetest", rib, log);
  return exitCodeOf(log);
}

}  // namespace tomales
