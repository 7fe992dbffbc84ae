// Every bound shader of a scene: the result of ShadingSystem's constructor. Constant while shading.
#pragma once
#include <atomic>
#include <map>
#include <span>

#include "reyes/shade.h"
#include "reyes/shade/bound_shader.h"
#include "reyes/shade/light_sets.h"
#include "reyes/shade/shadow_map.h"
#include "reyes/shade/sky.h"
#include "reyes/shade/texture.h"
#include "reyes/shade/variables.h"

namespace tomales {

constexpr int kMostLightSamples = 1 << 12;  ///< The limit for one light and one point.
constexpr int kLightCut = 32;               ///< Option "trace" "lightcut" where the scene says nothing.

/// Everything known about a light, from its shader's capabilities and roles (bind_lights.cpp).
struct BoundLight {
  BoundShaderPtr bound;
  int index = -1;  ///< Its index in Scene::lights, or behind those for one that was added.
  int samples = 1;
  bool shadows = false;
  bool direct = true;        ///< It lights what the camera sees.
  bool indirect = true;      ///< It lights what gather rays see.
  float shadowVariance = 0;  ///< The variance of transmission at which shadow rays may stop; 0: all rays are traced.
  bool visible = true;       ///< Area lights are seen by the camera, and all lights by specular rays.
  bool nondiffuse = false, nonspecular = false;  ///< True if diffuse() or specular() ignores it.
  bool allRound = false;                         ///< It shines from both sides of its geometry, and through it.
  IndirectQuery query;                           ///< Set for TM_LIGHT_INDIRECT alone.
  IndirectRequest request;                       ///< The light's request to the whole frame.
  bool filters = false;                          ///< It brings the light of another indirect light.
  float maxVariation = 0;    ///< TmOcclusion::maxVariation of its calls, if answers may be interpolated.
  std::string group;         ///< The name of its group, or its handle if it names none.
  std::string category;      ///< Names, separated by commas; "indirect" for an indirect light.
  std::shared_ptr<Sky> sky;  ///< Set for TM_LIGHT_SKY alone.
  vec3 sourceTint{1.0f};     ///< The tint of the indirect light that this one filters.
  bool can(TmCapability capability) const { return bound->can(capability); }
  /// Tells whether it is a sky that casts shadows, and whose shader knows portals but has none named.
  bool takesFoundPortals() const {
    return can(TM_LIGHT_SKY) && shadows && bound->find(TM_ROLE_SKY_PORTALS) &&
           bound->text(TM_ROLE_SKY_PORTALS, "").empty();
  }
};

/// Tells whether the context lets the light shine. Pre: it is no indirect light.
inline bool isMeant(const BoundLight& light, const ShadeContext& context) {
  return !context.onlyLightGroup || light.group == *context.onlyLightGroup;
}

/// A primitive variable that replaces a shader parameter. The points hold it in current space already.
struct Override {
  int param, primvarOffset, width;
};

struct BoundGroup {
  const ShadeGroup* group = nullptr;
  std::string object;  ///< The object's name in messages.
  BoundShaderPtr surface,
      indirectSurface;  ///< indirectSurface is for rays that hit it (Attribute "indirect" "surface").
  BoundShaderPtr displacement, atmosphere, interior, exterior;    ///< Each may be null.
  std::map<const BoundShader*, std::vector<Override>> overrides;  ///< For each of these shaders that has any.
  std::span<const Override> overridesOf(const BoundShader& shader) const {
    const auto it = overrides.find(&shader);
    return it == overrides.end() ? std::span<const Override>() : it->second;
  }
  std::vector<Override> displacementOutputs;  ///< Outputs of the displacement, and where points hold them.
  std::shared_ptr<const LightChoice> choice;  ///< Groups that have the same lights share it.
  /// Returns indices in BoundScene::lights. Lights of unknown shaders are left out.
  const LightList& lights() const { return choice->lights(); }
  std::optional<IndirectQuery> indirect;
  /// Indexed as FrameOutput::variables. Behind these are outputs that the atmosphere alone wants.
  std::vector<BoundVariable> variables;
  std::vector<Override>
      toldToAir;  ///< Outputs of the surface that the atmosphere reads, and their place in `variables`.
  /// Returns the surface for rays that gather diffuse light.
  const BoundShader& forDiffuseRays() const { return indirectSurface ? *indirectSurface : *surface; }
  /// Returns the volume shader inside or outside of its surfaces; null if there is none.
  const BoundShader* volume(bool inside) const { return (inside ? interior : exterior).get(); }
  int CsOffset = -1, OsOffset = -1, sOffset = -1, tOffset = -1, primvarFloats = 0;
};

class Binder;

struct BoundScene {
  BoundScene(const Scene& scene, ShaderRegistry& registry, Log& log, Stats& stats);
  ~BoundScene();
  /// Binds the groups of the scene that are not bound yet.
  void bindNewGroups();
  /// Returns a light. Pre: it belongs to some group, so it is not null.
  const BoundLight& light(int index) const { return *lights[static_cast<size_t>(index)]; }
  /// Gives the openings that have been found for the scene to all skies that take them.
  void takeFoundPortals();

  const Scene& scene;
  Log& log;
  Stats& stats;
  const ShadeServices* services = nullptr;
  CloudServices* clouds = nullptr;
  bool silent = false;  ///< Output of printf() in shaders is dropped.
  Camera camera;
  mat4 cameraFromWorld;
  int lightCut;             ///< Option "trace" "lightcut": how many of many lights a point runs; 0: all.
  float specularSharpness;  ///< Divided by the roughness, it is the exponent of specular().
  Textures textures;
  ShadowMaps shadowMaps;
  Skies skies;
  std::vector<std::unique_ptr<BoundLight>> lights;  ///< Indexed as Scene::lights; null for an unknown shader.
  std::optional<int> added;  ///< Index of the light that Options::wantsIndirect has added for all objects.
  /// Lights with a known shader; indirect lights; and lights whose answers may be interpolated
  /// (BoundLight::maxVariation). When few lights are wanted, it is quicker to look each of them up in a group than to
  /// go over all lights of the group.
  LightList known, indirect, interpolated;
  BoundLight stored;                     ///< Stands for all lights where Illumination is not Lights.
  StableVector<BoundGroup> groups;       ///< Indexed as Scene::groups.
  std::atomic<bool> hasVolumes = false;  ///< Some group is a Volume.
  BoundShaderPtr imager;                 ///< May be null.
  ShadeGroup picture{std::make_shared<const Attributes>(), mat4(1.0f), {}, -1};
  BoundGroup pixels;  ///< Stands for the picture while the imager runs.

 private:
  BoundGroup bound(const ShadeGroup& group);
  void addIndirectLight();
  void listLights();
  void shareChoices();
  std::shared_ptr<const LightChoice> choiceAmong(LightList on, std::shared_ptr<const LightChoice> longest) const;
  std::unique_ptr<Binder> binder_;
  FrameOutput output_;
  std::map<LightList, std::shared_ptr<const LightChoice>> choices_;  ///< Indexed by their lights but `added`.
  bool grows_ = false;  ///< True if procedurals may add groups while the frame is rendered.
};

}  // namespace tomales
