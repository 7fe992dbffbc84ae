#include "reyes/moving_surfaces.h"

#include <mutex>

#include "reyes/base/search_path.h"
#include "reyes/scene_changes.h"
#include "reyes/shade/binder.h"
#include "reyes/shade/parameter_values.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

/// Threads: any.
class MovingSurfaces {
 public:
  MovingSurfaces(std::string searchPath, ShaderRegistry& registry, Log& log)
      : path_(std::move(searchPath)), registry_(registry), log_(log) {}

  void prepare(Attributes& a) {
    displace(a);
    a.displacementOutputs = outputsOf(a.displacement);
  }

  /// Tells whether such attributes change.
  bool changes(const Attributes& a) {
    return displacementOf(a.surface) != nullptr || !outputsOf(a.displacement).empty();
  }

 private:
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
    if (!surface) return nullptr;
    const std::lock_guard lock(mutex_);
    const auto [it, isNew] = known_.try_emplace(surface);
    if (!isNew) return it->second;
    const ShaderName name = nameOf(*surface, TM_DISPLACEMENT);
    if (!registry_.find(kOfSurface + name.name, name.kind, path_, name.beside)) return nullptr;
    auto call = std::make_shared<ShaderCall>(*surface);
    call->name = kOfSurface + name.name;
    return it->second = std::move(call);
  }

  /// Returns the outputs of a displacement shader that surfaces may ask for; none for a surface that moves points.
  std::vector<Param> outputsOf(const std::shared_ptr<const ShaderCall>& displacement) {
    if (!displacement || displacement->name.starts_with(kOfSurface)) return {};
    const std::lock_guard lock(mutex_);
    const auto [it, isNew] = outputs_.try_emplace(displacement);
    std::vector<Param>& out = it->second;
    if (!isNew) return out;
    const ShaderName name = nameOf(*displacement, TM_DISPLACEMENT);
    const TmShader* shader = registry_.find(name.name, name.kind, path_, name.beside);
    for (int i = 0; shader && i < shader->paramCount; ++i) {
      const TmParamDecl& decl = shader->params[i];
      const ValueType type = valueTypeOf(typeOf(decl));
      if (!isOutput(decl) || decl.arrayLength > 1 || type == ValueType::String || type == ValueType::Matrix) continue;
      out.emplace_back().name = decl.name;
      out.back().type = type;
    }
    return out;
  }

  const std::string path_;
  ShaderRegistry& registry_;
  Log& log_;
  std::mutex mutex_;
  std::map<std::shared_ptr<const ShaderCall>, std::shared_ptr<const ShaderCall>> known_;
  std::map<std::shared_ptr<const ShaderCall>, std::vector<Param>> outputs_;
};

}  // namespace

void displaceByMovingSurfaces(Scene& scene, ShaderRegistry& registry, Log& log) {
  const std::string path = pathOf(scene.options.searchPaths, "shader");
  const auto surfaces = std::make_shared<MovingSurfaces>(path, registry, log);
  std::vector<ShaderName> names;
  for (size_t g = 0; g < scene.groups.size(); ++g) {
    const Attributes& a = *scene.groups[g].attributes;
    if (a.surface) names.push_back(nameOf(*a.surface, TM_SURFACE));
    if (a.displacement) names.push_back(nameOf(*a.displacement, TM_DISPLACEMENT));
  }
  registry.prepare(names, path);
  bool any = !scene.procedurals.empty();
  for (size_t g = 0; g < scene.groups.size(); ++g) any |= surfaces->changes(*scene.groups[g].attributes);
  if (any) changeAttributes(scene, [surfaces](Attributes& a) { surfaces->prepare(a); });
}

}  // namespace tomales
