#include "reyes/app/commands/shader_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reyes/app/commands/guarded_shader.h"
#include "reyes/app/commands/shader_scene.h"
#include "reyes/base/apart.h"
#include "reyes/dice.h"
#include "reyes/frame.h"
#include "reyes/image.h"
#include "reyes/rib.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

constexpr std::array<int, 2> kGrid{13, 7};  // so that the last lanes of arrays are padding
constexpr int kMostSeconds = 60;            // for a shader that does not end

bool isBuiltIn(const TmShader& shader) {
  const TmShaderLibrary* library = tomales_builtin_shaders();
  return std::find(library->shaders, library->shaders + library->count, &shader) != library->shaders + library->count;
}

/// Checks the shader in its scene, whose colour and opacity are uneven.
class Check {
 public:
  Check(const TmShader& shader, const Scene& scene, const ShadingSystem& shading, const Log& log)
      : shader_(shader), scene_(scene), shading_(shading), log_(log) {}

  /// Returns what faultsOf() does.
  std::vector<std::string> faults() const {
    std::string fate;
    const std::optional<std::string> lines = runInFork([&] { return runAll(); }, kMostSeconds, fate);
    if (!lines) return {fmt::format("shader \"{}\" {}", shader_.name, fate)};
    std::vector<std::string> out;
    for (size_t begin = 0, end; (end = lines->find('\n', begin)) != std::string::npos; begin = end + 1)
      out.push_back(lines->substr(begin, end - begin));
    if (shader_.unlist && !isBuiltIn(shader_))  // lights of the scene would add parameters of the same library
      addUnlisted(out);
    return out;
  }

 private:
  /// Returns a line for each fault.
  std::string runAll() const {
    run({});
    if (shader_.kind == TM_SURFACE) {
      checkEmission();
      checkEvenness();
    }
    std::string out;
    for (const std::string& fault : guardedFaults()) out += fmt::format("shader \"{}\" {}\n", shader_.name, fault);
    for (const LogEntry& e : log_.entries())  // adds the messages of the renderer, not those of the shader
      if (e.code.starts_with("shader-") && !e.code.starts_with("shader-says")) out += e.message + "\n";
    return out;
  }

  void run(const ShadeContext& context, bool turned = false) const {
    if (shader_.kind == TM_DISPLACEMENT) {
      Grid grid = diceAtOpen(scene_, 0, 0, UvRect{}, kGrid[0] - 1, kGrid[1] - 1);
      return shading_.displace(grid);
    }
    if (shader_.kind == TM_IMAGER) {
      Image image;
      image.width = image.displayWidth = kGrid[0];
      image.height = image.displayHeight = kGrid[1];
      image.channels = {"R", "G", "B", "A"};
      image.pixels.assign(static_cast<size_t>(4 * kGrid[0] * kGrid[1]), 0.5f);
      return runImager(image, shading_);
    }
    ShadePoints points = shaderScenePoints(scene_, shading_, kGrid);
    for (int i = 1; turned && i < points.count(); i += 2) points.set3(kIx, i, -points.get3(kIx, i));
    shading_.shade(points, context, out_);
    if (shader_.kind == TM_VOLUME) shading_.atmosphere(points, out_);
  }

  static constexpr int kPoints = kGrid[0] * kGrid[1];

  void checkEmission() const {
    if (shader_.capabilities & TM_EMITS) return;
    ShadeContext dark;
    dark.kind = RayKind::Diffuse;
    dark.illumination = Illumination::None;
    run(dark);
    for (int i = 0; i < kPoints; ++i)
      if (out_.color(i) != vec3(0)) return noteFault("adds light where there is none, but has not declared TM_EMITS");
  }

  void checkEvenness() const {
    if (!(shader_.capabilities & TM_EVEN)) return;
    ShadeContext even;
    even.kind = RayKind::Diffuse;
    even.illumination = Illumination::Unit;
    run(even, true);
    const auto differ = [](const vec3& a, const vec3& b) {
      return glm::any(glm::greaterThan(glm::abs(a - b), 1e-4f * glm::max(vec3(1), glm::abs(a))));
    };
    for (int i = 1; i < kPoints; ++i)
      if (differ(out_.color(0), out_.color(i)) || differ(out_.opacity(0), out_.opacity(i)))
        return noteFault("does not look the same everywhere and from both sides under even light, as TM_EVEN declares");
  }

  void addUnlisted(std::vector<std::string>& out) const {
    const auto silently = [&] {
      run({});
      return std::string();
    };
    std::string fate;
    for (int k = 0; const char* name = shader_.unlist(&shader_, k); ++k)
      if (!runInFork(silently, kMostSeconds, fate) && fate.starts_with("crashes"))
        out.push_back(
            fmt::format("shader \"{}\" reads the parameter \"{}\", which it does not list", shader_.name, name));
  }

  const TmShader& shader_;
  const Scene& scene_;
  const ShadingSystem& shading_;
  const Log& log_;
  mutable ShadedPoints out_;
};

}  // namespace

std::vector<std::string> faultsOf(const TmShader& shader) {
  Log log(Log::Verbosity::Quiet);
  Stats stats;
  ShaderRegistry registry(log);
  registry.addLibrary(tomales_builtin_shaders(), "built-in");
  registry.addLibrary(guardedLibrary(shader), "guarded");
  std::string rib = shaderSceneRib(shader);
  constexpr std::string_view kWorld = "WorldBegin\n";
  rib.insert(rib.find(kWorld) + kWorld.size(), "Color 0.9 0.6 0.3\nOpacity 0.25 0.5 0.75\n");
  std::vector<std::string> out;
  const std::unique_ptr<ShadeServices> space = emptySpaceFor(shader);
  RibSettings settings;
  settings.onScene = [&](Scene&& scene) {
    const ShadingSystem shading(scene, registry, space.get(), log, stats);
    out = Check(shader, scene, shading, log).faults();
  };
  readRibText(rib, "shadetest", settings, log);
  return out;
}

}  // namespace tomales
