#include "reyes/app/shadetest.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>

#include "reyes/app/render.h"
#include "reyes/dice.h"
#include "reyes/frame.h"
#include "reyes/image.h"
#include "reyes/rib.h"
#include "reyes/shade.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// A unit square that faces the eye from five units away, under an ambient and a distant light.
std::string sceneFor(const TmShader& shader) {
  static constexpr const char* kRequests[] = {"Surface \"{}\"", "Displacement \"{}\"", "LightSource \"{}\" \"tested\"",
                                              "Atmosphere \"{}\"", "Imager \"{}\""};
  const std::string request = fmt::format(fmt::runtime(kRequests[shader.kind]), shader.name);
  const bool isImager = shader.kind == TM_IMAGER;
  return "Projection \"perspective\" \"fov\" [20]\nClipping 1 10\n" + (isImager ? request : "") + "\nWorldBegin\n" +
         (shader.kind == TM_LIGHT ? ""
                                  : "LightSource \"ambientlight\" \"a\" \"intensity\" [0.2] LightSource "
                                    "\"distantlight\" \"d\" \"to\" [0.3 -0.4 1]\n") +
         (shader.kind == TM_SURFACE ? "" : "Surface \"matte\"\n") + (isImager ? "" : request) +
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
  for (const TmKind kind : {TM_SURFACE, TM_DISPLACEMENT, TM_LIGHT, TM_VOLUME, TM_IMAGER})
    if (const TmShader* shader = registry.find(name, kind, ".")) return shader;
  log.report(Severity::Error, "shadetest", {}, "no shader \"" + name + "\" is built in or in this folder");
  return nullptr;
}

ShadePoints pointsOf(const Scene& scene, const ShadingSystem& shading, const std::array<int, 2>& size) {
  ShadePoints points(0, 0, shading.wantsSteps(0));
  for (int j = 0; j < size[1]; ++j)
    for (int i = 0; i < size[0]; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(size[0]),
                  v = (static_cast<float>(j) + 0.5f) / static_cast<float>(size[1]);
      const int k = points.add(static_cast<uint32_t>(j * size[0] + i));
      evaluatePoint(scene, 0, 0, u, v, points, k);
      if (points.hasSteps())
        evaluateSteps(scene, 0, 0, u, v, 0.5f / static_cast<float>(std::max(size[0], size[1])), points, k);
      points.channel(kDu)[k] = 1 / static_cast<float>(size[0]),
      points.channel(kDv)[k] = 1 / static_cast<float>(size[1]);
      points.set3(kIx, k, points.position(k)), points.channel(kTime)[k] = -1;
    }
  return points;
}

/// What is timed, and what has to be done anew before each call, which is not.
struct Trial {
  std::function<void()> prepare, call;
};

/// Nanoseconds of one call, from as many as a fifth of a second holds.
double timeOf(const Trial& trial) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  int calls = 0;
  Clock::duration spent{};
  for (; Clock::now() - start < std::chrono::milliseconds(200); ++calls) {
    trial.prepare();
    const auto began = Clock::now();
    trial.call();
    spent += Clock::now() - began;
  }
  return 1e9 * std::chrono::duration<double>(spent).count() / calls;
}

void say(const char* what, const vec3& v) {
  std::puts(fmt::format("{}: {:.6g} {:.6g} {:.6g}", what, v.x, v.y, v.z).c_str());
}

void testDisplacement(const Scene& scene, const ShadingSystem& shading, const std::array<int, 2>& size) {
  const Grid still = dice(scene, 0, 0, UvRect{}, size[0] - 1, size[1] - 1, 1);
  Grid moved;
  const double time_ns = timeOf({[&] { moved = still; }, [&] { shading.displace(moved); }});
  float longest = 0;
  for (int i = 0; i < still.vertexCount(); ++i)
    longest = std::max(longest, glm::length(moved.position(0, i) - still.position(0, i)));
  std::puts(
      fmt::format("nanoseconds a point: {:.1f}\nlongest displacement: {:.6g}", time_ns / still.vertexCount(), longest)
          .c_str());
}

/// Times a trial, and says what is in the picture that it has left, three colours first.
void testColors(const ShadetestCommand& command, const Trial& trial, const std::function<Image()>& picture, Log& log) {
  const double time_ns = timeOf(trial);
  const Image image = picture();
  const size_t count = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
  vec3 low(kInfinity), high(-kInfinity), mean(0);
  for (size_t i = 0; i < count; ++i) {
    const float* pixel = image.pixels.data() + i * image.channels.size();
    const vec3 c(pixel[0], pixel[1], pixel[2]);
    low = glm::min(low, c), high = glm::max(high, c), mean += c / static_cast<float>(count);
  }
  std::puts(fmt::format("nanoseconds a point: {:.1f}", time_ns / static_cast<double>(count)).c_str());
  say("Ci least", low), say("Ci mean", mean), say("Ci greatest", high);
  if (!command.output.empty()) writeImage(command.output, image, fs::path(command.output).extension() == ".png", log);
}

Image blankImage(const std::array<int, 2>& size, std::vector<std::string> channels) {
  Image image;
  image.width = image.displayWidth = size[0], image.height = image.displayHeight = size[1];
  image.channels = std::move(channels);
  return image;
}

/// Surfaces and lights by what the surface looks like, volumes by what the air leaves of it.
void testPoints(const ShadetestCommand& command, const Scene& scene, const ShadingSystem& shading, bool volume,
                Log& log) {
  const ShadePoints points = pointsOf(scene, shading, command.grid);
  ShadedPoints surface, out;
  shading.shade(points, {}, surface);
  const auto prepare = [&] {
    if (volume) out = surface;
  };
  const auto shade = [&] {
    if (volume)
      shading.atmosphere(points, out);
    else
      shading.shade(points, {}, out);
  };
  const auto picture = [&] {
    Image image = blankImage(command.grid, {"R", "G", "B"});
    for (int i = 0; i < points.count(); ++i) {
      const vec3 c = out.color(i);
      image.pixels.insert(image.pixels.end(), {c.x, c.y, c.z});
    }
    return image;
  };
  testColors(command, {prepare, shade}, picture, log);
}

/// A picture whose grey is half of its alpha, which rises from the left, 0, to the right, 1.
void testImager(const ShadetestCommand& command, const ShadingSystem& shading, Log& log) {
  const auto [width, height] = command.grid;
  Image wedge = blankImage(command.grid, {"R", "G", "B", "A"}), image;
  for (int i = 0; i < width * height; ++i) {
    const float alpha = static_cast<float>(i % width) / static_cast<float>(width - 1), grey = 0.5f * alpha;
    wedge.pixels.insert(wedge.pixels.end(), {grey, grey, grey, alpha});
  }
  testColors(
      command, {[&] { image = wedge; }, [&] { runImager(image, shading); }}, [&] { return image; }, log);
}

}  // namespace

int shadetestCommand(const ShadetestCommand& command) {
  Log log;
  Stats stats;
  ShaderRegistry registry(log, {.folders = "."});  // the user names the shader, no scene does
  registry.addLibrary(tomales_builtin_shaders(), "built-in");
  const TmShader* shader = findShader(command.shader, registry, log);
  if (!shader) return std::max(exitCodeOf(log), kUnreadable);
  RibSettings rib;
  rib.onScene = [&](Scene&& scene) {
    const ShadingSystem shading(scene, registry, nullptr, log, stats);
    std::puts(fmt::format("shader: {}\npoints: {} x {}", shader->name, command.grid[0], command.grid[1]).c_str());
    if (shader->kind == TM_DISPLACEMENT)
      testDisplacement(scene, shading, command.grid);
    else if (shader->kind == TM_IMAGER)
      testImager(command, shading, log);
    else
      testPoints(command, scene, shading, shader->kind == TM_VOLUME, log);
  };
  readRibText(sceneFor(*shader), "shadetest", rib, log);
  return exitCodeOf(log);
}

}  // namespace tomales
