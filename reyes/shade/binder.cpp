#include "reyes/shade/binder.h"

#include <fmt/format.h>

#include <filesystem>

#include "reyes/base/missing_file.h"
#include "reyes/rsl.h"
#include "reyes/rsl_host.h"
#include "reyes/shade/substitute.h"
#include "reyes/shader_registry.h"

namespace tomales {

ShaderName nameOf(const ShaderCall& call, TmKind kind) { return {call.name, kind, call.where.folder().string()}; }

void Binder::expect(const ShaderCall* call, TmKind kind) {
  if (call && expected_.insert(call).second) names_.push_back(nameOf(*call, kind));
}

void Binder::prepare() {
  registry_.prepare(names_, path_);
  names_.clear();
}

BoundShaderPtr Binder::bind(const ShaderCall* call, const SourceLoc& where, const std::string& user, TmKind kind,
                            bool area) {
  const std::string name = call ? call->name : "defaultsurface";
  const std::string beside = call ? nameOf(*call, kind).beside : "";
  const TmShader* shader = registry_.find(name, kind, path_, beside);
  if (const TmShader* form = shader && area ? rslAreaLight(*shader) : nullptr) shader = form;
  const float open = scene_.options.shutterOpen;
  const mat4 currentFromShader = call ? cameraFromWorld_ * call->worldFromShader.at(open) : mat4(1.0f);
  if (shader) return bindShader(*shader, call, where, user, currentFromShader, log_);
  const std::string light = call && kind == TM_LIGHT ? standardLightFor(*call, area) : "";
  const std::string consequences[] = {
      "a magenta checker is rendered", "nothing is displaced",
      light.empty() ? "it casts no light" : fmt::format("\"{}\" stands in for it", light), "the air is clear",
      "the picture stays as it is"};
  log_.report(Severity::Missing, "shader-missing", where,
              fmt::format("{}: {} shader \"{}\" is unknown{}; {}", user, kindName(kind), name,
                          registry_.hintOfMissing(name, kind, path_, beside), consequences[kind]),
              fmt::format("{} {}", kindName(kind), name));
  log_.report(Severity::Note, "shader-folders", {},
              fmt::format("shaders that are not built in (tomales list shaders) were looked for as NAME.sl in {}; "
                          "--shaders FOLDER names another folder",
                          listOfFolders(registry_.textFolders(path_, beside))));
  if (const TmShader* instead = light.empty() ? nullptr : registry_.find(light, kind, path_, beside)) {
    const ShaderCall likely = callFor(*instead, *call);
    return bindShader(*instead, &likely, where, user, currentFromShader, log_);
  }
  if (kind != TM_SURFACE) return nullptr;
  return bindShader(substituteSurface(), nullptr, where, user, currentFromShader, log_);
}

}  // namespace tomales
