#include "reyes/app/commands/shader_info.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "reyes/base/apart.h"
#include "reyes/base/missing_file.h"
#include "reyes/base/near_names.h"
#include "reyes/base/search_path.h"

namespace tomales {
namespace {

/// Returns the number with the digits that tell it from other floats: 0.8, not 0.800000011920929.
double shortOf(float value) { return std::strtod(fmt::format("{}", value).c_str(), nullptr); }

Json defaultOf(const TmParamDecl& p) {
  const int32_t type = TM_TYPE_OF(p.type);
  Json value = Json::array();
  for (int i = 0; i < p.arrayLength * floatsOf(type); ++i) value.push_back(p.floats ? shortOf(p.floats[i]) : 0.0);
  for (int i = 0; type == TM_STRING && p.strings && i < p.arrayLength; ++i) value.push_back(p.strings[i]);
  return value;
}

Json paramInfo(const TmParamDecl& p) {
  const int32_t type = TM_TYPE_OF(p.type);
  const bool known = type >= TM_FLOAT && type <= TM_MATRIX, output = (p.type & TM_OUTPUT) != 0;
  Json out = {{"name", p.name}, {"type", known ? std::string(output ? "output " : "") + typeName(type) : "?"}};
  if (!output) out["default"] = known ? defaultOf(p) : Json::array();
  out["doc"] = p.doc ? p.doc : "";
  if (const char* role = roleName(p.role)) out["role"] = role;
  return out;
}

/// Returns the parameter by which a scene gives a value to an output, or null if there is none.
const TmParamDecl* inputOf(const TmShader& s, const TmParamDecl& output) {
  for (int i = 0; i < s.paramCount; ++i)
    if (!(s.params[i].type & TM_OUTPUT) && std::string_view(s.params[i].name) == output.name) return &s.params[i];
  return nullptr;
}

bool hasOutput(const TmShader& s, const TmParamDecl& input) {
  return std::any_of(s.params, s.params + s.paramCount, [&](const TmParamDecl& p) {
    return (p.type & TM_OUTPUT) != 0 && std::string_view(p.name) == input.name;
  });
}

}  // namespace

bool isScalarList(const Json& j) {
  return j.is_array() && std::none_of(j.begin(), j.end(), [](const Json& e) { return e.is_structured(); });
}

std::string lineOf(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json shaderInfo(const TmShader& s) {
  Json params = Json::array();
  for (int i = 0; i < s.paramCount; ++i) {
    const TmParamDecl& p = s.params[i];
    const bool output = (p.type & TM_OUTPUT) != 0;
    if (!output && hasOutput(s, p)) continue;
    params.push_back(paramInfo(p));
    if (const TmParamDecl* input = output ? inputOf(s, p) : nullptr) params.back()["default"] = defaultOf(*input);
  }
  Json standard = Json::array();
  for (const TmParamDecl& p : standardParams(static_cast<TmKind>(s.kind))) standard.push_back(paramInfo(p));
  return {{"name", s.name},
          {"kind", s.kind >= 0 && s.kind <= TM_IMAGER ? kindName(static_cast<TmKind>(s.kind)) : "?"},
          {"doc", s.doc ? s.doc : ""},
          {"parameters", params},
          {"standard_parameters", standard}};
}

Json textInfo(const std::string& path, Log& log) {
  const auto file = RslFile::compile(path, {});
  if (file->errors() > 0) {
    log.report(Severity::Error, "shader-read", {}, file->messages());
    return {};
  }
  Json shaders = Json::array();
  for (int32_t k = 0; k < file->library()->count; ++k) {
    const TmShader& shader = *file->library()->shaders[k];
    Json about = shaderInfo(shader);
    const std::vector<RslParameter> details = file->parameters(shader);
    for (size_t at = 0; at < details.size(); ++at)
      for (Json& p : about["parameters"]) {
        if (p["name"] != shader.params[at].name) continue;
        if (!details[at].detail.empty()) p["detail"] = details[at].detail;
        if (details[at].computed) p["default"] = "computed";
      }
    shaders.push_back(std::move(about));
  }
  return {{"file", path}, {"kind", "shaders"}, {"shaders", shaders}};
}

// The plugin's code is run, and may crash, in a process of its own.
Json pluginInfo(const std::string& file, Log& log) {
  constexpr int kMostSeconds = 20;
  const auto describe = [&] {
    ShaderRegistry registry(log);
    if (!registry.loadPlugin(std::filesystem::absolute(file).string())) return std::string();
    Json shaders = Json::array();
    for (const TmShader* shader : registry.all()) shaders.push_back(shaderInfo(*shader));
    return shaders.dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  std::string fate = "is not a shader plugin of this version";
  const std::string shaders = runInFork(describe, kMostSeconds, fate).value_or("");
  if (!shaders.empty()) return {{"file", file}, {"kind", "shaders"}, {"shaders", Json::parse(shaders)}};
  log.report(Severity::Error, "plugin-read", {std::make_shared<std::string>(file), 0}, fate);
  return {};
}

Json namedShaderInfo(const std::string& name, const PluginTrust& trust, Log& log) {
  ShaderRegistry registry(log, trust);
  registry.addLibrary(tomales_builtin_shaders(), "built-in");
  for (const std::string& folder : registry.textFolders("", ""))
    if (const std::string text = findFile(name + ".sl", folder); !text.empty()) return textInfo(text, log);
  if (const std::string plugin = findFile(name + ".so", trust.folders); !plugin.empty()) return pluginInfo(plugin, log);
  Json shaders = Json::array();
  std::vector<std::string> known;
  for (const TmShader* shader : registry.all()) {
    known.push_back(shader->name);
    if (name == shader->name) shaders.push_back(shaderInfo(*shader));
  }
  if (!shaders.empty()) return {{"file", "built-in"}, {"kind", "shaders"}, {"shaders", shaders}};
  log.report(Severity::Error, "file-read", {std::make_shared<std::string>(name), 0},
             fmt::format("is neither a file nor the name of a shader, built in (tomales list shaders), in {} or in a "
                         "folder of --shaders{}",
                         listOfFolders(registry.textFolders("", "")), didYouMean(name, known)));
  return {};
}

}  // namespace tomales
