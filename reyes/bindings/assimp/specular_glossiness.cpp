#include "reyes/bindings/assimp/specular_glossiness.h"

#include <cmath>

#include "reyes/bindings/assimp/nodes.h"

namespace tomales::model {
namespace {

constexpr float kDielectric = 0.04f;  ///< glTF's reflectance of dielectrics at normal incidence; 0.5 in disney.

/// Tells whether metallic and roughness are given: Assimp sets their defaults for other materials too.
bool isDescribedByMetallic(const aiMaterial& m) {
  float metallic = 0, roughness = 0;
  aiColor4D base;
  m.Get(AI_MATKEY_METALLIC_FACTOR, metallic);
  m.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness);
  m.Get(AI_MATKEY_BASE_COLOR, base);
  return metallic != 1 || roughness != 1 || base != aiColor4D(1, 1, 1, 1) ||
         m.GetTextureCount(aiTextureType_BASE_COLOR) > 0 || m.GetTextureCount(aiTextureType_UNKNOWN) > 0;
}

/// A base colour b of metallic m scatters b (1 - m), and reflects 0.04 (1 - m) + b m. Returns m for given values of
/// both.
float metallicFor(float scattered, float reflected) {
  if (reflected <= kDielectric) return 0;
  const float b = scattered + reflected - 2 * kDielectric, c = kDielectric - reflected;
  return glm::clamp((std::sqrt(b * b - 4 * kDielectric * c) - b) / (2 * kDielectric), 0.0f, 1.0f);
}

}  // namespace

std::optional<Metallic> metallicOfSpecularGlossiness(const aiMaterial& m) {
  float gloss = 1;
  if (m.Get(AI_MATKEY_GLOSSINESS_FACTOR, gloss) != aiReturn_SUCCESS || isDescribedByMetallic(m)) return std::nullopt;
  aiColor4D diffuse(1, 1, 1, 1), given(1, 1, 1, 1);
  m.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
  m.Get(AI_MATKEY_COLOR_SPECULAR, given);
  const bool isMapped = m.GetTextureCount(aiTextureType_SPECULAR) > 0;  // then the factor alone says nothing
  const vec3 reflected = isMapped ? vec3(kDielectric) : glm::clamp(vec3(given.r, given.g, given.b), 0.0f, 1.0f),
             scattered = vec3(diffuse.r, diffuse.g, diffuse.b) * (1 - maxComponent(reflected));
  Metallic out;
  out.opacity = diffuse.a;
  out.roughness = 1 - glm::clamp(gloss, 0.0f, 1.0f);
  out.metallic = metallicFor(luminance(scattered), luminance(reflected));
  const vec3 ofDiffuse = scattered / std::max(1 - out.metallic, 1e-3f),
             ofMetal = (reflected - kDielectric * (1 - out.metallic)) / std::max(out.metallic, 1e-3f);
  out.color = glm::clamp(glm::mix(ofDiffuse, ofMetal, out.metallic * out.metallic), 0.0f, 1.0f);
  out.specular = 0.5f * std::min(luminance(reflected) / kDielectric, 1.0f);
  return out;
}

}  // namespace tomales::model
