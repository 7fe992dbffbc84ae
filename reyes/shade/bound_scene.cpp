#include "reyes/shade/bound_scene.h"

#include <fmt/format.h>

#include "reyes/shade/substitute.h"

namespace tomales {
namespace {

/// Names of shadow maps, of shadowpoint one for each direction.
const ParamNames kShadowMaps{"shadowname", "sfpx", "sfnx", "sfpy", "sfny", "sfpz", "sfnz"};
const ParamNames kLightParams{"lighting", "__nondiffuse", "__nonspecular", "__group", "lightgroup", "__category", "shadowname", "sfpx",
                              "sfnx",     "sfpy",         "sfny",          "sfpz",       "sfnz",     "shadowvariance"};

std::string pathOf(const Options& options, const char* kind) {
  const auto it = options.searchPaths.find(kind);
  return it == options.searchPaths.end() ? std::string() : it->second;
}

constexpr int kMostRays = 1 << 16;  ///< Of one irradiance sample.
constexpr int kMostBounces = 1000;  ///< Beyond these no picture changes any more.

/// A count among the parameters of a light.
int countOf(const BoundShader& light, const char* name, int fallback, int least, int most, Log& log) {
  const float asked = light.number(name, static_cast<float>(fallback));
  const auto used = static_cast<int>(std::clamp(asked, static_cast<float>(least), static_cast<float>(most)));
  if (asked < static_cast<float>(least) || asked > static_cast<float>(most))
    log.report(Severity::Warning, fmt::format("light-{}", name), light.where,
               fmt::format("{}: {} {} is out of range; {} is used", light.user, name, asked, used));
  return used;
}

void warnAboutUnsupported(const BoundShader& light, const IndirectQuery& q, Log& log) {
  const auto warn = [&](const char* name, const std::string& value, const char* consequence) {
    log.report(Severity::Warning, fmt::format("light-{}", name), light.where,
               fmt::format("{}: {} \"{}\" is not supported; {}", light.user, name, value, consequence));
  };
  if (q.errorFunction != "screen" && q.errorFunction != "ward" && q.errorFunction != "hessian")
    warn("errorfunction", q.errorFunction, "\"screen\" is used");
  if (q.radiance != "shader" && q.radiance != "atlas") warn("radiance", q.radiance, "gather rays run the shaders");
  if (!q.atlas.empty()) warn("atlas", q.atlas, "it is not read");
  if (!q.subset.empty()) warn("subset", q.subset, "gather rays see all objects");
}

IndirectQuery queryOf(const BoundShader& light, Log& log) {
  IndirectQuery q;
  q.samples = countOf(light, "samples", q.samples, 1, kMostRays, log);
  q.maxError = light.number("maxerror", q.maxError);
  q.maxDistance = light.number("maxdist", q.maxDistance);
  q.errorFunction = light.text("errorfunction", q.errorFunction);
  q.radiance = light.text("radiance", q.radiance);
  q.atlas = light.text("atlas", q.atlas);
  q.subset = light.text("subset", q.subset);
  q.bounces = countOf(light, "bounces", q.bounces, 0, kMostBounces, log);
  warnAboutUnsupported(light, q, log);
  return q;
}

}  // namespace

/// Binds requests; groups that share a request share its shader, so that each problem is told once.
class Binder {
 public:
  Binder(const Scene& scene, ShaderRegistry& registry, const Textures& textures, const ShadowMaps& shadowMaps, Log& log)
      : scene_(scene),
        textures_(textures),
        shadowMaps_(shadowMaps),
        registry_(registry),
        log_(log),
        path_(pathOf(scene.options, "shader")),
        cameraFromWorld_(scene.cameraFromWorldAtOpen()) {}

  BoundShaderPtr surface(const std::shared_ptr<const ShaderCall>& call, const SourceLoc& object,
                         const std::string& user) {
    return cached(call, object, user, TM_SURFACE);
  }
  BoundShaderPtr optional(const std::shared_ptr<const ShaderCall>& call, const std::string& user,
                          TmKind kind) {
    return call ? cached(call, call->where, user, kind) : nullptr;
  }
  BoundShaderPtr imager(const std::optional<ShaderCall>& call, const std::string& user) {
    const bool none = !call || call->name.empty() || call->name == "null";
    return none ? nullptr : bind(&*call, call->where, user, TM_IMAGER);
  }
  /// Another surface by its bare name, in the space of the visible one.
  BoundShaderPtr indirectSurface(const Attributes& a, const SourceLoc& object, const std::string& user) {
    if (a.indirect.surface.empty()) return nullptr;
    ShaderCall call{a.indirect.surface, {}, {}, object};
    if (a.surface) call.worldFromShader = a.surface->worldFromShader, call.where = a.surface->where;
    return bind(&call, call.where, user, TM_SURFACE);
  }
  std::unique_ptr<const BoundLight> light(const LightCall& call, int index);

 private:
  BoundShaderPtr cached(const std::shared_ptr<const ShaderCall>& call, const SourceLoc& object,
                        const std::string& user, TmKind kind) {
    if (!call) return bind(nullptr, object, user, kind);
    const auto [it, isNew] = bound_.try_emplace(call.get());
    if (isNew) it->second = bind(call.get(), call->where, user, kind);
    return it->second;
  }
  BoundShaderPtr bind(const ShaderCall* call, const SourceLoc& where, const std::string& user, TmKind kind);

  const Scene& scene_;
  const Textures& textures_;
  const ShadowMaps& shadowMaps_;
  ShaderRegistry& registry_;
  Log& log_;
  const std::string path_;
  const mat4 cameraFromWorld_;
  std::map<const ShaderCall*, BoundShaderPtr> bound_;
};

BoundShaderPtr Binder::bind(const ShaderCall* call, const SourceLoc& where, const std::string& user,
                            TmKind kind) {
  const std::string name = call ? call->name : "defaultsurface";
  const TmShader* shader = registry_.find(name, kind, path_);
  const float open = scene_.options.shutterOpen;
  const mat4 currentFromShader = call ? cameraFromWorld_ * call->worldFromShader.at(open) : mat4(1.0f);
  if (shader) {
    const bool isLight = kind == TM_LIGHT;
    return bindShader(*shader, call, where, user, currentFromShader, isLight ? kLightParams : ParamNames{},
                      log_);
  }
  static constexpr const char* kKinds[] = {"surface", "displacement", "light", "volume", "imager"};
  static constexpr const char* kConsequences[] = {"a magenta checker is rendered", "nothing is displaced",
                                                  "it casts no light", "the air is clear",
                                                  "the picture stays as it is"};
  log_.report(
      Severity::Missing, "shader-missing", where,
      fmt::format("{}: {} shader \"{}\" is unknown; {}", user, kKinds[kind], name, kConsequences[kind]));
  if (kind != TM_SURFACE) return nullptr;
  return bindShader(kSubstituteSurface, nullptr, where, user, currentFromShader, {}, log_);
}

namespace {

/// Parameters that every light understands, whether or not its shader declares them.
void setHostParams(BoundLight& light, const LightCall& call, const ShadowMaps& maps, Log& log) {
  const ParamList& params = call.shader.params;
  const auto number = [&](const char* name) {
    const Param* p = findParam(params, name);
    return p ? p->number(0) : light.bound->number(name, 0);
  };
  const auto text = [&](std::string_view name) {
    const Param* p = findParam(params, name);
    return p && !p->strings.empty() ? p->strings[0] : std::string();
  };
  const auto warn = [&](const char* code, const std::string& problem) {
    log.report(Severity::Warning, code, call.shader.where, light.bound->user + ": " + problem);
  };
  light.shadowVariance = std::max(0.0f, number("shadowvariance"));
  light.nondiffuse = number("__nondiffuse") != 0, light.nonspecular = number("__nonspecular") != 0;
  light.group = !text("__group").empty() ? text("__group") : !text("lightgroup").empty() ? text("lightgroup") : call.handle;
  light.category = !text("__category").empty() ? text("__category") : light.bound->text("__category", "");
  const std::string lighting = text("lighting");
  light.direct = lighting != "indirect", light.indirect = lighting != "direct";
  if (!lighting.empty() && lighting != "both" && light.direct && light.indirect)
    warn("light-lighting",
         fmt::format("lighting \"{}\" is none of both, direct, indirect; both is used", lighting));
  for (const std::string_view name : kShadowMaps) {
    const std::string map = text(name);
    if (map.empty()) continue;
    const bool traced = map == "raytrace";
    if (!traced && !light.bound->find(name))
      warn("light-shadow-map", fmt::format("its shader reads no shadow map \"{}\"; shadows are traced instead", map));
    const bool mapped = !traced && light.bound->find(name) && maps.find(map, call.shader.where, light.bound->user);
    light.shadows = light.shadows || !mapped;
  }
  if (call.area && !light.can(TM_LIGHT_AREA))
    warn("light-area",
         fmt::format("\"{}\" is not an area light; it shines without its geometry", call.shader.name));
  if (!call.area && light.can(TM_LIGHT_AREA))
    warn("light-area",
         fmt::format("\"{}\" needs AreaLightSource and geometry; it casts no light", call.shader.name));
}

bool hasGeometry(const LightCall& call, const Scene& scene) {
  return std::any_of(scene.groups.begin(), scene.groups.end(),
                     [&](const ShadeGroup& g) { return g.attributes->areaLight == call.index; });
}

/// Of a space, whatever its scale, from current ones.
mat3 directionsOf(const mat4& currentFromSpace) {
  mat3 axes(currentFromSpace);
  for (int k = 0; k < 3; ++k) axes[k] = normalizeOr(axes[k], axes[k]);
  return glm::transpose(axes);
}

}  // namespace

std::unique_ptr<const BoundLight> Binder::light(const LightCall& call, int index) {
  BoundShaderPtr bound =
      bind(&call.shader, call.shader.where, fmt::format("light \"{}\"", call.handle), TM_LIGHT);
  if (!bound) return nullptr;
  auto light = std::make_unique<BoundLight>();
  light->bound = bound, light->index = index;
  const bool indirect = light->can(TM_LIGHT_INDIRECT);
  light->shadows = call.castsShadows || light->can(TM_LIGHT_SHADOWED);
  setHostParams(*light, call, shadowMaps_, log_);
  if (call.area && light->can(TM_LIGHT_AREA) && !hasGeometry(call, scene_))
    log_.report(Severity::Warning, "light-no-geometry", call.shader.where,
                bound->user + ": no geometry follows the AreaLightSource; it casts no light");
  light->shadows = light->shadows && !indirect;
  if (light->can(TM_LIGHT_SKY)) {
    const std::string picture = bound->text("map", "");
    light->sky = picture.empty() ? std::make_shared<const Sky>()
                                 : std::make_shared<const Sky>(textures_, picture, bound->where, bound->user,
                                                               directionsOf(bound->text("mapspace", "") == "shader" ? bound->currentFromShader : cameraFromWorld_));
  }
  if (light->can(TM_LIGHT_AREA) || light->can(TM_LIGHT_SKY) || light->can(TM_LIGHT_SAMPLED))
    light->samples = countOf(*bound, "samples", 16, 1, kMostLightSamples, log_);
  if (indirect) light->samples = 3, light->query = queryOf(*bound, log_);
  return light;
}

namespace {

/// A light that filters an indirect light asks for the same light as its source. False: there is none.
bool connectFilter(BoundLight& filter, const BoundScene& scene) {
  const std::string source = filter.bound->text("source", "");
  for (size_t i = scene.lights.size(); i-- > 0;) {
    const BoundLight* light = scene.lights[i].get();
    if (!light || scene.scene.lights[i]->handle != source) continue;
    if (!light->can(TM_LIGHT_INDIRECT) || light->bound->find("source")) continue;
    filter.query = light->query;
    filter.sourceTint = light->bound->number("intensity", 1) * light->bound->color("lightcolor", vec3(1.0f));
    return true;
  }
  scene.log.report(Severity::Missing, "light-source", filter.bound->where,
                   fmt::format("{}: source \"{}\" is not the handle of an indirect light; it casts no light",
                               filter.bound->user, source));
  return false;
}

void connectFilters(BoundScene& scene) {
  for (auto& light : scene.lights) {
    if (!light || !light->can(TM_LIGHT_INDIRECT) || !light->bound->find("source")) continue;
    auto filter = std::make_unique<BoundLight>(*light);
    light = connectFilter(*filter, scene) ? std::move(filter) : nullptr;
  }
}

/// Told once of each shader: parameters that primitive variables of their name cannot override.
std::vector<Override> overridesOf(const BoundShader& bound, const std::vector<Primvar>& primvars, Log& log) {
  std::vector<Override> out;
  for (int i = 0; i < bound.shader->paramCount; ++i) {
    const TmParamDecl& decl = bound.shader->params[i];
    if (isOutput(decl)) continue;
    const int width = typeOf(decl) == TM_FLOAT ? 1 : typeOf(decl) <= TM_NORMAL ? 3 : 0;
    int offset = 0;
    for (const Primvar& p : primvars) {
      const bool same = p.name == decl.name && p.width == width && decl.arrayLength == 1;
      if (same && isUniform(decl))
        log.report(Severity::Warning, fmt::format("shader-parameter-uniform-{}", bound.shader->name), bound.where,
                   fmt::format("{}: shader \"{}\": parameter \"{}\" is uniform; the primitive variable of that name is ignored", bound.user,
                               bound.shader->name, decl.name));
      else if (same)
        out.push_back({i, offset, width});
      offset += p.width;
    }
  }
  return out;
}

void findPrimvars(BoundGroup& g) {
  for (const Primvar& p : g.group->primvars) {
    if (p.name == "Cs" && p.width == 3) g.CsOffset = g.primvarFloats;
    if (p.name == "Os" && p.width == 3) g.OsOffset = g.primvarFloats;
    if (p.name == "s" && p.width == 1) g.sOffset = g.primvarFloats;
    if (p.name == "t" && p.width == 1) g.tOffset = g.primvarFloats;
    g.primvarFloats += p.width;
  }
}

void warnAboutUnwritten(const FrameOutput& output, const BoundScene& scene) {
  for (size_t i = 0; i < output.variables.size(); ++i) {
    const Variable& v = output.variables[i];
    const auto writes = [&](const BoundGroup& g) { return g.variables[i].from != BoundVariable::From::Nothing; };
    if (std::any_of(scene.groups.begin(), scene.groups.end(), writes)) continue;
    scene.log.report(Severity::Warning, fmt::format("channel-unwritten {}", v.source), v.where,
                     fmt::format("no shader and no surface of this frame has an output \"{}\"; the channel holds {}", v.source, v.fill));
  }
}

}  // namespace

namespace {

const Param* optionOf(const Options& options, const char* key) {
  const auto it = options.user.find(key);
  return it == options.user.end() ? nullptr : &it->second;
}

/// docs/decisions/0004.
float specularSharpnessOf(const Options& options, Log& log) {
  const Param* convention = optionOf(options, "shade:specular");
  const std::string name = convention && !convention->strings.empty() ? convention->strings[0] : "prman";
  if (name != "prman" && name != "rispec")
    log.report(Severity::Warning, "option-specular", {},
               "Option \"shade\" \"specular\" \"" + name + "\" is neither \"prman\" nor \"rispec\"; \"prman\" is used");
  return name == "rispec" ? 1.0f : 8.0f;
}

/// Option "limits" "texturememory" is in KB.
int64_t textureMemoryOf(const Options& options) {
  const Param* limit = optionOf(options, "limits:texturememory");
  return limit ? static_cast<int64_t>(std::max(1.0f, limit->number(0))) << 10 : TextureSettings{}.memory_bytes;
}

/// Its shader never runs.
BoundShaderPtr storedLight() {
  static const TmShader shader{TM_SHADER_ABI, sizeof(TmShader), "stored irradiance", TM_LIGHT, 0, nullptr, 0, nullptr, ""};
  auto bound = std::make_shared<BoundShader>();
  bound->shader = &shader;
  return bound;
}

}  // namespace

BoundScene::BoundScene(const Scene& s, ShaderRegistry& registry, Log& l, Stats& st)
    : scene(s),
      log(l),
      stats(st),
      camera(s.options),
      cameraFromWorld(s.cameraFromWorldAtOpen()),
      specularSharpness(specularSharpnessOf(s.options, l)),
      textures({pathOf(s.options, "texture"), pathOf(s.options, "texturecache"), textureMemoryOf(s.options)}, l, st),
      shadowMaps(pathOf(s.options, "texture"), l) {
  output_ = outputOf(scene.options);
  binder_ = std::make_unique<Binder>(scene, registry, textures, shadowMaps, log);
  for (const auto& call : scene.lights)
    lights.push_back(binder_->light(*call, static_cast<int>(lights.size())));
  connectFilters(*this);
  stored.bound = storedLight();
  pixels.group = &picture, pixels.object = "the picture";
  imager = binder_->imager(scene.options.imager, pixels.object);
  bindNewGroups();
  warnAboutUnwritten(output_, *this);
}

BoundScene::~BoundScene() = default;

void BoundScene::bindNewGroups() {
  while (groups.size() < scene.groups.size()) groups.push_back(bound(scene.groups[groups.size()]));
}

BoundGroup BoundScene::bound(const ShadeGroup& group) const {
  BoundGroup g;
  g.group = &group;
  const Attributes& a = *group.attributes;
  SourceLoc where;
  if (group.exampleObject >= 0) {
    const Object& o = scene.objects[static_cast<size_t>(group.exampleObject)];
    g.object = objectName(o), where = o.where;
  }
  g.surface = binder_->surface(a.surface, where, g.object);
  g.indirectSurface = binder_->indirectSurface(a, where, g.object);
  g.displacement = binder_->optional(a.displacement, g.object, TM_DISPLACEMENT);
  g.atmosphere = binder_->optional(a.atmosphere, g.object, TM_VOLUME);
  g.interior = binder_->optional(a.interior, g.object, TM_VOLUME);
  g.exterior = binder_->optional(a.exterior, g.object, TM_VOLUME);
  g.surfaceOverrides = overridesOf(*g.surface, group.primvars, log);
  if (g.indirectSurface) g.indirectOverrides = overridesOf(*g.indirectSurface, group.primvars, log);
  if (g.displacement) g.displacementOverrides = overridesOf(*g.displacement, group.primvars, log);
  findPrimvars(g);
  for (int index : a.lights)
    if (index >= 0 && index < static_cast<int>(lights.size()) && lights[static_cast<size_t>(index)])
      g.lights.push_back(lights[static_cast<size_t>(index)].get());
  for (const BoundLight* light : g.lights)
    if (light->can(TM_LIGHT_INDIRECT) && a.indirect.receive && !g.indirect) {
      g.indirect = light->query;
      if (a.irradianceMaxError) g.indirect->maxError = *a.irradianceMaxError;
    }
  g.variables = bindVariables(output_, g);
  return g;
}

}  // namespace tomales
