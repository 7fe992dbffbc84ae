#include "reyes/shade/light_sets.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <string>

#include "reyes/shade/bound_scene.h"
#include "reyes/shade/parameter_values.h"

namespace tomales {
namespace {

/// Weight of a lamp without light, as a share of the brightest, so that surfaces still meet it among the drawn lamps.
constexpr float kDark = 1e-6f;

/// Tells whether a number may differ from light to light of a set.
bool mayVary(const TmParamDecl& decl) {
  const int floats = floatsOf(typeOf(decl));
  return !isOutput(decl) && !isUniform(decl) && decl.arrayLength == 1 && (floats == 1 || floats == 3);
}

/// Returns the bound of a lamp; empty if its place is not known.
Bound3 boundOf(const BoundLight& light, const ShadeServices* services) {
  if (light.can(TM_LIGHT_AREA)) return services ? services->emitterBound(light.index) : Bound3();
  const BoundShader& b = *light.bound;
  Bound3 out;
  for (int i = 0; i < b.shader->paramCount; ++i)
    if (const TmValue& v = b.values[static_cast<size_t>(i)]; b.shader->params[i].role == TM_ROLE_POSITION)
      out.extend(vec3(v.c[0][0], v.c[1][0], v.c[2][0]));
  return out;
}

/// Returns TreeLight::power, which TM_LIGHT_BOUNDED guarantees.
float powerOf(const BoundLight& light, const ShadeServices* services) {
  const vec3 color = glm::abs(light.bound->number(TM_ROLE_SCALE, 1) * light.bound->color(TM_ROLE_TINT, vec3(1.0f)));
  const float scale = (color.x + color.y + color.z) / 3;
  if (!light.can(TM_LIGHT_AREA)) return scale;
  const float said = light.bound->number(TM_ROLE_AREA, 0);
  return scale * services->emitterArea(light.index) / (said > 0 ? said : kPi);
}

bool mayBeDrawn(const BoundLight& light) {
  constexpr TmCapability kNone[] = {TM_LIGHT_AMBIENT, TM_LIGHT_INDIRECT, TM_LIGHT_SOLAR, TM_LIGHT_SKY,
                                    TM_LIGHT_SAMPLED};
  return light.can(TM_LIGHT_BOUNDED) && light.shadowVariance == 0 &&
         std::none_of(std::begin(kNone), std::end(kNone), [&](TmCapability c) { return light.can(c); });
}

/// Returns a key. Lights with the same key differ only in numbers.
std::string keyOf(const BoundLight& light) {
  const BoundShader& b = *light.bound;
  std::string key(reinterpret_cast<const char*>(&b.shader), sizeof b.shader);
  for (const int flag : {int{light.shadows}, int{light.direct}, int{light.indirect}, int{light.nondiffuse},
                         int{light.nonspecular}, light.samples})
    key += std::to_string(flag) + ",";
  key += light.category;
  for (int i = 0; i < b.shader->paramCount; ++i) {
    const TmParamDecl& decl = b.shader->params[i];
    if (isOutput(decl) || mayVary(decl)) continue;
    const TmValue& value = b.values[static_cast<size_t>(i)];
    key += "\n";
    if (typeOf(decl) == TM_STRING) key += b.strings[static_cast<size_t>(i)];
    const int floats = floatsOf(typeOf(decl)) * std::max(1, decl.arrayLength);  // they lie one after another
    if (value.c[0]) key.append(reinterpret_cast<const char*>(value.c[0]), sizeof(float) * static_cast<size_t>(floats));
  }
  return key;
}

/// Returns the parameters whose values are not the same for all lights.
std::vector<int> varyingOf(const std::vector<const BoundLight*>& lights) {
  std::vector<int> out;
  const BoundShader& first = *lights[0]->bound;
  for (int i = 0; i < first.shader->paramCount; ++i) {
    if (!mayVary(first.shader->params[i])) continue;
    const auto differs = [&](const BoundLight* l) {
      for (int k = 0; k < floatsOf(typeOf(first.shader->params[i])); ++k)
        if (l->bound->values[static_cast<size_t>(i)].c[k][0] != first.values[static_cast<size_t>(i)].c[k][0])
          return true;
      return false;
    };
    if (std::any_of(lights.begin(), lights.end(), differs)) out.push_back(i);
  }
  return out;
}

std::vector<float> numbersOf(const std::vector<const BoundLight*>& lights, const std::vector<int>& varying) {
  std::vector<float> out;
  for (const BoundLight* l : lights)
    for (const int p : varying)
      for (int k = 0; k < floatsOf(typeOf(l->bound->shader->params[p])); ++k)
        out.push_back(l->bound->values[static_cast<size_t>(p)].c[k][0]);
  return out;
}

LightSet setOf(std::vector<const BoundLight*> lights, const ShadeServices* services) {
  std::vector<TreeLight> inTree;
  float brightest = 0;
  for (const BoundLight* l : lights) {
    inTree.push_back({boundOf(*l, services), powerOf(*l, services)});
    brightest = std::max(brightest, inTree.back().power);
  }
  for (TreeLight& light : inTree) light.power = std::max({light.power, kDark * brightest, 1e-30f});
  std::vector<int> varying = varyingOf(lights);
  std::vector<float> numbers = numbersOf(lights, varying);
  return {std::move(lights), std::move(varying), std::move(numbers), LightTree(std::move(inTree))};
}

/// Tells whether a set of `count` lights is drawn from, instead of running all of them.
bool isMany(size_t count, const BoundLight& light, int lightCut) {
  return count > (light.shadows ? kFewLights : kFewWithoutShadows) * static_cast<size_t>(lightCut);
}

SharedSets setsOf(const LightList& lights, const BoundScene& scene) {
  std::map<std::string, std::vector<const BoundLight*>> byKey;
  for (const int index : lights)
    if (const BoundLight& l = scene.light(index);
        mayBeDrawn(l) && !boundOf(l, scene.services).empty() && isFinite(vec3(powerOf(l, scene.services))))
      byKey[keyOf(l)].push_back(&l);
  std::vector<std::vector<const BoundLight*>> sets;
  for (auto& [key, members] : byKey)
    if (isMany(members.size(), *members[0], scene.lightCut)) sets.push_back(std::move(members));
  std::sort(sets.begin(), sets.end(), [](const auto& a, const auto& b) { return a[0]->index < b[0]->index; });
  SharedSets out{{}, std::vector<int>(scene.lights.size(), -1)};
  for (auto& members : sets) {
    for (const BoundLight* l : members) out.setOf[static_cast<size_t>(l->index)] = static_cast<int>(out.sets.size());
    out.sets.push_back(setOf(std::move(members), scene.services));
  }
  return out;
}

/// Returns the parts that these lights have in sets of a list that begins with them; null if all lights run.
std::unique_ptr<const LightSets> partOf(const SharedSets& shared, const LightList& lights, int lightCut) {
  auto out = std::make_unique<LightSets>();
  std::vector<bool> drawn;
  for (const LightSet& set : shared.sets) {
    const auto isOn = [&](const BoundLight* l) { return lights.contains(l->index); };
    const auto count = std::partition_point(set.lights.begin(), set.lights.end(), isOn) - set.lights.begin();
    drawn.push_back(isMany(static_cast<size_t>(count), *set.lights[0], lightCut));
    if (drawn.back()) out->sets.push_back({&set, static_cast<uint32_t>(count)});
  }
  if (out->sets.empty()) return nullptr;
  for (const int light : lights)
    if (const int set = shared.setOf[static_cast<size_t>(light)]; set < 0 || !drawn[static_cast<size_t>(set)])
      out->alone.add(light);
  return out;
}

}  // namespace

const SharedSets& LightChoice::shared(const BoundScene& scene) const {
  if (longest_) return longest_->shared(scene);
  std::call_once(made_, [&] { shared_ = setsOf(lights_, scene); });
  return shared_;
}

const LightSets* LightChoice::sets(const BoundScene& scene) const {
  if (scene.lightCut == 0 || lights_.size() <= kFewLights * static_cast<size_t>(scene.lightCut)) return nullptr;
  std::call_once(chosen_, [&] { sets_ = partOf(shared(scene), lights_, scene.lightCut); });
  return sets_.get();
}

}  // namespace tomales
