#include "reyes/bindings/assimp/look.h"

#include <cmath>
#include <optional>

#include "reyes/bindings/assimp/nodes.h"

namespace tomales::model {
namespace {

std::optional<float> number(const aiMaterial& m, const char* key, unsigned type, unsigned index) {
  float value = 0;
  if (m.Get(key, type, index, value) != aiReturn_SUCCESS || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<vec3> color(const aiMaterial& m, const char* key, unsigned type, unsigned index) {
  aiColor3D value;
  if (m.Get(key, type, index, value) != aiReturn_SUCCESS || !isFinite(of(value))) return std::nullopt;
  return of(value);
}

/// Of a highlight cos^n as of Beckmann's distribution of the same width near its middle: alpha^2 = 2 / (n + 2) (Walter
/// et al. 2007, section 5.1), and disney's alpha is the square of its roughness.
float roughnessOfExponent(float n) { return std::pow(2 / (std::max(n, 0.0f) + 2), 0.25f); }

float roughnessOf(const aiMaterial& m) {
  if (const auto given = number(m, AI_MATKEY_ROUGHNESS_FACTOR)) return glm::clamp(*given, 0.0f, 1.0f);
  if (const auto gloss = number(m, AI_MATKEY_GLOSSINESS_FACTOR)) return glm::clamp(1 - *gloss, 0.0f, 1.0f);
  const float exponent = number(m, AI_MATKEY_SHININESS).value_or(0);
  return exponent > 0 ? roughnessOfExponent(exponent) : 0.5f;
}

}  // namespace

Look lookOf(const aiMaterial& material) {
  Look out;
  aiString name;
  material.Get(AI_MATKEY_NAME, name);
  out.name = of(name);
  if (const auto base = color(material, AI_MATKEY_BASE_COLOR))
    out.color = *base;
  else if (const auto diffuse = color(material, AI_MATKEY_COLOR_DIFFUSE))
    out.color = *diffuse;
  out.opacity = glm::clamp(number(material, AI_MATKEY_OPACITY).value_or(1), 0.0f, 1.0f);
  out.parameters = {param("roughness", roughnessOf(material))};
  const auto add = [&](const char* parameter, std::optional<float> value) {
    if (value && *value > 0) out.parameters.push_back(param(parameter, std::min(*value, 1.0f)));
  };
  add("metallic", number(material, AI_MATKEY_METALLIC_FACTOR));
  add("clearcoat", number(material, AI_MATKEY_CLEARCOAT_FACTOR));
  if (const auto emitted = color(material, AI_MATKEY_COLOR_EMISSIVE); emitted && maxComponent(*emitted) > 0)
    out.parameters.push_back(
        param("emission", ValueType::Color, *emitted * number(material, AI_MATKEY_EMISSIVE_INTENSITY).value_or(1)));
  return out;
}

Requests requestsOf(const Look& look) {
  return {call("Color", look.color), call("Opacity", vec3(look.opacity)),
          callWith(look.parameters, "Surface", "disney")};
}

}  // namespace tomales::model
