#include <dlfcn.h>
#include <fmt/format.h>

#include "reyes/base/crash_note.h"
#include "reyes/base/input_file.h"
#include "reyes/base/loaded_plugins.h"
#include "reyes/base/trust.h"
#include "reyes/shade/registry_impl.h"
#include "reyes/shade/roles.h"

namespace tomales {
namespace {

/// Returns what is wrong with the version of a plugin's struct; empty if nothing is. A later release only appends
/// fields (shader_api.h), so a larger struct of the same ABI starts with ours.
template <class Versioned>
std::string otherVersion(const Versioned* v) {
  if (!v) return "is NULL";
  if (v->abi == TM_SHADER_ABI && v->structBytes >= sizeof(Versioned)) return {};
  return fmt::format(
      "is built for shader ABI {}, {} bytes; this renderer has ABI {}, {} bytes: compile it against the headers of "
      "this "
      "version",
      v->abi, v->structBytes, TM_SHADER_ABI, sizeof(Versioned));
}

/// Returns what a shader of our ABI lacks; empty if it lacks nothing.
std::string lackOf(const TmShader& s) {
  if (!s.name || !*s.name) return "a name";
  if (!s.shade) return "a function";
  if (s.kind < TM_SURFACE || s.kind > TM_IMAGER) return "a valid kind";
  if (s.paramCount < 0 || (s.paramCount > 0 && !s.params)) return "its parameters";
  if (s.paramCount > 0 && s.paramBytes != sizeof(TmParamDecl))
    return fmt::format("parameters of {} bytes each, and has them of {}", sizeof(TmParamDecl), s.paramBytes);
  for (int32_t k = 0; k < s.paramCount; ++k) {
    const TmParamDecl& p = s.params[k];
    if (!p.name || p.arrayLength < 1 || TM_TYPE_OF(p.type) > TM_MATRIX)
      return fmt::format("a name, length or type of parameter {}", k + 1);
    if (p.role == TM_ROLE_NONE) continue;
    const RoleInfo* role = roleInfo(p.role);
    if (!role) return fmt::format("a valid role of parameter \"{}\"", p.name);
    if (role->type != TM_TYPE_OF(p.type) || role->kind != s.kind)
      return fmt::format("a type or kind that fits the role {} of parameter \"{}\"", role->name, p.name);
  }
  return {};
}

}  // namespace

bool ShaderRegistry::Impl::add(const TmShaderLibrary* library, const std::string& origin,
                               std::vector<const TmShader*>* added) {
  if (const std::string problem = otherVersion(library); !problem.empty()) {
    refuse(origin, "the shader library " + problem);
    return false;
  }
  if (library->fault) {
    refuse(origin, library->fault);
    return false;
  }
  for (int32_t i = 0; i < library->count; ++i) {
    const TmShader* shader = library->shaders[i];
    if (const std::string problem = otherVersion(shader); !problem.empty())
      refuse(origin, fmt::format("shader number {} {}", i + 1, problem));
    else if (const std::string lack = lackOf(*shader); !lack.empty())
      refuse(origin, fmt::format("shader number {} lacks {}", i + 1, lack));
    else if (shader->fault)
      refuse(origin, fmt::format("shader \"{}\" {}", shader->name, shader->fault));
    else if (shaders[{shader->kind, shader->name}] = shader, origins[shader] = origin; added)
      added->push_back(shader);
  }
  return true;
}

std::string ShaderRegistry::Impl::heldBy(const std::string& path) const {
  std::string out;
  for (const TmShader* s : plugins.at(path).shaders)
    out += fmt::format("{}{} \"{}\"", out.empty() ? "" : ", ", kindName(static_cast<TmKind>(s->kind)), s->name);
  return out.empty() ? "no shader at all" : out;
}

// Plugins are never closed: a bound shader may outlive the registry.
bool ShaderRegistry::Impl::load(const std::string& path) {
  if (const auto it = plugins.find(path); it != plugins.end()) return it->second.loaded;
  Plugin& plugin = plugins[path];
  if (const std::string problem = inputProblem(path); !problem.empty()) {
    refuse(path, "cannot be loaded: " + problem);
    return false;
  }
  if (const std::string fate = trial.fateOf(path); !fate.empty()) {
    refuse(path, fate + "; it is left out");
    return false;
  }
  if (!trial.works() && !untriedSaid) {
    untriedSaid = true;
    log.report(Severity::Warning, "shader-plugin", {std::make_shared<const std::string>(path), 0},
               "plugins are loaded untried, and may end the program: tomales_plugin_trial cannot be started");
  }
  noteLoadedPlugin(path);
  const CrashNote note({"shader plugin", path.c_str(), "while plugins are loaded", nullptr, nullptr, 0});
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) {
    refuse(path, fmt::format("cannot be loaded: {}", dlerror()));
    return false;
  }
  const auto function = reinterpret_cast<TmShadersFunction>(dlsym(handle, TM_SHADERS_SYMBOL));
  if (!function) {
    refuse(path, "is not a shader plugin: it does not export " TM_SHADERS_SYMBOL);
    return false;
  }
  return plugin.loaded = add(function(), path, &plugin.shaders);
}

std::vector<std::string> ShaderRegistry::Impl::trustedFiles(const std::string& name, const std::string& searchPath) {
  PluginFiles found = findPlugins(name, searchPath, trust);
  for (const std::string& file : found.refused)
    if (distrusted.insert(file).second) refuse(file, kPluginRefusal);
  return std::move(found.trusted);
}

}  // namespace tomales
