// The check that the layers, each by a gain, add up to the picture under lights of these gains.
#include "reyes/app/relight/relighting.h"
#include "reyes/app/relight/relighting_layers.h"

namespace tomales {
namespace {

constexpr float kGains[] = {0.5f, 1.6f, 0.3f, 1.3f};
constexpr float kHalfRounding = 4e-3f, kLeastDifference = 5e-4f;  ///< Several times that of half floats.
constexpr size_t kPartsPerCheck = 4;
constexpr int kLeastPixels = 8;

}  // namespace

// Shades some parts under other gains and compares them with the mixed layers.
void Relighting::checkLinearity(const Step& step) {
  tell("checking that light adds up", 0);
  EditState other = step.edit;
  std::vector<vec3> weights;
  const size_t variable = list_.size() - 1;
  for (size_t i = 0; i < variable; ++i) {
    const float gain = kGains[i % std::size(kGains)];
    const auto scaled = [&](const std::string& handle) {
      const EditableShader& light = shaderUnder(step.edit, kLights, handle, *editable_);
      const auto scale = std::ranges::find(light.params, TM_ROLE_SCALE, &EditableParam::role);
      if (scale == light.params.end()) return false;
      ParamValue& value = other.shaders[kLights][handle].params.try_emplace(scale->name, scale->value).first->second;
      value.numbers[0] *= gain;
      return true;
    };
    const std::vector<std::string>& handles = list_[i].handles;
    const bool all = !handles.empty() && std::ranges::all_of(handles, scaled);
    weights.emplace_back(i == kWhole ? 0.0f : all ? gain : 1.0f);
  }
  ShotJob& job = jobFor(other);
  job.choose(nullptr, true);
  std::map<std::string, int> off;
  std::map<size_t, std::shared_ptr<const DeepTile>> seen;  // of the part
  const auto nameAt = [&](int x, int y) -> std::string {
    const size_t bucket = files_->dfb().shot().frame.tileOf(x, y);
    const auto [tile, isNew] = seen.try_emplace(bucket);
    if (isNew) tile->second = tiles_->read(bucket);
    const std::optional<int> group = tile->second ? groupAt(*tile->second, x, y) : std::nullopt;
    if (!group) return "";
    return files_->dfb().shot().scene.groups[static_cast<size_t>(*group)].attributes->name;
  };
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
        ++off[nameAt(rows.originX + x, rows.originY + y)];
      }
  };
  for (size_t i = 0; i < parts_.size() && !cancel_; i += kPartsPerCheck) {
    if (parts_[i].width() > 0 && parts_[i].height() > 0) job.show(parts_[i], plainTiles(), compare, cancel_);
    seen.clear();
  }
  const std::lock_guard lock(mutex_);
  if (cancel_) return;
  notLinear_.clear();
  for (const auto& [name, pixels] : off)
    if (pixels >= kLeastPixels) notLinear_.push_back(name.empty() ? "objects without a name" : name);
}

}  // namespace tomales
