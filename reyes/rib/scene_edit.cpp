// Changes to a scene with fixed geometry: shaders, lights and attributes, addressed by the names of objects and the
// handles of lights.
#include "reyes/rib/handlers.h"

namespace tomales {
namespace rib {
namespace {

class SceneEditor : public RiSink {
 public:
  SceneEditor(Scene& scene, Log& log) : scene_(scene), state_(log) { state_.globals.options = scene.options; }

  void request(const Request& r) override {
    if (r.name == "AttributeBegin") return outer_.push_back(selected_);
    if (r.name == "AttributeEnd") return endAttribute(r);
    if (r.name == "LightSource" || r.name == "AreaLightSource") return editLight(r);
    if (r.name == "Exposure" || r.name == "Imager" || r.name == "Quantize") return editOptions(r);
    if (r.name == "Attribute" && r.args[0].strings[0] == "identifier") return select(r);
    if (r.name == "Attribute" || r.name == "Color" || r.name == "Illuminate" || r.name == "Surface" ||
        r.name == "Atmosphere")
      return editObjects(r);
    if (r.name != "version" && r.name != "Declare")
      state_.warn(r, "edit-request", r.name + " changes more than shading; ignored, hide the scene again for it");
  }

 private:
  void endAttribute(const Request& r) {
    if (outer_.empty()) return state_.warn(r, "rib-unbalanced", "without its Begin, ignored");
    selected_ = outer_.back();
    outer_.pop_back();
  }

  void select(const Request& r) {
    const Param* name = findParam(r.params, "name");
    if (!name || name->strings.empty())
      return state_.warn(r, "edit-name", "only \"identifier\" \"name\" selects objects");
    selected_ = name->strings[0];
    const auto named = [&](const ShadeGroup& g) { return g.attributes->name == *selected_; };
    if (std::none_of(scene_.groups.begin(), scene_.groups.end(), named))
      state_.warn(r, "edit-name", "no object is named \"" + *selected_ + "\"");
  }

  void editOptions(const Request& r) {
    optionHandlers().at(r.name)(state_, r);
    std::optional<ShaderCall>& imager = state_.globals.options.imager;
    if (r.name == "Imager" && imager && scene_.options.imager) imager = merged(*scene_.options.imager, r, state_);
    scene_.options = state_.globals.options;
  }

  /// Returns the new call: the same shader keeps the parameters that the request does not give, and its space.
  static ShaderCall merged(const ShaderCall& old, const Request& r, const GraphicsState& state) {
    ShaderCall call = makeShaderCall(state, r);
    call.worldFromShader = old.worldFromShader;
    if (call.name == old.name)
      for (const Param& p : old.params)
        if (!findParam(call.params, p.name)) call.params.push_back(p);
    return call;
  }

  /// Merges the old call into the new one, if both the request and the old attributes have a shader.
  void keep(const Request& r, std::shared_ptr<const ShaderCall> Attributes::*which, const Attributes& old) {
    auto& shader = state_.scope.edit().*which;
    if (shader && old.*which) shader = std::make_shared<const ShaderCall>(merged(*(old.*which), r, state_));
  }

  void editLight(const Request& r) {
    const std::string& handle = r.args[1].strings[0];
    bool found = false;
    for (auto& light : scene_.lights) {
      if (light->handle != handle) continue;
      auto copy = std::make_shared<LightCall>(*light);
      copy->shader = merged(light->shader, r, state_);
      light = std::move(copy);
      found = true;
    }
    if (!found) state_.warn(r, "edit-light", "no light has the handle \"" + handle + "\"; ignored");
  }

  void editObjects(const Request& r) {
    const auto& table = r.name == "Attribute" || r.name == "Color" ? attributeHandlers() : shaderHandlers();
    std::map<const Attributes*, std::shared_ptr<const Attributes>> edited;
    state_.globals.lights = scene_.lights;
    for (const ShadeGroup& group : scene_.groups) {
      if (selected_ && group.attributes->name != *selected_) continue;
      std::shared_ptr<const Attributes>& copy = edited[group.attributes.get()];
      if (copy) continue;
      state_.scope.attributes = std::make_shared<Attributes>(*group.attributes);
      table.at(r.name)(state_, r);
      if (r.name == "Surface") keep(r, &Attributes::surface, *group.attributes);
      if (r.name == "Atmosphere") keep(r, &Attributes::atmosphere, *group.attributes);
      copy = state_.scope.attributes;
    }
    // The originals stay alive until here, so that no copy can take the address of one.
    const auto replace = [&](std::shared_ptr<const Attributes>& attributes) {
      if (const auto it = edited.find(attributes.get()); it != edited.end()) attributes = it->second;
    };
    for (Object& object : scene_.objects) replace(object.attributes);
    for (ShadeGroup& group : scene_.groups) replace(group.attributes);
  }

  Scene& scene_;
  GraphicsState state_;
  std::optional<std::string> selected_;  ///< If not given, all objects.
  std::vector<std::optional<std::string>> outer_;
};

}  // namespace
}  // namespace rib

bool editScene(const std::vector<std::string>& files, Scene& scene, Log& log) {
  rib::SceneEditor editor(scene, log);
  return parseRib(files, editor, log);
}

}  // namespace tomales
