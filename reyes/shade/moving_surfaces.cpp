#include "reyes/moving_surfaces.h"

#include <algorithm>

#include "reyes/base/search_path.h"
#include "reyes/scene_changes.h"
#include "reyes/shade/binder.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

bool moves(const ShaderName& name, const std::string& path, ShaderRegistry& registry) {
  const TmShader* surface = registry.find(name.name, name.kind, path, name.beside);
  return surface && registry.displacementOf(*surface);
}

void displace(Attributes& a, ShaderRegistry& registry, const std::string& path, Log& log) {
  if (!a.surface) return;
  const ShaderName name = nameOf(*a.surface, TM_SURFACE);
  if (!moves(name, path, registry)) return;
  if (a.displacement)
    log.report(Severity::Warning, "surface-moves", a.surface->where,
               "surface shader \"" + name.name + "\" assigns P, and displacement shader \"" + a.displacement->name +
                   "\" does so too: the displacement alone moves the surface",
               name.name);
  else
    a.displacement = a.surface;
}

}  // namespace

void displaceByMovingSurfaces(Scene& scene, ShaderRegistry& registry, Log& log) {
  const std::string path = pathOf(scene.options.searchPaths, "shader");
  std::vector<ShaderName> names;
  for (size_t g = 0; g < scene.groups.size(); ++g)
    if (const auto& call = scene.groups[g].attributes->surface) names.push_back(nameOf(*call, TM_SURFACE));
  registry.prepare(names, path);
  const bool any =
      std::any_of(names.begin(), names.end(), [&](const ShaderName& n) { return moves(n, path, registry); });
  if (any || !scene.procedurals.empty())
    changeAttributes(scene, [&registry, &log, path](Attributes& a) { displace(a, registry, path, log); });
}

}  // namespace tomales
