#include "reyes/app/relight/editable.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "reyes/base/search_path.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

constexpr uintmax_t kMostText_bytes = 1 << 20;

/// Returns a parameter as a shader declares it; nothing if it is none that a page changes.
std::optional<EditableParam> paramOf(const TmParamDecl& decl, TmRole role, const ParamList& given) {
  const int32_t type = TM_TYPE_OF(decl.type);
  if (type < TM_FLOAT || type > TM_MATRIX || decl.arrayLength < 1 || (decl.type & TM_OUTPUT) || role == TM_ROLE_GROUP)
    return std::nullopt;
  const auto length = static_cast<size_t>(decl.arrayLength);
  const std::string array = length == 1 ? "" : fmt::format("[{}]", length);
  EditableParam out{decl.name, typeName(type) + array, decl.doc ? decl.doc : "", role, {}};
  const size_t floats = length * static_cast<size_t>(floatsOf(type));
  out.value.numbers.assign(floats, 0.0f);
  if (decl.floats) out.value.numbers.assign(decl.floats, decl.floats + floats);
  for (size_t i = 0; type == TM_STRING && i < length; ++i)
    out.value.texts.emplace_back(decl.strings ? decl.strings[i] : "");
  const Param* param = findParam(given, decl.name);
  if (param && param->floats.size() == floats) out.value.numbers = param->floats;
  if (param && type == TM_STRING && param->strings.size() == length) out.value.texts = param->strings;
  return out;
}

/// Returns the parameter of a light's request that names its group.
std::string groupOf(const ShaderCall& call) {
  for (const TmParamDecl& decl : standardParams(TM_LIGHT))
    if (const Param* given = findParam(call.params, decl.name);
        decl.role == TM_ROLE_GROUP && given && given->strings.size() == 1)
      return fmt::format(" \"string {}\" [\"{}\"]", decl.name, given->strings[0]);
  return "";
}

/// Returns the names of files of this ending in a folder.
std::set<std::string> namesIn(const std::string& folder, const std::string& ending) {
  std::set<std::string> out;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == ending) out.insert(entry.path().stem().string());
  return out;
}

/// Tells whether there seems to be a shader of this kind in a text. It need not compile.
bool seemsToHave(const fs::path& file, TmKind kind, const std::string& name) {
  std::error_code none;
  if (fs::file_size(file, none) > kMostText_bytes) return false;
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  for (size_t at = text.find(kindName(kind)); at != std::string::npos; at = text.find(kindName(kind), at + 1)) {
    size_t next = text.find_first_not_of(" \t\r\n", at + std::string_view(kindName(kind)).size());
    if (next != std::string::npos && text.compare(next, name.size(), name) == 0) return true;
  }
  return false;
}

}  // namespace

const EditableParam* EditableShader::param(const std::string& name) const {
  const auto found = std::ranges::find(params, name, &EditableParam::name);
  return found == params.end() ? nullptr : &*found;
}

Editable::Editable(const Scene& scene, ShaderRegistry& shaders, const PluginTrust& trust)
    : registry_(shaders),
      searchPath_(pathOf(scene.options.searchPaths, "shader")),
      pluginFolders_(trust.folders + (trust.sceneFolders ? ":" + searchPath_ : "")),
      beside_(scene.where.folder().string()),
      shutterOpen_(scene.options.shutterOpen),
      exposure_{scene.options.exposureGain, scene.options.exposureGamma} {
  for (const auto& light : scene.lights)
    if (!find(kLights, light->handle)) shaders_[kLights].push_back(describe(light->handle, light->shader, TM_LIGHT));
  for (const ShadeGroup& group : scene.groups) {
    const Attributes& a = *group.attributes;
    if (a.name.empty() || object(a.name)) continue;
    EditableObject object{a.name, a.color, {}};
    for (const int light : a.lights) object.lights.insert(scene.lights[static_cast<size_t>(light)]->handle);
    objects_.push_back(std::move(object));
    const ShaderCall noSurface{"defaultsurface", {}, Motion::still(mat4(1.0f)), {}};
    const ShaderCall noAir{"", {}, Motion::still(mat4(1.0f)), {}};
    shaders_[kSurfaces].push_back(describe(a.name, a.surface ? *a.surface : noSurface, TM_SURFACE));
    shaders_[kAtmospheres].push_back(describe(a.name, a.atmosphere ? *a.atmosphere : noAir, TM_VOLUME));
  }
  const std::optional<ShaderCall>& imager = scene.options.imager;
  shaders_[kImagers].push_back(imager ? describe(kImager, *imager, TM_IMAGER) : EditableShader{kImager, ""});
}

EditableShader Editable::describe(const std::string& owner, const ShaderCall& call, TmKind kind) const {
  EditableShader out{owner, call.name, call.worldFromShader.at(shutterOpen_)};
  const std::string beside = call.where.file ? call.where.folder().string() : beside_;
  const TmShader* shader = call.name.empty() ? nullptr : registry_.find(call.name, kind, searchPath_, beside);
  if (!shader) return out;
  for (int i = 0; i < shader->paramCount; ++i)
    if (auto param = paramOf(shader->params[i], roleOf(*shader, shader->params[i]), call.params))
      out.params.push_back(std::move(*param));
  // Lights have these parameters even if they do not declare them. Only the shadow-casting lights of RISpec have
  // further maps.
  for (const TmParamDecl& decl : standardParams(kind))
    if (!out.param(decl.name) && !std::string_view(decl.name).starts_with("sf"))
      if (auto param = paramOf(decl, static_cast<TmRole>(decl.role), call.params))
        out.params.push_back(std::move(*param));
  if (kind == TM_LIGHT) out.group = groupOf(call);
  return out;
}

const EditableShader* Editable::find(ShaderSlot slot, const std::string& owner) const {
  const auto found = std::ranges::find(shaders_[slot], owner, &EditableShader::owner);
  return found == shaders_[slot].end() ? nullptr : &*found;
}

const EditableObject* Editable::object(const std::string& name) const {
  const auto found = std::ranges::find(objects_, name, &EditableObject::name);
  return found == objects_.end() ? nullptr : &*found;
}

std::vector<std::string> Editable::offered(ShaderSlot slot) const {
  const TmKind kind = kSlots[slot].kind;
  std::set<std::string> out;
  if (slot == kAtmospheres) out.insert(kNoShader);
  for (const TmShader* shader : registry_.all())
    if (shader->kind == kind) out.insert(shader->name);
  for (const std::string& folder : registry_.textFolders(searchPath_, beside_))
    for (const std::string& name : namesIn(folder, ".sl"))
      if (seemsToHave(fs::path(folder) / (name + ".sl"), kind, name)) out.insert(name);
  // The shaders of a plugin are known only when it is loaded.
  for (const std::string& folder : foldersOf(pluginFolders_)) out.merge(namesIn(folder, ".so"));
  return {out.begin(), out.end()};
}

const EditableShader* Editable::describe(ShaderSlot slot, const std::string& name) const {
  const std::lock_guard lock(mutex_);
  if (const auto known = offered_[slot].find(name); known != offered_[slot].end()) return &known->second;
  const std::vector<std::string> names = offered(slot);
  if (!std::ranges::binary_search(names, name)) return nullptr;
  if (name != kNoShader && !registry_.find(name, kSlots[slot].kind, searchPath_, beside_)) return nullptr;
  const ShaderCall call{name == kNoShader ? "" : name, {}, Motion::still(mat4(1.0f)), {}};
  EditableShader described = describe("", call, kSlots[slot].kind);
  described.shader = name;
  return &offered_[slot].emplace(name, std::move(described)).first->second;
}

}  // namespace tomales
