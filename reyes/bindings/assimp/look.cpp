#include "reyes/bindings/assimp/look.h"

#include <assimp/GltfMaterial.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "reyes/bindings/assimp/nodes.h"
#include "reyes/bindings/assimp/specular_glossiness.h"

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

/// Returns the roughness of a highlight cos^n, by Beckmann's distribution of the same width near its middle: alpha^2 =
/// 2 / (n + 2) (Walter et al. 2007, section 5.1); disney's alpha is the square of its roughness.
float roughnessOfExponent(float n) { return std::pow(2 / (std::max(n, 0.0f) + 2), 0.25f); }

float roughnessOf(const aiMaterial& m) {
  if (const auto given = number(m, AI_MATKEY_ROUGHNESS_FACTOR)) return glm::clamp(*given, 0.0f, 1.0f);
  if (const auto gloss = number(m, AI_MATKEY_GLOSSINESS_FACTOR)) return glm::clamp(1 - *gloss, 0.0f, 1.0f);
  const float exponent = number(m, AI_MATKEY_SHININESS).value_or(0);
  return exponent > 0 ? roughnessOfExponent(exponent) : 0.5f;
}

/// Pictures of a material that multiply a parameter of disney.
struct Mapped {
  aiTextureType type;
  const char* map;
  const char* multiplied;  ///< nullptr: the colour.
  const char* channel;     ///< nullptr: all.
  float number;            ///< The value that the channel gets.
};
constexpr Mapped kMapped[] = {
    {aiTextureType_BASE_COLOR, "texturename", nullptr, nullptr, 0},
    {aiTextureType_DIFFUSE, "texturename", nullptr, nullptr, 0},
    {aiTextureType_METALNESS, "metallicmap", "metallic", "metallicchannel", 0},
    {aiTextureType_DIFFUSE_ROUGHNESS, "roughnessmap", "roughness", "roughnesschannel", 0},
    {aiTextureType_CLEARCOAT, "clearcoatmap", "clearcoat", "clearcoatchannel", 0},
    {aiTextureType_NORMALS, "normalmap", nullptr, nullptr, 0},
    {aiTextureType_NORMAL_CAMERA, "normalmap", nullptr, nullptr, 0},
    {aiTextureType_EMISSION_COLOR, "emissionmap", "emission", nullptr, 0},
    {aiTextureType_EMISSIVE, "emissionmap", "emission", nullptr, 0},
    {aiTextureType_OPACITY, "opacitymap", "opacity", "opacitychannel", 0},
};
// glTF keeps two in one picture, which Assimp has no type for.
constexpr Mapped kMetallicRoughness[] = {{aiTextureType_UNKNOWN, "roughnessmap", "roughness", "roughnesschannel", 1},
                                         {aiTextureType_UNKNOWN, "metallicmap", "metallic", "metallicchannel", 2}};

struct LeftOut {
  aiTextureType type;
  const char* what;
};
constexpr LeftOut kLeftOut[] = {{aiTextureType_HEIGHT, "a bump map"},
                                {aiTextureType_DISPLACEMENT, "a displacement map"},
                                {aiTextureType_SPECULAR, "a map of specular colour"},
                                {aiTextureType_SHININESS, "a map of shininess"},
                                {aiTextureType_REFLECTION, "a reflection map"},
                                {aiTextureType_TRANSMISSION, "a map of transmission"}};

Param* find(ParamList& list, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Param& p) { return p.name == name; });
  return found == list.end() ? nullptr : &*found;
}

std::string alphaMode(const aiMaterial& material) {
  aiString mode;
  return material.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS ? of(mode) : "";
}

/// Tells whether the material is glTF's, whose reader always sets a mode of alpha.
bool isGltf(const aiMaterial& material) { return !alphaMode(material).empty(); }

/// Adds pictures to a look.
class Painter {
 public:
  Painter(const aiMaterial& material, Textures& textures, const LookSource& source, Look& look)
      : material_(material), textures_(textures), source_(source), look_(look) {}

  void add(const Mapped& mapped) {
    aiString path;
    aiTextureMapMode wrap[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    unsigned set = 0;
    if (find(look_.parameters, mapped.map) || material_.GetTextureCount(mapped.type) == 0 ||
        material_.GetTexture(mapped.type, 0, &path, nullptr, &set, nullptr, nullptr, wrap) != aiReturn_SUCCESS)
      return;
    const std::string file = textures_.file(of(path), wrap[0], wrap[1]);
    if (file.empty()) return;
    TextureCoordinates at = coordinatesOf(material_, mapped.type, set, isGltf(material_));
    if (const auto placed = source_.placed.find(mapped.type); placed != source_.placed.end())
      at.stFromUv = at.stFromUv * placed->second;
    if (count_++ == 0) look_.first = at;
    if (at != look_.first && !look_.second) look_.second = at;
    if (at == look_.second)
      ofSecondSet_ += (ofSecondSet_.empty() ? "" : " ") + std::string(mapped.map);
    else if (at != look_.first)
      leaveOut("a third set of texture coordinates for its pictures");
    look_.parameters.push_back(param(mapped.map, file));
    if (mapped.channel) look_.parameters.push_back(param(mapped.channel, mapped.number));
    multiplyOne(mapped);
  }
  /// Returns the names of the parameters whose pictures are looked up at the second set of texture coordinates.
  const std::string& ofSecondSet() const { return ofSecondSet_; }
  void leaveOut(const std::string& what) { look_.leftOut += (look_.leftOut.empty() ? "" : ", ") + what; }

 private:
  /// Without a number to multiply, or with 0, as in formats without factors, a picture counts as it is.
  void multiplyOne(const Mapped& mapped) {
    if (!mapped.multiplied || mapped.multiplied == std::string("opacity")) return;
    const bool isColor = mapped.multiplied == std::string("emission"),
               isRoughness = mapped.multiplied == std::string("roughness");
    Param* p = find(look_.parameters, mapped.multiplied);
    if (isColor && !p)
      look_.parameters.push_back(param(mapped.multiplied, ValueType::Color, vec3(1.0f)));
    else if (!p)
      look_.parameters.push_back(param(mapped.multiplied, 1.0f));
    else if (isRoughness && !number(material_, AI_MATKEY_ROUGHNESS_FACTOR))
      p->floats = {1};
  }

  const aiMaterial& material_;
  Textures& textures_;
  const LookSource& source_;
  Look& look_;
  std::string ofSecondSet_;
  int count_ = 0;
};

/// Applies glTF's mode of alpha (section 3.9.4 of its specification): OPAQUE ignores alpha, BLEND uses it, and MASK
/// cuts off at a threshold.
void applyAlphaMode(const aiMaterial& material, Painter& painter, Look& look) {
  const float cutoff = number(material, AI_MATKEY_GLTF_ALPHACUTOFF).value_or(0.5f);
  const bool isMask = alphaMode(material) == "MASK";
  if (alphaMode(material) == "OPAQUE" || (isMask && cutoff <= 0)) {
    look.opacity = 1;
    look.usesVertexAlpha = false;
    return;
  }
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE})
    painter.add({type, "opacitymap", "opacity", "opacitychannel", 3});
  if (isMask) {
    look.shader = "disneycutout";
    look.parameters.push_back(param("opacitycutoff", cutoff));
  }
}

/// Makes an unlit material glow in its colour, which multiplies colours of vertices. It uses no other picture than that
/// of the colour.
void makeUnlit(Look& look) {
  if (const Param* p = find(look.parameters, "secondset"); p && p->strings[0].find("texturename") != std::string::npos)
    look.first = *look.second;
  look.second.reset();
  ParamList out{param("emission", ValueType::Color, look.color), param("specular", 0.0f)};
  for (Param& p : look.parameters)
    if (p.name == "texturename" || p.name == "linearize" || p.name.starts_with("opacity")) {
      if (p.name == "texturename") p.name = "emissionmap";
      out.push_back(p);
    }
  look.parameters = std::move(out);
  look.unlit = look.color;
  look.color = vec3(0.0f);
}

void addPictures(const aiMaterial& material, Textures& textures, const LookSource& source, Look& look) {
  Painter painter(material, textures, source, look);
  if (isGltf(material))
    for (const Mapped& mapped : kMetallicRoughness) painter.add(mapped);
  for (const Mapped& mapped : kMapped) painter.add(mapped);
  if (isGltf(material)) applyAlphaMode(material, painter, look);
  if (!painter.ofSecondSet().empty()) look.parameters.push_back(param("secondset", painter.ofSecondSet()));
  if ((source.pictureReplaces || !source.isColorGiven) && find(look.parameters, "texturename")) look.color = vec3(1.0f);
  if (find(look.parameters, "texturename") || find(look.parameters, "emissionmap"))
    look.parameters.push_back(param("linearize", 1.0f));
  const float scale = number(material, AI_MATKEY_GLTF_TEXTURE_SCALE(aiTextureType_NORMALS, 0)).value_or(1);
  if (find(look.parameters, "normalmap") && scale != 1) look.parameters.push_back(param("normalscale", scale));
  if (find(look.parameters, "opacitymap")) look.shader = "disneycutout";
  for (const LeftOut& l : kLeftOut)
    if (material.GetTextureCount(l.type) > 0) painter.leaveOut(l.what);
  if (number(material, AI_MATKEY_TRANSMISSION_FACTOR).value_or(0) > 0) painter.leaveOut("transmission");
}

}  // namespace

Look lookOf(const aiMaterial& material, Textures& textures, const LookSource& source) {
  Look out;
  out.isColorGiven = source.isColorGiven;
  aiString name;
  material.Get(AI_MATKEY_NAME, name);
  out.name = of(name);
  if (const auto base = color(material, AI_MATKEY_BASE_COLOR))
    out.color = *base;
  else if (const auto diffuse = color(material, AI_MATKEY_COLOR_DIFFUSE))
    out.color = *diffuse;
  out.opacity = glm::clamp(number(material, AI_MATKEY_OPACITY).value_or(1), 0.0f, 1.0f);
  const auto add = [&](const char* parameter, std::optional<float> value) {
    if (value && *value > 0) out.parameters.push_back(param(parameter, std::min(*value, 1.0f)));
  };
  if (const auto glossy = metallicOfSpecularGlossiness(material)) {
    out.color = glossy->color;
    out.opacity = glossy->opacity;
    out.parameters = {param("roughness", glossy->roughness), param("specular", glossy->specular)};
    add("metallic", glossy->metallic);
  } else {
    out.parameters = {param("roughness", roughnessOf(material))};
    add("metallic", number(material, AI_MATKEY_METALLIC_FACTOR));
  }
  add("clearcoat", number(material, AI_MATKEY_CLEARCOAT_FACTOR));
  if (const auto emitted = color(material, AI_MATKEY_COLOR_EMISSIVE); emitted && maxComponent(*emitted) > 0)
    out.parameters.push_back(
        param("emission", ValueType::Color, *emitted * number(material, AI_MATKEY_EMISSIVE_INTENSITY).value_or(1)));
  addPictures(material, textures, source, out);
  int shading = 0;
  if (material.Get(AI_MATKEY_SHADING_MODEL, shading) == aiReturn_SUCCESS && shading == aiShadingMode_Unlit)
    makeUnlit(out);
  return out;
}

Requests requestsOf(const Look& look) {
  return {call("Color", look.color), call("Opacity", vec3(look.opacity)),
          callWith(look.parameters, "Surface", look.shader)};
}

}  // namespace tomales::model
