#include "reyes/app/relight/edit_state.h"

#include <fmt/format.h>

#include <cmath>

namespace tomales {
namespace {

constexpr float kLargest = 1e30f;
constexpr size_t kLongestText = 256;

std::vector<float> numbersOf(const Json& json, size_t count, const std::string& what) {
  std::vector<float> out;
  if (json.is_array())
    for (const Json& value : json)
      if (value.is_number() && std::abs(value.get<double>()) <= kLargest) out.push_back(value.get<float>());
  if (out.size() != count || json.size() != count)
    throw BadRequest(fmt::format("{} takes {} finite number{}", what, count, count == 1 ? "" : "s"));
  return out;
}

/// Tells whether a text names files of the scene's folders at most: a page does not reach others.
bool staysInside(const std::string& text) {
  const auto isControl = [](char c) { return static_cast<unsigned char>(c) < 32; };
  return text.size() <= kLongestText && !text.starts_with('/') && !text.starts_with('~') && !text.starts_with('|') &&
         ("/" + text + "/").find("/../") == std::string::npos && std::ranges::none_of(text, isControl);
}

std::vector<std::string> textsOf(const Json& json, const EditableParam& param) {
  std::vector<std::string> out;
  if (json.is_array())
    for (const Json& value : json)
      if (value.is_string()) out.push_back(value.get<std::string>());
  const std::vector<std::string>& given = param.value.texts;
  if (out.size() != given.size() || json.size() != given.size())
    throw BadRequest(fmt::format("\"{}\" takes {} text{}", param.name, given.size(), given.size() == 1 ? "" : "s"));
  for (size_t i = 0; i < out.size(); ++i)
    if (out[i] != given[i] && !staysInside(out[i]))
      throw BadRequest("\"" + param.name + "\" takes a short text that leads to no other folder");
  return out;
}

ParamValue valueOf(const Json& json, const EditableParam& param) {
  if (!param.value.texts.empty()) return {{}, textsOf(json, param)};
  return {numbersOf(json, param.value.numbers.size(), "\"" + param.name + "\""), {}};
}

const Json& objectOf(const Json& json, const std::string& what) {
  if (!json.is_object()) throw BadRequest(what + " are an object of names");
  return json;
}

class JsonReader {
 public:
  explicit JsonReader(const Editable& editable) : editable_(editable) {}

  EditState read(const Json& json) {
    objectOf(json, "edits");
    // The other parameters are those of the shaders that are named here.
    if (json.contains("shaders")) readShaders(json.at("shaders"));
    for (const auto& [name, value] : json.items()) {
      const auto slot = std::ranges::find(kSlots, name, &ShaderSlotInfo::key);
      if (slot != std::end(kSlots))
        readParams(value, static_cast<ShaderSlot>(slot - std::begin(kSlots)));
      else if (name == "objects")
        readObjects(value);
      else if (name == "exposure")
        readExposure(value);
      else if (name != "shaders")
        throw BadRequest("an edit has no \"" + name + "\"");
    }
    return std::move(state_);
  }

 private:
  void readShaders(const Json& json) {
    for (const auto& [key, owners] : objectOf(json, "shaders").items()) {
      const auto slot = std::ranges::find(kSlots, key, &ShaderSlotInfo::key);
      if (slot == std::end(kSlots)) throw BadRequest("there are no \"" + key + "\"");
      const auto s = static_cast<ShaderSlot>(slot - std::begin(kSlots));
      for (const auto& [owner, name] : objectOf(owners, key).items()) {
        checkOwner(s, owner);
        if (!name.is_string() || !editable_.describe(s, name.get<std::string>()))
          throw BadRequest(fmt::format("there is no such {} shader", kindName(kSlots[s].kind)));
        state_.shaders[s][owner].shader = name.get<std::string>();
      }
    }
  }

  void readParams(const Json& json, ShaderSlot slot) {
    for (const auto& [owner, params] : objectOf(json, kSlots[slot].key).items()) {
      checkOwner(slot, owner);
      const EditableShader& shader = shaderUnder(state_, slot, owner, editable_);
      for (const auto& [name, value] : objectOf(params, "parameters").items()) {
        const EditableParam* param = shader.param(name);
        if (!param)
          throw BadRequest(fmt::format("{} \"{}\" has no parameter \"{}\" to change", kSlots[slot].owner, owner, name));
        state_.shaders[slot][owner].params[name] = valueOf(value, *param);
      }
    }
  }

  void readObjects(const Json& json) {
    for (const auto& [owner, changes] : objectOf(json, "objects").items()) {
      if (!editable_.object(owner)) throw BadRequest("there is no object \"" + owner + "\"");
      for (const auto& [name, value] : objectOf(changes, "changes of an object").items()) {
        if (name == "color") {
          const std::vector<float> rgb = numbersOf(value, 3, "a colour");
          state_.objects[owner].color = {rgb[0], rgb[1], rgb[2]};
        } else if (name == "lights") {
          for (const auto& [light, shines] : objectOf(value, "lights").items()) {
            checkOwner(kLights, light);
            if (!shines.is_boolean()) throw BadRequest("a light shines on an object, or not");
            state_.objects[owner].lights[light] = shines.get<bool>();
          }
        } else {
          throw BadRequest("an object has no \"" + name + "\" to change");
        }
      }
    }
  }

  void readExposure(const Json& json) {
    const std::vector<float> numbers = numbersOf(json, 2, "exposure");
    if (!(numbers[0] >= 0) || !(numbers[1] > 0))
      throw BadRequest("exposure takes a gain of 0 or more and a gamma above 0");
    state_.exposure = {numbers[0], numbers[1]};
  }

  void checkOwner(ShaderSlot slot, const std::string& owner) const {
    if (!editable_.find(slot, owner)) throw BadRequest(fmt::format("there is no {} \"{}\"", kSlots[slot].owner, owner));
  }

  const Editable& editable_;
  EditState state_;
};

}  // namespace

const ShaderEdit* EditState::edit(ShaderSlot slot, const std::string& owner) const {
  const auto found = shaders[slot].find(owner);
  return found == shaders[slot].end() ? nullptr : &found->second;
}

const EditableShader& shaderUnder(const EditState& state, ShaderSlot slot, const std::string& owner,
                                  const Editable& editable) {
  const ShaderEdit* edit = state.edit(slot, owner);
  return edit && !edit->shader.empty() ? *editable.describe(slot, edit->shader) : *editable.find(slot, owner);
}

EditState stateOf(const Json& json, const Editable& editable) { return JsonReader(editable).read(json); }

Json jsonOf(const ParamValue& value) { return value.texts.empty() ? Json(value.numbers) : Json(value.texts); }

Json jsonOf(const EditState& state) {
  Json out, swapped = Json::object(), objects = Json::object();
  for (size_t slot = 0; slot < kShaderSlots; ++slot) {
    Json& owners = out[kSlots[slot].key] = Json::object();
    for (const auto& [owner, edit] : state.shaders[slot]) {
      if (!edit.shader.empty()) swapped[kSlots[slot].key][owner] = edit.shader;
      for (const auto& [name, value] : edit.params) owners[owner][name] = jsonOf(value);
    }
  }
  for (const auto& [name, edit] : state.objects) {
    if (edit.color) objects[name]["color"] = *edit.color;
    for (const auto& [light, shines] : edit.lights) objects[name]["lights"][light] = shines;
  }
  out["shaders"] = swapped;
  out["objects"] = objects;
  if (state.exposure) out["exposure"] = *state.exposure;
  return out;
}

}  // namespace tomales
