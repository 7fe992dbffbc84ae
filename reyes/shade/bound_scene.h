// What the constructor of ShadingSystem leaves: every shader of a scene, bound. Immutable while shading.
#pragma once
#include "reyes/shade.h"
#include "reyes/shade/bound_shader.h"
#include "reyes/shade/shadow_map.h"
#include "reyes/shade/sky.h"
#include "reyes/shade/texture.h"
#include "reyes/shade/variables.h"

namespace tomales {

constexpr int kMostLightSamples = 1 << 12;  ///< Of one light from one point.

/// All that is known of a light: made when it is bound (bind_lights.cpp), of its shader's capabilities and roles.
struct BoundLight {
  BoundShaderPtr bound;
  int index = -1;  ///< In Scene::lights; one that was added stands behind those.
  int samples = 1;
  bool shadows = false;
  bool direct = true;        ///< Lights what the camera sees.
  bool indirect = true;      ///< Lights what gather rays see.
  float shadowVariance = 0;  ///< Of the share of light that passes: what its shadow rays may leave; 0: all are traced.
  bool visible = true;       ///< Glows for the camera (area lights) and for specular rays.
  bool nondiffuse = false, nonspecular = false;  ///< Left out by diffuse(), by specular().
  IndirectQuery query;                           ///< TM_LIGHT_INDIRECT alone,
  IndirectRequest request;                       ///< and what it asks of the whole frame.
  bool filters = false;                          ///< It brings what another indirect light brings.
  float maxVariation = 0;                        ///< TM_OCCLUDED alone: TmOcclusion::maxVariation.
  std::string group;                             ///< As it names it; else the handle.
  std::string category;                          ///< Names by commas.
  std::shared_ptr<const Sky> sky;                ///< TM_LIGHT_SKY alone.
  vec3 sourceTint{1.0f};                         ///< Of the indirect light that this one filters.
  bool can(TmCapability capability) const { return bound->can(capability); }
};

/// A primitive variable that takes the place of a shader parameter; whoever filled the points brought it to
/// current space.
struct Override {
  int param, primvarOffset, width;
};

struct BoundGroup {
  const ShadeGroup* group = nullptr;
  std::string object;  ///< For messages.
  BoundShaderPtr surface,
      indirectSurface;  ///< The second: for rays that hit it (Attribute "indirect" "surface").
  BoundShaderPtr displacement, atmosphere, interior, exterior;  ///< May be null.
  std::vector<Override> surfaceOverrides, indirectOverrides, displacementOverrides;
  std::vector<const BoundLight*> lights;
  std::optional<IndirectQuery> indirect;
  std::vector<BoundVariable> variables;  ///< As FrameOutput::variables.
  /// Of rays that gather diffuse light.
  const BoundShader& forDiffuseRays() const { return indirectSurface ? *indirectSurface : *surface; }
  int CsOffset = -1, OsOffset = -1, sOffset = -1, tOffset = -1, primvarFloats = 0;
};

class Binder;

struct BoundScene {
  BoundScene(const Scene& scene, ShaderRegistry& registry, Log& log, Stats& stats);
  ~BoundScene();
  /// Groups of the scene that are not bound yet.
  void bindNewGroups();

  const Scene& scene;
  Log& log;
  Stats& stats;
  const ShadeServices* services = nullptr;
  CloudServices* clouds = nullptr;
  Camera camera;
  mat4 cameraFromWorld;
  float specularSharpness;  ///< Over roughness, the exponent of specular().
  Textures textures;
  ShadowMaps shadowMaps;
  Skies skies;
  std::vector<std::unique_ptr<const BoundLight>> lights;  ///< As Scene::lights; null: unknown shader.
  const BoundLight* added = nullptr;  ///< The last of them, if Options::wantsIndirect has added it for all objects.
  BoundLight stored;                  ///< Stands for all lights where Illumination is not Lights.
  StableVector<BoundGroup> groups;    ///< As Scene::groups.
  BoundShaderPtr imager;              ///< May be null.
  ShadeGroup picture{std::make_shared<const Attributes>(), mat4(1.0f), {}, -1};
  BoundGroup pixels;  ///< Stands for the picture while the imager runs.

 private:
  BoundGroup bound(const ShadeGroup& group) const;
  void addIndirectLight();
  std::unique_ptr<Binder> binder_;
  FrameOutput output_;
  bool grows_ = false;  ///< What procedurals bring is known in the end.
};

}  // namespace tomales
