#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <set>
#include <tuple>

#include "reyes/base/crash_note.h"
#include "reyes/base/input_file.h"
#include "reyes/base/loaded_plugins.h"
#include "reyes/base/missing_file.h"
#include "reyes/base/near_names.h"
#include "reyes/base/plugin_trial.h"
#include "reyes/base/plugin_trust.h"
#include "reyes/base/search_path.h"
#include "reyes/base/trust.h"
#include "reyes/shade/function_plugins.h"
#include "reyes/shade/roles.h"
#include "reyes/shade/rsl_shaders.h"
#include "reyes/shader_registry.h"

namespace tomales {

namespace fs = std::filesystem;

const char* kindName(TmKind kind) {
  static constexpr const char* kNames[] = {"surface", "displacement", "light", "volume", "imager"};
  return kNames[kind];
}

namespace {

/// Shaders whose look RISpec 3.2 (appendix A) fixes: a scene that names one gets ours, which tests hold against it.
bool isOfSpecification(std::string_view name) {
  static constexpr std::string_view kNames[] = {
      "constant",     "matte",      "metal",     "shinymetal", "plastic", "paintedplastic", "ambientlight",
      "distantlight", "pointlight", "spotlight", "depthcue",   "fog",     "bumpy",          "background"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

}  // namespace

struct ShaderRegistry::Impl {
  Log& log;
  const PluginTrust trust;
  const bool standardFromFiles;
  std::mutex mutex;  // over what follows: find() loads plugins while other frames bind
  std::map<std::pair<int, std::string>, const TmShader*> shaders;
  struct Plugin {
    bool loaded = false;
    std::vector<const TmShader*> shaders;
  };
  std::map<std::string, Plugin> plugins;  // by path
  PluginTrial trial;
  bool untriedSaid = false;
  std::set<std::string> distrusted;  // plugins that have been reported as such
  std::set<std::string> toldOf;      // problems of shaders' texts that have been reported
  std::vector<std::shared_ptr<const RslFile>> texts{};
  std::set<const TmShader*> builtIn{};
  std::map<const TmShader*, std::string> origins{};
  std::map<const TmShader*, const TmShader*> displacements{};  ///< by the surfaces that move their points
  std::map<std::tuple<std::string, int, std::string, std::string>, const TmShader*> answers{};
  FunctionPlugins functionPlugins{log};

  void refuse(const std::string& origin, const std::string& problem) {
    const SourceLoc where{std::make_shared<const std::string>(origin), 0};
    log.report(Severity::Missing, "shader-plugin", where, origin + ": " + problem);
  }
  bool add(const TmShaderLibrary* library, const std::string& origin, std::vector<const TmShader*>* added = nullptr);
  bool load(const std::string& path);
  std::vector<std::string> trustedFiles(const std::string& name, const std::string& searchPath);
  std::string heldBy(const std::string& path) const;
  std::vector<std::string> textFolders(const std::string& searchPath, const std::string& beside) const;
  const TmShader* found(const std::string& name, TmKind kind, const std::string& searchPath, const std::string& beside);
  FunctionsOfFolders functionsAlong(const std::string& searchPath);
  const TmShader* search(const std::string& name, TmKind kind, const std::string& searchPath,
                         const std::string& beside);
  const TmShader* findText(const std::string& name, TmKind kind, const std::string& searchPath,
                           const std::string& beside);
  bool comesBeforeTexts(const TmShader& s) const {
    return !builtIn.count(&s) || (!standardFromFiles && isOfSpecification(s.name));
  }
  void tellOfStandardName(const TmShader& used, const std::string& searchPath, const std::string& beside);
  const TmShader* known(const std::string& name, TmKind kind) const {
    const auto it = shaders.find({kind, name});
    return it == shaders.end() ? nullptr : it->second;
  }
};

namespace {

/// Tells what is wrong with the version of a plugin's struct; empty if nothing is. A later release only appends fields
/// (shader_api.h), so a larger struct of the same ABI starts with ours.
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

/// Tells what a shader of our ABI lacks; empty if it lacks nothing.
std::string lackOf(const TmShader& s) {
  if (!s.name || !*s.name) return "a name";
  if (!s.shade) return "a function";
  if (s.kind < TM_SURFACE || s.kind > TM_IMAGER) return "a kind that there is";
  if (s.paramCount < 0 || (s.paramCount > 0 && !s.params)) return "its parameters";
  if (s.paramCount > 0 && s.paramBytes != sizeof(TmParamDecl))
    return fmt::format("parameters of {} bytes each, and has them of {}", sizeof(TmParamDecl), s.paramBytes);
  for (int32_t k = 0; k < s.paramCount; ++k) {
    const TmParamDecl& p = s.params[k];
    if (!p.name || p.arrayLength < 1 || TM_TYPE_OF(p.type) > TM_MATRIX)
      return fmt::format("a name, length or type of parameter {}", k + 1);
    if (p.role == TM_ROLE_NONE) continue;
    const RoleInfo* role = roleInfo(p.role);
    if (!role) return fmt::format("a role that there is of parameter \"{}\"", p.name);
    if (role->type != TM_TYPE_OF(p.type) || role->kind != s.kind)
      return fmt::format("a type or kind that fits the role {} of parameter \"{}\"", role->name, p.name);
  }
  return {};
}

}  // namespace

bool ShaderRegistry::Impl::add(const TmShaderLibrary* library, const std::string& origin,
                               std::vector<const TmShader*>* added) {
  if (const std::string problem = otherVersion(library); !problem.empty())
    return refuse(origin, "the shader library " + problem), false;
  if (library->fault) return refuse(origin, library->fault), false;
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
  if (const std::string fate = trial.fateOf(path); !fate.empty()) return refuse(path, fate + "; it is left out"), false;
  if (!trial.works() && !untriedSaid)
    untriedSaid = true,
    log.report(Severity::Warning, "shader-plugin", {std::make_shared<const std::string>(path), 0},
               "plugins are loaded untried, and may end the program: tomales_plugin_trial cannot be started");
  noteLoadedPlugin(path);
  const CrashNote note({"shader plugin", path.c_str(), "while plugins are loaded", nullptr, nullptr, 0});
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) return refuse(path, fmt::format("cannot be loaded: {}", dlerror())), false;
  const auto function = reinterpret_cast<TmShadersFunction>(dlsym(handle, TM_SHADERS_SYMBOL));
  if (!function) return refuse(path, "is not a shader plugin: it does not export " TM_SHADERS_SYMBOL), false;
  return plugin.loaded = add(function(), path, &plugin.shaders);
}

std::vector<std::string> ShaderRegistry::Impl::trustedFiles(const std::string& name, const std::string& searchPath) {
  PluginFiles found = findPlugins(name, searchPath, trust);
  for (const std::string& file : found.refused)
    if (distrusted.insert(file).second) refuse(file, kPluginRefusal);
  return std::move(found.trusted);
}

ShaderRegistry::ShaderRegistry(Log& log, PluginTrust trust, bool standardFromFiles)
    : impl_(new Impl{log, std::move(trust), standardFromFiles, {}, {}, {}, {}, false, {}, {}}) {}
ShaderRegistry::~ShaderRegistry() = default;

bool ShaderRegistry::addLibrary(const TmShaderLibrary* library, const std::string& origin) {
  const std::lock_guard lock(impl_->mutex);
  impl_->answers.clear();
  std::vector<const TmShader*> added;
  const bool works = impl_->add(library, origin, &added);
  impl_->builtIn.insert(added.begin(), added.end());
  return works;
}

bool ShaderRegistry::loadPlugin(const std::string& path) {
  const std::lock_guard lock(impl_->mutex);
  impl_->answers.clear();
  return impl_->load(path);
}

bool ShaderRegistry::addText(std::shared_ptr<const RslFile> file, const std::string& path) {
  const std::lock_guard lock(impl_->mutex);
  if (file->errors() > 0) return impl_->refuse(path, "does not compile:\n" + file->messages()), false;
  impl_->texts.push_back(file);
  impl_->answers.clear();
  return impl_->add(file->library(), path);
}

std::vector<std::string> ShaderRegistry::Impl::textFolders(const std::string& searchPath,
                                                           const std::string& beside) const {
  std::vector<std::string> out = foldersOf(searchPath);
  std::error_code none;
  for (const std::string& folder : foldersOf(trust.folders))
    if (fs::is_directory(folder, none)) out.push_back(folder);  // folders of a user or an installation may be missing
  out.push_back(beside.empty() ? "." : beside);
  return out;
}

FunctionsOfFolders ShaderRegistry::Impl::functionsAlong(const std::string& searchPath) {
  std::vector<std::string> folders = foldersOf(trust.folders);
  if (trust.sceneFolders)
    for (const std::string& folder : foldersOf(searchPath.empty() ? "." : searchPath)) folders.push_back(folder);
  return {functionPlugins, std::move(folders)};
}

const TmShader* ShaderRegistry::Impl::findText(const std::string& name, TmKind kind, const std::string& searchPath,
                                               const std::string& beside) {
  const RslFound found = findRslShader(name, kind, textFolders(searchPath, beside), functionsAlong(searchPath));
  const auto tell = [&](const std::string& where, const std::string& what) {
    if (toldOf.insert(where + what).second) refuse(where, what);
  };
  if (!found.problem.empty())
    tell(found.file, (found.problem.starts_with("has no") ? "" : "does not compile:\n") + found.problem);
  if (!found.remark.empty()) tell(name, found.remark);
  if (found.shader) origins[found.shader] = found.file;
  if (found.displacement) displacements[found.shader] = found.displacement;
  return found.shader;
}

/// A user whose folder has a "plastic" of its own is told whose it is.
void ShaderRegistry::Impl::tellOfStandardName(const TmShader& used, const std::string& searchPath,
                                              const std::string& beside) {
  if (!isOfSpecification(used.name)) return;
  std::error_code none;
  for (const std::string& folder : textFolders(searchPath, beside)) {
    const std::string file = (fs::path(folder) / (std::string(used.name) + ".sl")).string();
    if (!fs::is_regular_file(file, none)) continue;
    const bool isOurs = builtIn.count(&used) > 0;
    return log.report(
        Severity::Note, "shader-standard", {std::make_shared<const std::string>(file), 0},
        fmt::format("\"{}\" is a shader of RISpec's: {} (--standard-shaders {})", used.name,
                    isOurs ? "the built-in one is used, not this file" : "this file is used, not the built-in one",
                    isOurs ? "files would take this one" : "built-in would take that"),
        used.name);
  }
}

const TmShader* ShaderRegistry::Impl::search(const std::string& name, TmKind kind, const std::string& searchPath,
                                             const std::string& beside) {
  const TmShader* const own = known(name, kind);
  if (own && comesBeforeTexts(*own)) return tellOfStandardName(*own, searchPath, beside), own;
  if (!leavesFolders(name))
    for (const std::string& file : pluginFiles(name, trust.folders))
      if (load(file))
        if (const TmShader* s = known(name, kind); s && s != own) return s;
  if (const TmShader* s = findText(name, kind, searchPath, beside)) {
    if (own) tellOfStandardName(*s, searchPath, beside);
    return s;
  }
  if (own) return own;
  std::vector<std::string> others;  // plugins of that name without such a shader
  for (const std::string& file : trustedFiles(name, searchPath)) {
    if (!load(file)) continue;
    if (const TmShader* s = known(name, kind)) return s;
    others.push_back(file);
  }
  for (const std::string& file : others)
    refuse(file, fmt::format("has no {} \"{}\", but {}", kindName(kind), name, heldBy(file)));
  return nullptr;
}

const TmShader* ShaderRegistry::Impl::found(const std::string& name, TmKind kind, const std::string& searchPath,
                                            const std::string& beside) {
  if (kind == TM_DISPLACEMENT && name.starts_with(kOfSurface)) {
    const auto moving = displacements.find(found(name.substr(std::strlen(kOfSurface)), TM_SURFACE, searchPath, beside));
    return moving == displacements.end() ? nullptr : moving->second;
  }
  const auto [answer, isNew] = answers.try_emplace({name, kind, searchPath, beside}, nullptr);
  if (isNew) answer->second = search(name, kind, searchPath, beside);
  return answer->second;
}

const TmShader* ShaderRegistry::find(const std::string& name, TmKind kind, const std::string& searchPath,
                                     const std::string& beside) {
  const std::lock_guard lock(impl_->mutex);
  return impl_->found(name, kind, searchPath, beside);
}

void ShaderRegistry::prepare(const std::vector<ShaderName>& names, const std::string& searchPath) {
  const std::lock_guard lock(impl_->mutex);
  std::vector<RslRequest> requests;
  std::set<std::tuple<std::string, TmKind, std::string>> seen;  // a hundred thousand objects may name one shader
  for (const ShaderName& n : names) {
    if (!seen.emplace(n.name, n.kind, n.beside).second) continue;
    if (impl_->answers.count({n.name, n.kind, searchPath, n.beside})) continue;
    const TmShader* const own = impl_->known(n.name, n.kind);
    if ((own && impl_->comesBeforeTexts(*own)) || !pluginFiles(n.name, impl_->trust.folders).empty()) continue;
    requests.push_back({n.name, impl_->textFolders(searchPath, n.beside)});
  }
  compileRslShaders(requests, impl_->functionsAlong(searchPath));
}

std::vector<std::string> ShaderRegistry::textFolders(const std::string& searchPath, const std::string& beside) const {
  return impl_->textFolders(searchPath, beside);
}

std::unique_ptr<const RslFunctions> ShaderRegistry::functions(const std::string& searchPath) const {
  return std::make_unique<const FunctionsOfFolders>(impl_->functionsAlong(searchPath));
}

std::string ShaderRegistry::hintOfMissing(const std::string& written, TmKind kind, const std::string& searchPath,
                                          const std::string& beside) const {
  const std::string name = fs::path(withoutShaderEnding(written)).filename().string();
  std::vector<std::string> ofKind;
  {
    const std::lock_guard lock(impl_->mutex);
    for (const auto& [key, shader] : impl_->shaders) {
      if (key.first == kind)
        ofKind.push_back(key.second);
      else if (key.second == name)
        return fmt::format("; the shader of that name is a {}", kindName(static_cast<TmKind>(key.first)));
    }
  }
  const std::string lies = tomales::hintOfMissing(name + ".sl", {".sl"}, impl_->textFolders(searchPath, beside));
  return lies.empty() ? didYouMean(name, ofKind) : lies;
}

std::string ShaderRegistry::originOf(const TmShader& shader) const {
  const std::lock_guard lock(impl_->mutex);
  const auto it = impl_->origins.find(&shader);
  return it == impl_->origins.end() ? "" : it->second;
}

std::vector<std::string> ShaderRegistry::filesOf(const TmShader& shader) const {
  const std::string origin = originOf(shader);
  std::vector<std::string> read = filesOfRslFile(origin);
  if (read.empty() && fs::is_regular_file(origin)) read.push_back(origin);
  return read;
}

std::vector<const TmShader*> ShaderRegistry::all() const {
  const std::lock_guard lock(impl_->mutex);
  std::vector<const TmShader*> out;
  for (const auto& [key, shader] : impl_->shaders) out.push_back(shader);
  return out;
}

}  // namespace tomales
