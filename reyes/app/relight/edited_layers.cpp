#include "reyes/app/relight/edited_layers.h"

namespace tomales {
namespace {

/// Tells whether the page mixes the layer by the factor of this light. It cannot if several lights, with different
/// factors, share the layer.
bool isMixed(const RelitLayer& layer, const std::string& handle) {
  return layer.handles.size() == 1 && layer.handles.front() == handle;
}

/// Returns a value of a parameter that only multiplies the light, with which all of the light is visible: the scene's
/// value unless a component is 0.
std::vector<float> unitOf(const EditableParam& param) {
  std::vector<float> out = param.value.numbers;
  if (std::ranges::count(out, 0.0f) > 0) std::ranges::fill(out, 1.0f);
  return out;
}

}  // namespace

// Paths of the reference know whose light they bring; records do if they keep shares.
bool sharesBounces(const ShotJob& job) {
  const GiMode mode = job.job().method().mode;
  return mode == GiMode::None || mode == GiMode::Reference ||
         (mode == GiMode::Gather && job.job().gathers() && !job.shareGroups().empty());
}

std::vector<RelitLayer> layersOf(const ShotJob& job, size_t parts) {
  const bool shares = sharesBounces(job);
  std::vector<RelitLayer> out{{"everything", std::nullopt}, {"glow", "", shares}};
  std::map<std::string, std::vector<std::string>> groups;
  for (const auto& light : job.shot().scene.lights)
    if (const std::string group = job.job().shading().light(light->index).group(); !group.empty())
      groups[group].push_back(light->handle);
  for (const auto& [name, handles] : groups) out.push_back({name, name, shares, handles});
  if (!shares) out.push_back({"bounced light", "", true});
  out.push_back({"variable", std::nullopt});
  for (RelitLayer& layer : out) layer.parts = LayerParts(parts);
  return out;
}

EditedLayers::EditedLayers(std::vector<RelitLayer> layers, const Editable& editable, EditState present)
    : layers_(std::move(layers)), editable_(editable), present_(std::move(present)) {
  wantPresent();
}

void EditedLayers::edit(EditState present) {
  present_ = std::move(present);
  wantPresent();
}

void EditedLayers::showVariable(std::string name) {
  variable_ = std::move(name);
  wantPresent();
}

// The whole picture shows the present edit. The other layers ignore changes of parameters that only multiply a light,
// so that every part of a layer, however old, can be mixed by the same factor.
EditState EditedLayers::editFor(size_t layer) const {
  if (!layers_[layer].lights) return present_;
  EditState out = present_;
  out.exposure.reset();
  out.shaders[kImagers].clear();
  for (const RelitLayer& each : layers_)
    for (const std::string& handle : each.handles) {
      if (!isMixed(each, handle)) continue;
      ShaderEdit& edit = out.shaders[kLights][handle];
      for (const EditableParam& p : shaderUnder(present_, kLights, handle, editable_).params) {
        if (!isFactor(p.role)) continue;
        edit.params.erase(p.name);
        if (const auto unit = tomales::unitOf(p); unit != p.value.numbers) edit.params[p.name] = {unit, {}};
      }
      if (edit == ShaderEdit{}) out.shaders[kLights].erase(handle);
    }
  return out;
}

vec3 EditedLayers::unitOf(size_t layer) const {
  vec3 out(1.0f);
  const std::vector<std::string>& handles = layers_[layer].handles;
  if (handles.size() != 1) return out;
  for (const EditableParam& p : shaderUnder(present_, kLights, handles.front(), editable_).params) {
    if (!isFactor(p.role)) continue;
    const std::vector<float> value = tomales::unitOf(p);
    out *= value.size() == 3 ? vec3(value[0], value[1], value[2]) : vec3(value[0]);
  }
  return out;
}

std::string EditedLayers::textFor(size_t layer) const {
  EditState edit = editFor(layer);
  if (layers_[layer].lights) {
    const auto belongsElsewhere = [&](const auto& ofLight) {
      const auto has = [&](const RelitLayer& l) { return std::ranges::count(l.handles, ofLight.first) > 0; };
      return !has(layers_[layer]) && std::ranges::any_of(layers_, has);
    };
    std::erase_if(edit.shaders[kLights], belongsElsewhere);
    for (auto& [name, object] : edit.objects) std::erase_if(object.lights, belongsElsewhere);
  }
  return ribOf(edit, editable_) + (layer == variableLayer() ? variable_ : "");
}

void EditedLayers::wantPresent() {
  for (size_t layer = 0; layer < layers_.size(); ++layer) layers_[layer].parts.want(textFor(layer));
}

}  // namespace tomales
