#include "reyes/app/frame/light_edits.h"

#include <map>
#include <set>

namespace tomales {
namespace {

/// The built-in lights whose light is in proportion to these parameters.
const std::set<std::string> kInProportion{"ambientlight",     "arealight",  "daylight",  "distantlight",
                                          "environmentlight", "pointlight", "spotlight", "sunlight"};
constexpr const char *kIntensity = "intensity", *kColor = "lightcolor";

vec3 strengthOf(const ShaderCall& light) {
  vec3 out(1.0f);
  if (const Param* p = findParam(light.params, kIntensity); p && p->floats.size() == 1) out *= p->floats[0];
  if (const Param* p = findParam(light.params, kColor); p && p->floats.size() == 3)
    out *= vec3(p->floats[0], p->floats[1], p->floats[2]);
  return out;
}

std::map<std::string, Param> otherParams(const ShaderCall& light) {
  std::map<std::string, Param> out;
  for (const Param& p : light.params)
    if (p.name != kIntensity && p.name != kColor) out.emplace(p.name, p);
  return out;
}

/// What an edit multiplies the light by; empty if it changes more than that.
std::optional<vec3> factorOf(const LightCall& then, const LightCall& now, bool builtIn) {
  const ShaderCall &a = then.shader, &b = now.shader;
  if (a == b && then.castsShadows == now.castsShadows) return vec3(1.0f);
  if (!builtIn || !shinesInProportion(a.name) || a.name != b.name || then.castsShadows != now.castsShadows ||
      !(a.worldFromShader == b.worldFromShader) || otherParams(a) != otherParams(b))
    return std::nullopt;
  const vec3 before = strengthOf(a), after = strengthOf(b);
  vec3 out(1.0f);
  for (int c = 0; c < 3; ++c) {
    if (before[c] == after[c]) continue;
    if (before[c] == 0) return std::nullopt;
    out[c] = after[c] / before[c];
  }
  return out;
}

bool bounces(const ShadingSystem& shading, size_t light) {
  const LightKind kind = shading.lightKind(static_cast<int>(light));
  return kind != LightKind::None && kind != LightKind::Indirect;
}

}  // namespace

LightEdits editsSince(const IrradianceShot& gathered, const Scene& now, const ShadingSystem& shading, bool builtIn) {
  LightEdits out;
  if (gathered.lights.size() != now.lights.size()) return out;
  std::vector<std::optional<vec3>> gains(gathered.groups.size());
  for (size_t l = 0; l < now.lights.size(); ++l) {
    if (!bounces(shading, l)) continue;
    const auto group = std::ranges::find(gathered.groups, shading.lightGroup(static_cast<int>(l)));
    const std::optional<vec3> factor = factorOf(*gathered.lights[l], *now.lights[l], builtIn);
    const bool known = group != gathered.groups.end();
    const vec3 kept =
        known ? gains[static_cast<size_t>(group - gathered.groups.begin())].value_or(factor.value_or(vec3(1)))
              : vec3(1.0f);
    if (!factor || *factor != kept) out.stale.push_back(now.lights[l]->handle);
    if (known) gains[static_cast<size_t>(group - gathered.groups.begin())] = kept;
  }
  for (const auto& gain : gains) out.gains.push_back(gain.value_or(vec3(1.0f)));
  if (std::ranges::all_of(out.gains, [](const vec3& gain) { return gain == vec3(1.0f); })) out.gains.clear();
  return out;
}

bool shinesInProportion(const std::string& shader) { return kInProportion.contains(shader); }

std::vector<std::string> groupsOfLights(const Scene& scene, const ShadingSystem& shading) {
  std::set<std::string> names{""};
  for (size_t l = 0; l < scene.lights.size(); ++l)
    if (bounces(shading, l)) names.insert(shading.lightGroup(static_cast<int>(l)));
  return {names.begin(), names.end()};
}

}  // namespace tomales
