#include "reyes/app/frame/light_edits.h"

#include <map>
#include <set>

#include "reyes/shader_registry.h"

namespace tomales {
namespace {

/// Returns the parameters of a light except those that only multiply its light.
std::map<std::string, Param> otherParams(const ShaderCall& light, const TmShader& shader) {
  std::map<std::string, Param> out;
  for (const Param& p : light.params) out.emplace(p.name, p);
  for (const TmParamDecl& decl : std::span(shader.params, static_cast<size_t>(shader.paramCount)))
    if (isFactor(roleOf(shader, decl))) out.erase(decl.name);
  return out;
}

struct LightChange {
  vec3 gain{1};        ///< Factor on the light by the changes of its factors.
  bool isGain = true;  ///< True if nothing else has changed.
};

LightChange changeOf(const LightCall& then, const LightCall& now, const ShadingSystem& shading) {
  const TmShader& shader = *shading.light(now.index).shader();
  const ShaderCall &a = then.shader, &b = now.shader;
  LightChange out;
  out.isGain = a.name == b.name && then.castsShadows == now.castsShadows && a.worldFromShader == b.worldFromShader &&
               otherParams(a, shader) == otherParams(b, shader);
  if (a == b || a.name != b.name) return out;
  const vec3 before = shading.light(now.index).factor(a.params), after = shading.light(now.index).factor(b.params);
  for (int c = 0; c < 3; ++c) {
    if (before[c] == after[c]) continue;
    if (before[c] != 0)
      out.gain[c] = after[c] / before[c];
    else
      out.isGain = false;
  }
  return out;
}

bool bounces(const ShadingSystem& shading, size_t light) {
  const LightKind kind = shading.light(static_cast<int>(light)).kind();
  return kind != LightKind::None && kind != LightKind::Indirect;
}

}  // namespace

LightEdits editsSince(const IrradianceShot& gathered, const Scene& now, const ShadingSystem& shading) {
  LightEdits out;
  if (gathered.lights.size() != now.lights.size()) return out;
  std::vector<std::optional<vec3>> gains(gathered.groups.size());
  for (size_t l = 0; l < now.lights.size(); ++l) {
    if (!bounces(shading, l)) continue;
    const auto group = std::ranges::find(gathered.groups, shading.light(static_cast<int>(l)).group());
    const LightChange change = changeOf(*gathered.lights[l], *now.lights[l], shading);
    vec3 kept(1.0f);
    if (group != gathered.groups.end()) {
      std::optional<vec3>& gain = gains[static_cast<size_t>(group - gathered.groups.begin())];
      if (!gain) gain = change.gain;
      kept = *gain;
    }
    if (!change.isGain || change.gain != kept) out.stale.push_back(now.lights[l]->handle);
  }
  for (const auto& of : gains) out.gains.push_back(of.value_or(vec3(1.0f)));
  if (std::ranges::all_of(out.gains, [](const vec3& gain) { return gain == vec3(1.0f); })) out.gains.clear();
  return out;
}

std::vector<std::string> groupsOfLights(const Scene& scene, const ShadingSystem& shading) {
  std::set<std::string> names{""};
  for (size_t l = 0; l < scene.lights.size(); ++l)
    if (bounces(shading, l)) names.insert(shading.light(static_cast<int>(l)).group());
  return {names.begin(), names.end()};
}

}  // namespace tomales
