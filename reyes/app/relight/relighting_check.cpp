// The check that the layers, each by a gain, add up to the picture under lights of these gains.
#include "reyes/app/relight/relighting.h"

namespace tomales {
namespace {

constexpr float kGains[] = {0.5f, 1.6f, 0.3f, 1.3f};
constexpr float kHalfRounding = 4e-3f, kLeastDifference = 5e-4f;  ///< Several times that of half floats.
constexpr size_t kPartsPerCheck = 4;
constexpr int kLeastPixels = 8;

}  // namespace

// Shades some parts under other gains and compares them with the mixed layers.
void Relighting::checkLinearity() {
  EditState other;
  std::vector<vec3> weights;
  {
    const std::lock_guard lock(mutex_);
    other = present_;
    for (size_t i = 0; i < list_.size(); ++i) {
      const float gain = kGains[i % std::size(kGains)];
      const auto scaled = [&](const std::string& handle) {
        const EditableShader& light = *std::ranges::find(editable_.lights, handle, &EditableShader::owner);
        const auto scale = std::ranges::find(light.params, TM_ROLE_SCALE, &EditableParam::role);
        if (scale == light.params.end()) return false;
        std::vector<float>& value = other.lights[handle].try_emplace(scale->name, scale->value).first->second;
        value[0] *= gain;
        return true;
      };
      const std::vector<std::string>& handles = list_[i].handles;
      const bool all = !handles.empty() && std::ranges::all_of(handles, scaled);
      weights.emplace_back(i == 0 ? 0.0f : all ? gain : 1.0f);
    }
  }
  ShotJob& job = jobFor(other);
  job.choose(nullptr, true);
  std::map<std::string, int> off;
  const auto compare = [&](const Image& rows) {
    for (int y = 0; y < rows.height; ++y)
      for (int x = 0; x < rows.width; ++x) {
        vec3 mixed(0.0f), rounding(kLeastDifference);
        for (size_t i = 1; i < weights.size(); ++i) {
          const vec3 share = weights[i] * layers_->at(i, rows.originX + x, rows.originY + y);
          mixed += share;
          rounding += kHalfRounding * glm::abs(share);
        }
        if (!glm::any(glm::greaterThan(glm::abs(mixed - colorAt(rows, x, y)), rounding))) continue;
        const std::optional<int> group = groupAt(rows.originX + x, rows.originY + y);
        const auto& groups = files_->dfb().shot().scene.groups;
        ++off[group ? groups[static_cast<size_t>(*group)].attributes->name : ""];
      }
  };
  const std::vector<PixelRect> all = parts();
  for (size_t i = 0; i < all.size() && !cancel_; i += kPartsPerCheck) job.show(all[i], plainTiles(), compare, cancel_);
  const std::lock_guard lock(mutex_);
  if (cancel_) return;
  for (const auto& [name, pixels] : off)
    if (pixels >= kLeastPixels) notLinear_.push_back(name.empty() ? "objects without a name" : name);
}

}  // namespace tomales
