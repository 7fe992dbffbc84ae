#include "reyes/app/frame/ray_world.h"

#include "raytrace/visible_displacement.h"
#include "reyes/app/frame/hide.h"
#include "reyes/app/frame/overrides.h"
#include "reyes/rib.h"
#include "reyes/shader_registry.h"

namespace tomales {

struct RayWorld::Built {
  Built(Scene s, ShaderRegistry& shaders, const RenderSettings& settings, const ShadeServices* services, Stats& stats,
        Log& log)
      : scene(std::move(s)), camera(scene.options) {
    shading = std::make_unique<ShadingSystem>(scene, shaders, services, log, stats);
    chooseDisplacements(scene, camera, *shading, log);
    rays = std::make_unique<RayScene>(scene, camera, *shading, raySettings(settings, scene.options), stats, log);
    tools = {rays.get(), shading.get()};
  }
  Scene scene;
  const Camera camera;
  std::unique_ptr<ShadingSystem> shading;
  std::unique_ptr<RayScene> rays;
  RayTools tools;
};

namespace {

/// Tests whether the groups of two scenes are the same: else points of a group would be shaded as another object's.
bool sameGroups(const Scene& a, const Scene& b) {
  const auto alike = [](const ShadeGroup& x, const ShadeGroup& y) {
    return x.cameraFromObject == y.cameraFromObject && x.primvars.size() == y.primvars.size() &&
           x.attributes->name == y.attributes->name;
  };
  return a.lights.size() == b.lights.size() &&
         std::equal(a.groups.begin(), a.groups.end(), b.groups.begin(), b.groups.end(), alike);
}

}  // namespace

RayWorld::RayWorld(const Shot& shot, ShaderRegistry& shaders, const RenderSettings& settings, Stats& stats, Log& log)
    : shot_(shot), shaders_(shaders), settings_(settings), stats_(stats), log_(log) {}
RayWorld::~RayWorld() = default;

const RayTools* RayWorld::tools() {
  std::call_once(once_, [this] { built_ = build(); });
  return built_ ? &built_->tools : nullptr;
}

void RayWorld::report() const {
  if (built_) built_->rays->report(stats_);
}

bool RayWorld::sourcesAreUnchanged() const {
  std::vector<std::string> files;
  for (const SourceFile& source : shot_.sources) files.push_back(source.path);
  return sourcesOf(files) == shot_.sources;
}

// Gives the geometry the shot's attributes: the shot may have been edited, but its geometry has not.
void RayWorld::dress(Scene& scene) const {
  for (Object& object : scene.objects)
    object.attributes = shot_.scene.groups[static_cast<size_t>(object.group)].attributes;
  scene.lights = shot_.scene.lights;
  scene.options = shot_.scene.options;
  scene.freeze();
}

std::unique_ptr<RayWorld::Built> RayWorld::build() {
  const StageTimer timer(stats_, "geometry");
  const auto give = [&](const std::string& why) {
    log_.report(Severity::Missing, "rays-geometry", shot_.scene.where,
                "rays are needed, and the geometry cannot be read again: " + why +
                    "; light is not shadowed and indirect light is left out where an .icf does not give it, and the "
                    "rays of shaders meet nothing");
    return nullptr;
  };
  for (const SourceFile& source : shot_.sources)
    if (source.path == "-") return give("the RIB came from standard input or a pipe");
  if (!sourcesAreUnchanged())
    return give("\"" + shot_.sources.front().path + "\" or what follows it is gone or has changed");
  std::optional<Scene> scene;
  int world = 0;
  RibSettings rib;
  rib.archivePath = {shot_.folder};
  if (!settings_.outputRoot.empty()) rib.archivePath.push_back(settings_.outputRoot);
  rib.trust = settings_.trust;
  rib.onScene = [&](Scene&& s) {
    if (world++ == shot_.world) scene = std::move(s);
  };
  std::vector<std::string> files;
  for (const SourceFile& source : shot_.sources) files.push_back(source.path);
  readRib(files, rib, log_);
  if (!scene) return give("the RIB holds no such frame any more");
  scene->options = shot_.scene.options;
  scene->open([](const Attributes&) { return true; });
  if (!sameGroups(*scene, shot_.scene)) return give("its objects are not those of the shot any more");
  dress(*scene);
  if (!sameGroups(*scene, shot_.scene)) return give("its objects are not those of the shot any more");
  return std::make_unique<Built>(std::move(*scene), shaders_, settings_, services_, stats_, log_);
}

}  // namespace tomales
