#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "reyes/base/file_guesses.h"
#include "reyes/base/missing_file.h"
#include "reyes/base/near_names.h"
#include "reyes/base/plugin_trust.h"
#include "reyes/base/search_path.h"
#include "reyes/base/trust.h"
#include "reyes/shade/registry_impl.h"

namespace tomales {

namespace fs = std::filesystem;

const char* kindName(TmKind kind) {
  static constexpr const char* kNames[] = {"surface", "displacement", "light", "volume", "imager"};
  return kNames[kind];
}

bool isOfSpecification(std::string_view name) {
  static constexpr std::string_view kNames[] = {
      "constant",     "matte",      "metal",     "shinymetal", "plastic", "paintedplastic", "ambientlight",
      "distantlight", "pointlight", "spotlight", "depthcue",   "fog",     "bumpy",          "background"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

namespace {

/// Tells whether the file compiles, though it has no shader of that name and kind.
bool compiles(const RslFound& found) { return found.problem.starts_with("has no"); }
std::string whyNot(const RslFound& found) { return (compiles(found) ? "" : "does not compile:\n") + found.problem; }

/// Returns the name of a parameter that the first shader has and the second lacks; empty if there is none.
std::string furtherParameter(const TmShader& shader, const TmShader& other) {
  std::set<std::string_view> known;
  for (const TmParamDecl& p : standardParams(static_cast<TmKind>(other.kind))) known.insert(p.name);
  for (int32_t k = 0; k < other.paramCount; ++k) known.insert(other.params[k].name);
  for (int32_t k = 0; k < shader.paramCount; ++k)
    if (!known.count(shader.params[k].name)) return shader.params[k].name;
  return {};
}

}  // namespace

ShaderRegistry::ShaderRegistry(Log& log, PluginTrust trust, std::optional<bool> standardFromFiles)
    : impl_(new Impl{log, std::move(trust), standardFromFiles, {}, {}, {}, {}, false, {}, {}}) {}
ShaderRegistry::~ShaderRegistry() = default;

bool ShaderRegistry::addLibrary(const TmShaderLibrary* library, const std::string& origin) {
  const std::lock_guard lock(impl_->mutex);
  impl_->forgetAnswers();
  std::vector<const TmShader*> added;
  const bool works = impl_->add(library, origin, &added);
  impl_->builtIn.insert(added.begin(), added.end());
  return works;
}

bool ShaderRegistry::loadPlugin(const std::string& path) {
  const std::lock_guard lock(impl_->mutex);
  impl_->forgetAnswers();
  return impl_->load(path);
}

bool ShaderRegistry::addText(const std::shared_ptr<const RslFile>& file, const std::string& path) {
  const std::lock_guard lock(impl_->mutex);
  if (file->errors() > 0) {
    impl_->refuseText(path, "does not compile:\n" + file->messages());
    return false;
  }
  impl_->texts.push_back(file);
  impl_->forgetAnswers();
  return impl_->add(file->library(), path);
}

std::vector<std::string> ShaderRegistry::Impl::textFolders(const std::string& searchPath,
                                                           const std::string& beside) const {
  std::vector<std::string> out = foldersOf(searchPath);
  for (const std::string& folder : foldersOf(trust.chosen)) out.push_back(folder);
  if (!beside.empty()) out.push_back(beside);
  out.push_back(".");
  std::error_code none;
  for (const std::string& folder : foldersOf(trust.folders))
    if (fs::is_directory(folder, none)) out.push_back(folder);  // folders of a user or an installation may be missing
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
    if (toldOf.insert(where + what).second) refuseText(where, what);
  };
  if (!found.problem.empty()) {
    tell(found.file, whyNot(found));
    if (!compiles(found)) broken[{name, kind, searchPath, beside}] = found.file;
  }
  if (!found.remark.empty()) tell(name, found.remark);
  if (found.shader) tellOfOtherFolder(name, found);
  return keep(found);
}

const TmShader* ShaderRegistry::Impl::keep(const RslFound& found) {
  if (found.shader) origins[found.shader] = found.file;
  if (found.displacement) displacements[found.shader] = found.displacement;
  return found.shader;
}

/// Reports a name with folders of which only the last part was found.
void ShaderRegistry::Impl::tellOfOtherFolder(const std::string& name, const RslFound& found) {
  std::string written = withoutShaderEnding(name);
  std::replace(written.begin(), written.end(), '\\', '/');
  if (lastPartOf(written).empty() || found.file.ends_with(written + ".sl")) return;
  log.report(Severity::Note, "shader-elsewhere", {},
             fmt::format("shader \"{}\" is not there; {} is taken, which has its name", name, found.file), name);
}

/// If a folder has a shader with a standard name such as "plastic", reports which of the two is used. `because` follows
/// the names. `hasOther`: --standard-shaders can select the other one.
void ShaderRegistry::Impl::tellOfStandardName(const TmShader& used, const std::string& file, const std::string& because,
                                              bool hasOther) {
  if (file.empty()) return;
  const bool isOurs = builtIn.count(&used) > 0;
  const char* const other =
      isOurs ? " (--standard-shaders files would take this one)" : " (--standard-shaders built-in would take that)";
  log.report(Severity::Note, "shader-standard", {std::make_shared<const std::string>(file), 0},
             fmt::format("\"{}\" is a shader of RISpec's: {}{}{}", used.name,
                         isOurs ? "the built-in one is used, not this file" : "this file is used, not the built-in one",
                         because, hasOther ? other : ""),
             used.name);
}

std::string ShaderRegistry::Impl::fileOfStandardName(const TmShader& shader, const std::string& searchPath,
                                                     const std::string& beside) const {
  std::error_code none;
  if (isOfSpecification(shader.name))
    for (const std::string& folder : textFolders(searchPath, beside))
      if (const fs::path file = fs::path(folder) / (std::string(shader.name) + ".sl"); fs::is_regular_file(file, none))
        return file.string();
  return {};
}

const TmShader* ShaderRegistry::Impl::ofStandardName(const TmShader& ours, const std::string& searchPath,
                                                     const std::string& beside) {
  const std::string file = fileOfStandardName(ours, searchPath, beside);
  if (file.empty() || !builtIn.count(&ours) || standardFromFiles) {
    tellOfStandardName(ours, file);
    return &ours;
  }
  const auto kind = static_cast<TmKind>(ours.kind);
  const RslFound found = findRslShader(ours.name, kind, textFolders(searchPath, beside), functionsAlong(searchPath));
  if (!found.shader) {
    tellOfStandardName(ours, file, ", which " + whyNot(found), false);
    return &ours;
  }
  const std::string further = furtherParameter(*found.shader, ours);
  const TmShader& used = further.empty() ? ours : *keep(found);
  tellOfStandardName(used, found.file, further.empty() ? "" : fmt::format(", which has no parameter \"{}\"", further));
  return &used;
}

const TmShader* ShaderRegistry::Impl::search(const std::string& name, TmKind kind, const std::string& searchPath,
                                             const std::string& beside) {
  const TmShader* const own = known(name, kind);
  if (own && comesBeforeTexts(*own)) return ofStandardName(*own, searchPath, beside);
  if (!leavesFolders(name))
    for (const std::string& file : pluginFiles(name, trust.folders))
      if (load(file))
        if (const TmShader* s = known(name, kind); s && s != own) return s;
  if (const TmShader* s = findText(name, kind, searchPath, beside)) {
    if (own) tellOfStandardName(*s, fileOfStandardName(*s, searchPath, beside));
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
  return standardNameWithFolders(name, kind);
}

/// Returns the built-in shader of RISpec's that a name means which has an ending, or folders of another machine before
/// it.
const TmShader* ShaderRegistry::Impl::standardNameWithFolders(const std::string& name, TmKind kind) {
  const std::string written = withoutShaderEnding(name), last = lastPartOf(written);
  const TmShader* const meant = known(last.empty() ? written : last, kind);
  if (!meant || !isOfSpecification(meant->name) || builtIn.count(meant) == 0) return nullptr;
  log.report(
      Severity::Note, "shader-elsewhere", {},
      fmt::format("shader \"{}\" is not there; the built-in \"{}\" is taken, which has its name", name, meant->name),
      name);
  return meant;
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
    const auto text = impl_->broken.find({written, kind, searchPath, beside});
    if (text != impl_->broken.end()) return fmt::format("; its text \"{}\" has errors", text->second);
    for (const auto& [key, shader] : impl_->shaders) {
      if (key.first == kind)
        ofKind.push_back(key.second);
      else if (key.second == name)
        return fmt::format("; the shader of that name is a {}", kindName(static_cast<TmKind>(key.first)));
    }
  }
  for (const char* ending : {".sl", ".so"}) {
    const std::string lies = tomales::hintOfMissing(name + ending, {ending}, impl_->textFolders(searchPath, beside));
    if (!lies.empty()) return lies;
  }
  return didYouMean(name, ofKind);
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
