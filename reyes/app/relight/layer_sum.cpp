#include "reyes/app/relight/layer_sum.h"

namespace tomales {
namespace {

constexpr float kGains[] = {0.5f, 1.6f, 0.3f, 1.3f};
constexpr float kHalfRounding = 4e-3f, kLeastDifference = 5e-4f;  ///< Several times the rounding of half floats.
constexpr int kLeastPixels = 8;

/// Multiplies the light of a handle. Returns false if it has no parameter for that.
bool scale(const std::string& handle, float gain, const EditState& before, const Editable& editable, EditState& edit) {
  const EditableShader& light = shaderUnder(before, kLights, handle, editable);
  const auto scale = std::ranges::find(light.params, TM_ROLE_SCALE, &EditableParam::role);
  if (scale == light.params.end()) return false;
  ParamValue& value = edit.shaders[kLights][handle].params.try_emplace(scale->name, scale->value).first->second;
  value.numbers[0] *= gain;
  return true;
}

}  // namespace

LayerSum::LayerSum(const EditState& edit, const EditSession& session, const LayerStore& layers, RelitShot& shot)
    : edit_(edit), layers_(layers), shot_(shot) {
  for (size_t i = 0; i + 1 < session.layerCount(); ++i) {
    const float gain = kGains[i % std::size(kGains)];
    const auto scaled = [&](const std::string& handle) { return scale(handle, gain, edit, shot.editable(), edit_); };
    const std::vector<std::string> handles = session.layer(i).handles;
    const bool all = !handles.empty() && std::ranges::all_of(handles, scaled);
    weights_.emplace_back(i == kWhole ? 0.0f : all ? gain : 1.0f);
  }
}

bool LayerSum::isOff(const Image& rows, int x, int y) const {
  vec3 mixed(0.0f), rounding(kLeastDifference);
  for (size_t i = 1; i < weights_.size(); ++i) {
    const vec3 share = weights_[i] * layers_.at(i, rows.originX + x, rows.originY + y);
    mixed += share;
    rounding += kHalfRounding * glm::abs(share);
  }
  return glm::any(glm::greaterThan(glm::abs(mixed - colorAt(rows, x, y)), rounding));
}

std::string LayerSum::objectAt(int x, int y) {
  const Shot& shot = shot_.files()->dfb().shot();
  const size_t bucket = shot.frame.tileOf(x, y);
  const auto [tile, isNew] = buckets_.try_emplace(bucket);
  if (isNew) tile->second = shot_.tile(bucket);
  const Attributes* nearest = tile->second ? nearestAt(shot, *tile->second, x, y) : nullptr;
  return nearest ? nearest->name : "";
}

void LayerSum::compare(const Image& rows) {
  for (int y = 0; y < rows.height; ++y)
    for (int x = 0; x < rows.width; ++x)
      if (isOff(rows, x, y)) ++pixelsOff_[objectAt(rows.originX + x, rows.originY + y)];
}

std::vector<std::string> LayerSum::objectsOff() const {
  std::vector<std::string> out;
  for (const auto& [name, pixels] : pixelsOff_)
    if (pixels >= kLeastPixels) out.push_back(name.empty() ? "objects without a name" : name);
  return out;
}

}  // namespace tomales
