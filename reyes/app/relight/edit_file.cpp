// Edits as files of `tomales shade --edit`.
#include <fmt/format.h>

#include "reyes/app/relight/edit_state.h"
#include "reyes/rib.h"

namespace tomales {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string textOf(const ParamValue& value) {
  if (value.texts.empty()) return fmt::format("[{}]", fmt::join(value.numbers, " "));
  std::vector<std::string> texts;
  for (const std::string& text : value.texts) texts.push_back(quoted(text));
  return fmt::format("[{}]", fmt::join(texts, " "));
}

/// Returns the request of a shader; nothing if it is as in the scene. `handle`: of a light.
std::string requestOf(const EditState& state, ShaderSlot slot, const std::string& owner, const Editable& editable,
                      const std::string& handle = "") {
  const ShaderEdit* edit = state.edit(slot, owner);
  if (!edit || (edit->shader.empty() && edit->params.empty())) return "";
  const EditableShader& shader = shaderUnder(state, slot, owner, editable);
  std::string out = fmt::format("{} {}{}", kSlots[slot].request, quoted(shader.shader), handle);
  for (const auto& [name, value] : edit->params)
    out += fmt::format(" {} {}", quoted(shader.param(name)->type + " " + name), textOf(value));
  if (!edit->shader.empty()) out += editable.find(slot, owner)->group;
  return out + "\n";
}

std::string requestsOf(const EditState& state, const std::string& object, const Editable& editable) {
  std::string out;
  if (const auto edit = state.objects.find(object); edit != state.objects.end()) {
    if (edit->second.color) out += fmt::format("Color [{}]\n", fmt::join(*edit->second.color, " "));
    for (const auto& [light, shines] : edit->second.lights)
      out += fmt::format("Illuminate {} {}\n", quoted(light), shines ? 1 : 0);
  }
  out += requestOf(state, kSurfaces, object, editable) + requestOf(state, kAtmospheres, object, editable);
  if (out.empty()) return "";
  return fmt::format("Attribute \"identifier\" \"name\" [{}]\n", quoted(object)) + out;
}

/// Converts the requests of an edit file to JSON, which is then checked like the JSON of a page.
class StateReader : public RiSink {
 public:
  StateReader(const Editable& editable, Json& json) : editable_(editable), json_(json) {}

  void request(const Request& r) override {
    if (r.name == "version" || r.name == "Declare") return;
    if (r.name == "LightSource" || r.name == "AreaLightSource") return take(r, kLights, r.args[1].strings[0]);
    if (r.name == "Imager") return take(r, kImagers, kImager);
    if (r.name == "Exposure") return void(json_["exposure"] = r.args[0].numbers);
    if (r.name == "Attribute" && r.args[0].strings[0] == "identifier" && findParam(r.params, "name"))
      return void(object_ = findParam(r.params, "name")->strings.at(0));
    if (object_) {
      if (r.name == "Surface") return take(r, kSurfaces, *object_);
      if (r.name == "Atmosphere") return take(r, kAtmospheres, *object_);
      if (r.name == "Color") return void(json_["objects"][*object_]["color"] = r.args[0].numbers);
      if (r.name == "Illuminate")
        return void(json_["objects"][*object_]["lights"][r.args[0].strings[0]] = r.args[1].number() != 0);
    }
    throw BadRequest(fmt::format("line {}: this page cannot change {}{}", r.where.line, r.name,
                                 object_ ? "" : " without the name of an object"));
  }

 private:
  void take(const Request& r, ShaderSlot slot, const std::string& owner) {
    const EditableShader* shader = editable_.find(slot, owner);
    if (!shader)
      throw BadRequest(fmt::format("line {}: the shot has no {} \"{}\"", r.where.line, kSlots[slot].owner, owner));
    if (const std::string& name = r.args[0].strings[0]; name != shader->shader) {
      json_["shaders"][kSlots[slot].key][owner] = name;
      shader = editable_.describe(slot, name);
    }
    for (const Param& p : r.params) {
      if (p.name == "__group" || p.name == "lightgroup") continue;  // the light keeps it (EditableShader::group)
      const std::vector<float> numbers = p.ints.empty() ? p.floats : std::vector<float>(p.ints.begin(), p.ints.end());
      json_[kSlots[slot].key][owner][p.name] = jsonOf(ParamValue{numbers, p.strings});
    }
  }

  const Editable& editable_;
  Json& json_;
  std::optional<std::string> object_;
};

}  // namespace

std::string ribOf(const EditState& state, const Editable& editable) {
  std::string out = "version 3.04\n";  // a file without a request would be none
  for (const EditableShader& light : editable.of(kLights))
    out += requestOf(state, kLights, light.owner, editable, " " + quoted(light.owner));
  for (const EditableObject& object : editable.objects()) out += requestsOf(state, object.name, editable);
  out += requestOf(state, kImagers, kImager, editable);
  if (state.exposure) out += fmt::format("Exposure {} {}\n", (*state.exposure)[0], (*state.exposure)[1]);
  return out;
}

EditState stateOfRib(const std::vector<std::string>& files, const Editable& editable) {
  Json json = Json::object();
  StateReader reader(editable, json);
  Log log(Log::Verbosity::Quiet);
  if (!parseRib(files, reader, log)) throw BadRequest("this edit cannot be read");
  return stateOf(json, editable);
}

}  // namespace tomales
