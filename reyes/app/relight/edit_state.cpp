#include "reyes/app/relight/edit_state.h"

#include <fmt/format.h>

#include <cmath>

#include "reyes/base/search_path.h"
#include "reyes/rib.h"

namespace tomales {
namespace {

constexpr const char* kTypeNames[] = {"float", "color", "point", "vector", "normal"};
constexpr float kLargest = 1e30f;

const EditableShader* ownedBy(const std::vector<EditableShader>& shaders, const std::string& owner) {
  const auto found = std::ranges::find(shaders, owner, &EditableShader::owner);
  return found == shaders.end() ? nullptr : &*found;
}

const EditableParam* paramOf(const EditableShader& shader, const std::string& name) {
  const auto found = std::ranges::find(shader.params, name, &EditableParam::name);
  return found == shader.params.end() ? nullptr : &*found;
}

EditableShader describe(const std::string& owner, const ShaderCall& call, TmKind kind, const Scene& scene,
                        ShaderRegistry& shaders) {
  EditableShader out{owner, call.name, call.worldFromShader.at(scene.options.shutterOpen), {}};
  const TmShader* shader = shaders.find(call.name, kind, pathOf(scene.options.searchPaths, "shader"));
  for (int i = 0; shader && i < shader->paramCount; ++i) {
    const TmParamDecl& decl = shader->params[i];
    const int32_t type = TM_TYPE_OF(decl.type);
    if (type > TM_NORMAL || decl.arrayLength != 1 || (decl.type & TM_OUTPUT)) continue;
    const size_t floats = type == TM_FLOAT ? 1 : 3;
    EditableParam param{decl.name, kTypeNames[type], decl.doc ? decl.doc : "", roleOf(*shader, decl),
                        std::vector<float>(floats, 0.0f)};
    if (decl.floats) param.value.assign(decl.floats, decl.floats + floats);
    if (const Param* given = findParam(call.params, decl.name); given && given->floats.size() == floats)
      param.value = given->floats;
    out.params.push_back(std::move(param));
  }
  return out;
}

std::vector<float> numbersOf(const Json& json, size_t count, const std::string& what) {
  std::vector<float> out;
  if (json.is_array())
    for (const Json& value : json)
      if (value.is_number() && std::abs(value.get<double>()) <= kLargest) out.push_back(value.get<float>());
  if (out.size() != count || json.size() != count)
    throw BadRequest(fmt::format("{} takes {} finite number{}", what, count, count == 1 ? "" : "s"));
  return out;
}

ShaderEdits editsOf(const Json& json, const std::vector<EditableShader>& shaders, const char* kind) {
  ShaderEdits out;
  if (!json.is_object()) throw BadRequest(fmt::format("{}s are an object of names", kind));
  for (const auto& [owner, params] : json.items()) {
    const EditableShader* shader = ownedBy(shaders, owner);
    if (!shader || !params.is_object()) throw BadRequest(fmt::format("there is no {} \"{}\"", kind, owner));
    for (const auto& [name, value] : params.items()) {
      const EditableParam* param = paramOf(*shader, name);
      if (!param) throw BadRequest(fmt::format("{} \"{}\" has no parameter \"{}\" to change", kind, owner, name));
      out[owner][name] = numbersOf(value, param->value.size(), "\"" + name + "\"");
    }
  }
  return out;
}

std::array<float, 2> exposureOf(const std::vector<float>& numbers) {
  if (numbers.size() != 2 || !(numbers[0] >= 0) || !(numbers[1] > 0))
    throw BadRequest("exposure takes a gain of 0 or more and a gamma above 0");
  return {numbers[0], numbers[1]};
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string paramText(const EditableShader& shader, const std::map<std::string, std::vector<float>>& params) {
  std::string out;
  for (const auto& [name, value] : params)
    out += fmt::format(" {} [{}]", quoted(paramOf(shader, name)->type + " " + name), fmt::join(value, " "));
  return out;
}

/// Takes the requests of an edit file.
class StateReader : public RiSink {
 public:
  StateReader(const Editable& editable, EditState& state) : editable_(editable), state_(state) {}

  void request(const Request& r) override {
    if (r.name == "version" || r.name == "Declare") return;
    if (r.name == "LightSource" || r.name == "AreaLightSource")
      return take(r, editable_.lights, r.args[1].strings[0], "light", state_.lights);
    if (r.name == "Attribute" && r.args[0].strings[0] == "identifier" && findParam(r.params, "name"))
      return void(selected_ = findParam(r.params, "name")->strings.at(0));
    if (r.name == "Surface" && selected_) return take(r, editable_.surfaces, *selected_, "object", state_.surfaces);
    if (r.name == "Exposure") return void(state_.exposure = exposureOf(r.args[0].numbers));
    throw BadRequest(fmt::format("line {}: {} is more than this page changes", r.where.line, r.name));
  }

 private:
  void take(const Request& r, const std::vector<EditableShader>& shaders, const std::string& owner, const char* kind,
            ShaderEdits& to) {
    const EditableShader* shader = ownedBy(shaders, owner);
    if (!shader || shader->shader != r.args[0].strings[0])
      throw BadRequest(fmt::format("line {}: the shot has no {} \"{}\" with the shader \"{}\"", r.where.line, kind,
                                   owner, r.args[0].strings[0]));
    for (const Param& p : r.params) {
      const EditableParam* param = paramOf(*shader, p.name);
      if (!param || p.floats.size() != param->value.size())
        throw BadRequest(fmt::format("line {}: \"{}\" is more than this page changes", r.where.line, p.name));
      to[owner][p.name] = p.floats;
    }
  }

  const Editable& editable_;
  EditState& state_;
  std::optional<std::string> selected_;
};

}  // namespace

Editable editableOf(const Scene& scene, ShaderRegistry& shaders) {
  Editable out;
  for (const auto& light : scene.lights)
    if (!ownedBy(out.lights, light->handle))
      out.lights.push_back(describe(light->handle, light->shader, TM_LIGHT, scene, shaders));
  for (const ShadeGroup& group : scene.groups) {
    const Attributes& a = *group.attributes;
    if (!a.name.empty() && a.surface && !ownedBy(out.surfaces, a.name))
      out.surfaces.push_back(describe(a.name, *a.surface, TM_SURFACE, scene, shaders));
  }
  out.exposure = {scene.options.exposureGain, scene.options.exposureGamma};
  return out;
}

EditState stateOf(const Json& json, const Editable& editable) {
  if (!json.is_object()) throw BadRequest("an edit is an object");
  EditState out;
  for (const auto& [name, value] : json.items()) {
    if (name == "lights")
      out.lights = editsOf(value, editable.lights, "light");
    else if (name == "surfaces")
      out.surfaces = editsOf(value, editable.surfaces, "object");
    else if (name == "exposure")
      out.exposure = exposureOf(numbersOf(value, 2, "exposure"));
    else
      throw BadRequest("an edit has no \"" + name + "\"");
  }
  return out;
}

Json jsonOf(const EditState& state) {
  Json out = {{"lights", Json(state.lights)}, {"surfaces", Json(state.surfaces)}};
  if (state.exposure) out["exposure"] = *state.exposure;
  return out;
}

std::string ribOf(const EditState& state, const Editable& editable) {
  std::string out = "version 3.04\n";  // a file without a request would be none
  for (const EditableShader& light : editable.lights)
    if (const auto edit = state.lights.find(light.owner); edit != state.lights.end() && !edit->second.empty())
      out += fmt::format("LightSource {} {}{}\n", quoted(light.shader), quoted(light.owner),
                         paramText(light, edit->second));
  for (const EditableShader& surface : editable.surfaces)
    if (const auto edit = state.surfaces.find(surface.owner); edit != state.surfaces.end() && !edit->second.empty())
      out += fmt::format("Attribute \"identifier\" \"name\" [{}]\nSurface {}{}\n", quoted(surface.owner),
                         quoted(surface.shader), paramText(surface, edit->second));
  if (state.exposure) out += fmt::format("Exposure {} {}\n", (*state.exposure)[0], (*state.exposure)[1]);
  return out;
}

EditState stateOfRib(const std::string& file, const Editable& editable, Log& log) {
  EditState out;
  StateReader reader(editable, out);
  if (!parseRib({file}, reader, log)) throw BadRequest("this edit cannot be read");
  return out;
}

}  // namespace tomales
