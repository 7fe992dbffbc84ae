#include "reyes/app/frame/ray_world.h"

#include "raytrace/visible_displacement.h"
#include "reyes/app/frame/hide.h"
#include "reyes/app/frame/overrides.h"
#include "reyes/rib.h"
#include "reyes/shader_registry.h"

namespace tomales {

namespace {

/// Tests whether the groups of two scenes are the same. If not, points of a group would be shaded as another object's.
bool sameGroups(const Scene& a, const Scene& b) {
  const auto alike = [](const ShadeGroup& x, const ShadeGroup& y) {
    return x.cameraFromObject == y.cameraFromObject && x.primvars.size() == y.primvars.size() &&
           x.attributes->name == y.attributes->name;
  };
  return a.lights.size() == b.lights.size() &&
         std::equal(a.groups.begin(), a.groups.end(), b.groups.begin(), b.groups.end(), alike);
}

/// Tells whether attributes differ only in members that nothing but shading reads.
bool sameForRays(const Attributes& a, const Attributes& b) {
  Attributes x = a, y = b;
  for (Attributes* each : {&x, &y}) {
    each->surface = each->atmosphere = nullptr;
    each->color = vec3(1.0f);
    each->lights.clear();
  }
  return x == y;
}

/// Gives a scene the lights of another, and the data that their shaders may ask for.
void takeLights(Scene& scene, const Scene& from) {
  scene.lights = from.lights;
  scene.worldFromNamed = from.worldFromNamed;
  scene.worldFromOpenings = from.worldFromOpenings;
}

}  // namespace

RayGeometry::RayGeometry(Scene scene, ShaderRegistry& shaders, const RenderSettings& settings,
                         const ShadeServices* services, Stats& stats, Log& log)
    : scene_(std::move(scene)), camera_(scene_.options), lights_(scene_.lights) {
  for (const ShadeGroup& group : scene_.groups) attributes_.push_back(group.attributes);
  // This shading stays bound to the present attributes and lights.
  first_ = std::make_unique<ShadingSystem>(scene_, shaders, services, log, stats);
  chooseDisplacements(scene_, camera_, *first_, log);
  rays_ = std::make_unique<RayScene>(scene_, camera_, *first_, raySettings(settings, scene_.options), stats, log);
  tools_ = {rays_.get(), first_.get()};
}
RayGeometry::~RayGeometry() = default;

bool RayGeometry::dressAs(const Shot& shot, ShaderRegistry& shaders, const ShadeServices* services, Stats& stats,
                          Log& log) {
  for (size_t g = 0; g < attributes_.size(); ++g)
    if (!sameForRays(*attributes_[g], *shot.scene.groups[g].attributes)) return false;
  for (size_t g = 0; g < attributes_.size(); ++g) {
    // The choice of chooseDisplacements() stays.
    auto attributes = std::make_shared<Attributes>(*shot.scene.groups[g].attributes);
    attributes->trace = scene_.groups[g].attributes->trace;
    scene_.groups[g].attributes = std::move(attributes);
  }
  for (size_t o = 0; o < scene_.objects.size(); ++o)
    scene_.objects[o].attributes = scene_.groups[static_cast<size_t>(scene_.objects[o].group)].attributes;
  takeLights(scene_, shot.scene);
  first_->setServices(services);
  dressed_ = std::make_unique<ShadingSystem>(scene_, shaders, services, log, stats);
  tools_.shading = dressed_.get();
  for (int g = 0; g < static_cast<int>(attributes_.size()); ++g)
    if (dressed_->group(g).keepsOpacity() != first_->group(g).keepsOpacity() ||
        dressed_->group(g).opaque() != first_->group(g).opaque() ||
        dressed_->group(g).wantsSteps() != first_->group(g).wantsSteps())
      return false;
  return true;
}

RayWorld::RayWorld(const Shot& shot, KeptGeometry& kept, const RenderSettings& settings, Stats& stats, Log& log)
    : shot_(shot), kept_(kept), settings_(settings), stats_(stats), log_(log) {}
RayWorld::~RayWorld() = default;

const RayTools* RayWorld::tools() {
  std::call_once(once_, [this] { found_ = find(); });
  return found_ ? &kept_.geometry->tools() : nullptr;
}

bool RayWorld::find() {
  if (kept_.geometry && kept_.geometry->dressAs(shot_, *kept_.shaders, services_, stats_, log_)) return true;
  kept_.geometry.reset();  // the memory is freed before another one takes its place
  kept_.geometry = build();
  return kept_.geometry != nullptr;
}

void RayWorld::report() const {
  if (found_) kept_.geometry->tools().rays->report(stats_);
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
  takeLights(scene, shot_.scene);
  scene.options = shot_.scene.options;
  scene.freeze();
}

std::unique_ptr<RayGeometry> RayWorld::build() {
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
  if (!settings_.picture.outputRoot.empty()) rib.archivePath.push_back(settings_.picture.outputRoot);
  rib.trust = settings_.input.trust;
  rib.onScene = [&](Scene&& s) {
    if (world++ == shot_.world) scene = std::move(s);
  };
  rib.skipsFrame = [&](int frame) {
    return scene.has_value() || (settings_.input.framesApart && frame != shot_.scene.options.frame);
  };
  rib.onSkipped = [&](int worlds) { world += worlds; };
  std::vector<std::string> files;
  for (const SourceFile& source : shot_.sources) files.push_back(source.path);
  readRib(files, rib, log_);
  if (!scene) return give("the RIB holds no such frame any more");
  scene->options = shot_.scene.options;
  scene->expandAll([](const Attributes&) { return true; });
  if (!sameGroups(*scene, shot_.scene)) return give("its objects are not those of the shot any more");
  dress(*scene);
  if (!sameGroups(*scene, shot_.scene)) return give("its objects are not those of the shot any more");
  return std::make_unique<RayGeometry>(std::move(*scene), *kept_.shaders, settings_, services_, stats_, log_);
}

}  // namespace tomales
