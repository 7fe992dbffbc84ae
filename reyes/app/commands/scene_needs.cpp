#include "reyes/app/commands/scene_needs.h"

#include <algorithm>
#include <filesystem>

#include "reyes/base/file_guesses.h"
#include "reyes/base/missing_file.h"
#include "reyes/base/search_path.h"
#include "reyes/base/text.h"
#include "reyes/pictures.h"
#include "reyes/rsl_host.h"

namespace tomales {
namespace {

/// Tells whether a text seems to name a picture.
bool namesMap(const std::string& text) {
  const std::vector<std::string>& endings = pictureEndings();
  return std::find(endings.begin(), endings.end(), endingOf(text)) != endings.end();
}

/// Returns the name of the first tile, if the name stands for several.
std::string firstTile(std::string name) {
  for (const std::string_view mark : {"<UDIM>", "_MAPID_"})
    if (const size_t at = name.find(mark); at != std::string::npos) name.replace(at, mark.size(), "1001");
  return name;
}

}  // namespace

SceneNeeds::SceneNeeds(const PluginTrust& trust, Log& log) : registry_(log, trust) {
  registry_.addLibrary(tomales_builtin_shaders(), "built-in");
}

void SceneNeeds::add(const FileUse& file) {
  const bool found = !file.path.empty();
  needs_.try_emplace({file.kind, file.name}, Need{found, found ? file.path : file.where.text(), ""});
}

void SceneNeeds::addMade(const Request& request) {
  for (size_t i = 1; i < request.args.size(); ++i)
    made_.insert(request.args[i].strings.begin(), request.args[i].strings.end());
}

void SceneNeeds::addPicture(const std::string& name, const Options& options, const SourceLoc& where) {
  if (needs_.count({"texture", name})) return;
  const std::string path = pathOf(options.searchPaths, "texture");
  const std::vector<std::string> candidates = candidateFiles(firstTile(name), path, textureEndings());
  Need& need = needs_[{"texture", name}];
  const bool made = made_.count(name) > 0;
  need.found = made || !candidates.empty();
  need.from = made ? "made by the scene" : need.found ? candidates.front() : where.text();
  std::vector<std::string> folders = foldersOf(path);
  folders.push_back(".");
  if (!need.found) need.hint = hintOfMissing(name, pictureEndings(), folders);
}

void SceneNeeds::addPictures(const ShaderCall& call, const TmShader* shader, const Options& options) {
  for (const Param& p : call.params)
    for (const std::string& text : p.strings)
      if (namesMap(text)) addPicture(text, options, call.where);
  for (int32_t k = 0; shader && k < shader->paramCount; ++k) {
    const TmParamDecl& decl = shader->params[k];
    if (TM_TYPE_OF(decl.type) != TM_STRING || !decl.strings || findParam(call.params, decl.name)) continue;
    for (int32_t i = 0; i < decl.arrayLength; ++i)
      if (decl.strings[i] && namesMap(decl.strings[i])) addPicture(decl.strings[i], options, call.where);
  }
  if (!shader) return;
  // A shader's texts are messages and forms of names, too.
  for (const std::string& text : rslTexts(*shader))
    if (namesMap(text) && text.find_first_of(" %") == std::string::npos) addPicture(text, options, call.where);
}

void SceneNeeds::addShader(const ShaderCall& call, TmKind kind, const Options& options) {
  if (call.name.empty() || call.name == "null") return;
  const std::string path = pathOf(options.searchPaths, "shader");
  const std::string beside = call.where.folder().string();
  const TmShader* shader = registry_.find(call.name, kind, path, beside);
  Need& need = needs_[{kindName(kind), call.name}];
  need.found = shader;
  need.from = shader ? registry_.originOf(*shader) : call.where.text();
  need.hint = shader ? "" : registry_.hintOfMissing(call.name, kind, path, beside);
  addPictures(call, shader, options);
}

void SceneNeeds::add(const Attributes& a, const Scene& scene) {
  if (!attributes_.insert(&a).second) return;
  const auto take = [&](const std::shared_ptr<const ShaderCall>& call, TmKind kind) {
    if (call && seen_.insert(call.get()).second) addShader(*call, kind, scene.options);
  };
  take(a.surface, TM_SURFACE);
  take(a.displacement, TM_DISPLACEMENT);
  for (const auto& volume : {a.atmosphere, a.interior, a.exterior}) take(volume, TM_VOLUME);
}

void SceneNeeds::add(const Scene& scene, const std::vector<Procedural>& procedurals) {
  for (const Procedural& p : procedurals) {
    add(*p.attributes, scene);
    if (++opened_ > kMostProcedurals) return;
    const Expansion inside = scene.expanded(p);
    for (const Object& o : inside.objects) add(*o.attributes, scene);
    add(scene, inside.procedurals);
  }
}

void SceneNeeds::add(const Scene& scene) {
  seen_.clear();
  attributes_.clear();  // the pointers of earlier frames are dangling
  for (const auto& light : scene.lights) addShader(light->shader, TM_LIGHT, scene.options);
  if (scene.options.imager) addShader(*scene.options.imager, TM_IMAGER, scene.options);
  for (const Object& o : scene.objects) add(*o.attributes, scene);
  add(scene, scene.procedurals);
  for (const DisplayCall& d : scene.options.displays) made_.insert(d.name);
}

Json SceneNeeds::json() const {
  Json out = Json::array();
  for (const auto& [key, need] : needs_) {
    Json one = {{"kind", key.first}, {"name", key.second}, {"found", need.found}, {"from", need.from}};
    if (!need.hint.empty()) one["hint"] = need.hint.substr(need.hint.find_first_not_of("; "));
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace tomales
