#include "reyes/moving_surfaces.h"

#include <mutex>

#include "reyes/base/search_path.h"
#include "reyes/scene_changes.h"
#include "reyes/shade/binder.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

/// Threads: any.
class MovingSurfaces {
 public:
  MovingSurfaces(std::string searchPath, ShaderRegistry& registry, Log& log)
      : path_(std::move(searchPath)), registry_(registry), log_(log) {}

  void displace(Attributes& a) {
    if (!a.surface || (a.displacement && a.displacement->name.starts_with(kOfSurface)))
      return;  // a shot has it already
    const std::shared_ptr<const ShaderCall> moving = displacementOf(a.surface);
    if (!moving) return;
    if (!a.displacement)
      a.displacement = moving;
    else
      log_.report(Severity::Warning, "surface-moves", a.surface->where,
                  "surface shader \"" + a.surface->name + "\" assigns P, and displacement shader \"" +
                      a.displacement->name + "\" moves points too: the displacement alone moves the surface",
                  a.surface->name);
  }

  /// Returns null if the surface leaves points where they are.
  std::shared_ptr<const ShaderCall> displacementOf(const std::shared_ptr<const ShaderCall>& surface) {
    const std::lock_guard lock(mutex_);
    const auto [it, isNew] = known_.try_emplace(surface);
    if (!isNew) return it->second;
    const ShaderName name = nameOf(*surface, TM_DISPLACEMENT);
    if (!registry_.find(kOfSurface + name.name, name.kind, path_, name.beside)) return nullptr;
    auto call = std::make_shared<ShaderCall>(*surface);
    call->name = kOfSurface + name.name;
    return it->second = std::move(call);
  }

 private:
  const std::string path_;
  ShaderRegistry& registry_;
  Log& log_;
  std::mutex mutex_;
  std::map<std::shared_ptr<const ShaderCall>, std::shared_ptr<const ShaderCall>> known_;
};

}  // namespace

void displaceByMovingSurfaces(Scene& scene, ShaderRegistry& registry, Log& log) {
  const std::string path = pathOf(scene.options.searchPaths, "shader");
  const auto surfaces = std::make_shared<MovingSurfaces>(path, registry, log);
  std::vector<ShaderName> names;
  for (size_t g = 0; g < scene.groups.size(); ++g)
    if (const auto& call = scene.groups[g].attributes->surface) names.push_back(nameOf(*call, TM_SURFACE));
  registry.prepare(names, path);
  bool any = !scene.procedurals.empty();
  for (size_t g = 0; g < scene.groups.size(); ++g)
    if (const auto& call = scene.groups[g].attributes->surface) any |= surfaces->displacementOf(call) != nullptr;
  if (any) changeAttributes(scene, [surfaces](Attributes& a) { surfaces->displace(a); });
}

}  // namespace tomales
