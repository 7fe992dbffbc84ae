#include "reyes/app/commands/shadetest.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <sstream>
#include <thread>

#include "reyes/app/commands/shader_check.h"
#include "reyes/app/commands/shader_scene.h"
#include "reyes/app/exit_code.h"
#include "reyes/app/settings.h"
#include "reyes/base/stop.h"
#include "reyes/dice.h"
#include "reyes/frame.h"
#include "reyes/image.h"
#include "reyes/image_files.h"
#include "reyes/rib.h"
#include "reyes/shade.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// The shaders to try, and the files that they come from, if those are text.
struct Tried {
  std::vector<const TmShader*> shaders;  ///< If it is empty, there is none, which is reported.
  std::vector<std::string> files;
};

/// Finds the shader of that name, or all of a plugin or .sl file.
Tried findShaders(const ShadetestCommand& command, ShaderRegistry& registry, Log& log) {
  const std::string& name = command.shader;
  if (fs::path(name).extension() == ".so") {
    ShaderRegistry plugin(log);
    if (!plugin.loadPlugin(fs::absolute(name).string())) return {};
    registry.loadPlugin(fs::absolute(name).string());
    return {plugin.all(), {}};
  }
  if (fs::path(name).extension() == ".sl") {
    const std::unique_ptr<const RslFunctions> functions = registry.functions("");
    const auto file = RslFile::compile(name, {.includeFolders = command.folders, .functions = functions.get()});
    Tried out{{}, file->files()};
    if (file->errors() > 0) {
      log.report(Severity::Error, "shadetest-compile", {}, name + " does not compile:\n" + file->messages());
      return out;
    }
    std::fputs(file->messages().c_str(), stderr);
    if (!registry.addText(file, name)) return out;
    for (int32_t k = 0; k < file->library()->count; ++k) out.shaders.push_back(file->library()->shaders[k]);
    if (out.shaders.empty()) log.report(Severity::Error, "shadetest", {}, name + " has no shader that can be tried");
    return out;
  }
  for (const TmKind kind : {TM_SURFACE, TM_DISPLACEMENT, TM_LIGHT, TM_VOLUME, TM_IMAGER})
    if (const TmShader* shader = registry.find(name, kind, ".")) return {{shader}, {}};
  log.report(Severity::Error, "shadetest", {}, "no shader \"" + name + "\" is built in or in this folder");
  return {};
}

/// Returns how many numbers the text holds, separated by blanks; -1 if it holds anything else.
int numbersIn(const std::string& text) {
  int out = 0;
  std::istringstream in(text);
  for (float number = 0; in >> number;) ++out;
  return in.eof() ? out : -1;
}

/// Returns the parameters of the command line in the form of a request.
std::string writtenParameters(const ShadetestCommand& command, const TmShader& shader, Log& log) {
  std::string out;
  for (const std::string& given : command.parameters) {
    const size_t at = given.find('=');
    const std::string name = given.substr(0, at), value = at == std::string::npos ? "" : given.substr(at + 1);
    const auto* end = shader.params + shader.paramCount;
    const auto* p = std::find_if(shader.params, end, [&](const TmParamDecl& d) { return d.name == name; });
    if (p == end || at == std::string::npos) {
      log.report(Severity::Missing, "shadetest-parameter", {},
                 fmt::format("shader \"{}\" has no parameter \"{}\"; it is ignored", shader.name, name));
      continue;
    }
    std::string values = value;
    std::replace(values.begin(), values.end(), ',', ' ');
    const int type = TM_TYPE_OF(p->type), needed = p->arrayLength * floatsOf(type);
    const bool text = type == TM_STRING;
    if (!text && numbersIn(values) != needed) {
      log.report(Severity::Missing, "shadetest-parameter", {},
                 fmt::format("\"{}\" takes {} number{}, and not \"{}\"; it is ignored", name, needed,
                             needed == 1 ? "" : "s with commas between them", value));
      continue;
    }
    const std::string array = p->arrayLength > 1 ? fmt::format("[{}]", p->arrayLength) : "";
    out += fmt::format(" \"uniform {}{} {}\" [{}]", typeName(type), array, name, text ? "\"" + value + "\"" : values);
  }
  return out;
}

/// The call that is timed, and what has to be done before each call, which is not timed.
struct Trial {
  std::function<void()> prepare, call;
};

/// Returns the mean nanoseconds of a call, over the calls that fit into a fifth of a second. Shaders print only in a
/// first call, which does not count.
double timeOf(ShadingSystem& shading, const Trial& trial) {
  trial.prepare();
  trial.call();
  shading.silence();
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

void testDisplacement(const Scene& scene, ShadingSystem& shading, const std::array<int, 2>& size) {
  const Grid still = diceAtOpen(scene, 0, 0, UvRect{}, size[0] - 1, size[1] - 1);
  Grid moved;
  const double time_ns = timeOf(shading, {[&] { moved = still; }, [&] { shading.displace(moved); }});
  float longest = 0;
  for (int i = 0; i < still.vertexCount(); ++i)
    longest = std::max(longest, glm::length(moved.position(0, i) - still.position(0, i)));
  std::puts(
      fmt::format("nanoseconds a point: {:.1f}\nlongest displacement: {:.6g}", time_ns / still.vertexCount(), longest)
          .c_str());
}

/// Times a trial, and describes the resulting picture, whose first three channels are colours.
void testColors(const ShadetestCommand& command, ShadingSystem& shading, const Trial& trial,
                const std::function<Image()>& picture, Log& log) {
  const double time_ns = timeOf(shading, trial);
  const Image image = picture();
  const size_t count = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
  vec3 low(kInfinity), high(-kInfinity);
  glm::dvec3 sum(0);  // a sum of floats may leave the mean above the greatest
  for (size_t i = 0; i < count; ++i) {
    const float* pixel = image.pixels.data() + i * image.channels.size();
    const vec3 c(pixel[0], pixel[1], pixel[2]);
    low = glm::min(low, c);
    high = glm::max(high, c);
    sum += c;
  }
  std::puts(fmt::format("nanoseconds a point: {:.1f}", time_ns / static_cast<double>(count)).c_str());
  say("Ci least", low);
  say("Ci mean", vec3(sum / static_cast<double>(count)));
  say("Ci greatest", high);
  if (!command.output.empty()) writeImage(command.output, image, isForScreens(command.output), log);
}

Image blankImage(const std::array<int, 2>& size, std::vector<std::string> channels) {
  Image image;
  image.width = image.displayWidth = size[0];
  image.height = image.displayHeight = size[1];
  image.channels = std::move(channels);
  return image;
}

/// Tests surfaces and lights by the shaded surface, and volumes by what they change about it.
void testPoints(const ShadetestCommand& command, const Scene& scene, ShadingSystem& shading, bool volume, Log& log) {
  const ShadePoints points = shaderScenePoints(scene, shading, command.grid);
  ShadedPoints surface, out;
  if (volume) shading.shade(points, {}, surface);
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
  testColors(command, shading, {prepare, shade}, picture, log);
}

/// Tests on a picture whose grey is half of its alpha, which rises from 0 at the left to 1 at the right.
void testImager(const ShadetestCommand& command, ShadingSystem& shading, Log& log) {
  const auto [width, height] = command.grid;
  Image wedge = blankImage(command.grid, {"R", "G", "B", "A"}), image;
  for (int i = 0; i < width * height; ++i) {
    const float alpha = static_cast<float>(i % width) / static_cast<float>(width - 1), grey = 0.5f * alpha;
    wedge.pixels.insert(wedge.pixels.end(), {grey, grey, grey, alpha});
  }
  testColors(
      command, shading, {[&] { image = wedge; }, [&] { runImager(image, shading); }}, [&] { return image; }, log);
}

void test(const ShadetestCommand& command, const TmShader& shader, ShaderRegistry& registry, Log& log) {
  Stats stats;
  const std::unique_ptr<ShadeServices> space = emptySpaceFor(shader);
  RibSettings rib;
  rib.onScene = [&](Scene&& scene) {
    ShadingSystem shading(scene, registry, space.get(), log, stats);
    std::puts(fmt::format("shader: {}\npoints: {} x {}", shader.name, command.grid[0], command.grid[1]).c_str());
    if (shader.kind == TM_DISPLACEMENT)
      testDisplacement(scene, shading, command.grid);
    else if (shader.kind == TM_IMAGER)
      testImager(command, shading, log);
    else
      testPoints(command, scene, shading, shader.kind == TM_VOLUME, log);
  };
  readRibText(shaderSceneRib(shader, writtenParameters(command, shader, log)), "shadetest", rib, log);
}

void check(const TmShader& shader, Log& log) {
  const std::vector<std::string> faults = faultsOf(shader);
  std::puts(fmt::format("shader: {}\nfaults: {}", shader.name, faults.size()).c_str());
  for (const std::string& fault : faults) log.report(Severity::Missing, "shadetest-check", {}, fault);
}

std::vector<fs::file_time_type> timesOf(const std::vector<std::string>& files) {
  std::vector<fs::file_time_type> out;
  std::error_code none;
  for (const std::string& file : files) out.push_back(fs::last_write_time(file, none));
  return out;
}

struct ShadeOutcome {
  int code = 0;
  std::vector<std::string> files;  ///< The files that the result depends on.
};

ShadeOutcome tryOnce(const ShadetestCommand& command) {
  Log log;
  PluginTrust trust = pluginTrust(Trust{.shaderFolders = command.shaderFolders});
  trust.folders = ".:" + trust.folders;  // the user names the shader, not a scene
  ShaderRegistry registry(log, trust);
  registry.addLibrary(tomales_builtin_shaders(), "built-in");
  const Tried tried = findShaders(command, registry, log);
  if (tried.shaders.empty()) return {std::max<int>(exitCodeOf(log), kUnreadable), tried.files};
  if (!command.check) test(command, *tried.shaders.front(), registry, log);
  for (size_t k = 0; command.check && k < tried.shaders.size(); ++k) check(*tried.shaders[k], log);
  return {exitCodeOf(log), tried.files};
}

}  // namespace

int shadetestCommand(const ShadetestCommand& command) {
  for (;;) {
    const ShadeOutcome outcome = tryOnce(command);
    if (!command.watch || outcome.files.empty()) return outcome.code;
    std::fflush(stdout);
    constexpr auto kLook = std::chrono::milliseconds(100);
    for (const auto before = timesOf(outcome.files); timesOf(outcome.files) == before;
         std::this_thread::sleep_for(kLook))
      if (stopRequested()) return outcome.code;
  }
}

}  // namespace tomales
