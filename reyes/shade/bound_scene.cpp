#include "reyes/shade/bound_scene.h"

#include <fmt/format.h>

#include "reyes/shade/substitute.h"

namespace tomales {
namespace {

const ParamNames kLightParams{"lighting", "shadowname", "__nondiffuse", "__nonspecular"};

std::string pathOf(const Options& options, const char* kind) {
  const auto it = options.searchPaths.find(kind);
  return it == options.searchPaths.end() ? std::string() : it->second;
}

IndirectQuery queryOf(const BoundShader& light) {
  IndirectQuery q;
  q.samples = std::max(1, static_cast<int>(light.number("samples", static_cast<float>(q.samples))));
  q.maxError = light.number("maxerror", q.maxError);
  q.maxDistance = light.number("maxdist", q.maxDistance);
  q.errorFunction = light.text("errorfunction", q.errorFunction);
  q.radiance = light.text("radiance", q.radiance);
  q.atlas = light.text("atlas", q.atlas);
  q.subset = light.text("subset", q.subset);
  q.bounces = std::max(0, static_cast<int>(light.number("bounces", static_cast<float>(q.bounces))));
  return q;
}

/// Binds requests; groups that share a request share its shader, so that each problem is told once.
class Binder {
 public:
  Binder(const Scene& scene, ShaderRegistry& registry, Log& log)
      : scene_(scene),
        registry_(registry),
        log_(log),
        path_(pathOf(scene.options, "shader")),
        cameraFromWorld_(scene.cameraFromWorldAtOpen()) {}

  BoundShaderPtr surface(const std::shared_ptr<const ShaderCall>& call, const SourceLoc& object,
                         const std::string& user) {
    return cached(call, object, user, TM_SURFACE);
  }
  BoundShaderPtr displacement(const std::shared_ptr<const ShaderCall>& call, const std::string& user) {
    return call ? cached(call, call->where, user, TM_DISPLACEMENT) : nullptr;
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
  const char* consequence = kind == TM_SURFACE ? "a magenta checker is rendered"
                            : kind == TM_LIGHT ? "it casts no light"
                                               : "nothing is displaced";
  const char* kindName = kind == TM_SURFACE ? "surface" : kind == TM_LIGHT ? "light" : "displacement";
  log_.report(Severity::Missing, "shader-missing", where,
              fmt::format("{}: {} shader \"{}\" is unknown; {}", user, kindName, name, consequence));
  if (kind != TM_SURFACE) return nullptr;
  return bindShader(kSubstituteSurface, nullptr, where, user, currentFromShader, {}, log_);
}

/// Parameters that every light understands, whether or not its shader declares them.
void setHostParams(BoundLight& light, const LightCall& call, Log& log) {
  const ParamList& params = call.shader.params;
  const auto number = [&](const char* name) {
    const Param* p = findParam(params, name);
    return p ? p->number(0) : light.bound->number(name, 0);
  };
  const auto text = [&](const char* name) {
    const Param* p = findParam(params, name);
    return p && !p->strings.empty() ? p->strings[0] : std::string();
  };
  const auto warn = [&](const char* code, const std::string& problem) {
    log.report(Severity::Warning, code, call.shader.where, light.bound->user + ": " + problem);
  };
  light.nondiffuse = number("__nondiffuse") != 0, light.nonspecular = number("__nonspecular") != 0;
  const std::string lighting = text("lighting"), shadows = text("shadowname");
  light.direct = lighting != "indirect", light.indirect = lighting != "direct";
  if (!lighting.empty() && lighting != "both" && light.direct && light.indirect)
    warn("light-lighting",
         fmt::format("lighting \"{}\" is none of both, direct, indirect; both is used", lighting));
  if (!shadows.empty() && shadows != "raytrace" && !light.bound->find("shadowname"))
    warn("light-shadow-map",
         fmt::format("shadow map \"{}\" is ignored; only \"raytrace\" is supported", shadows));
  if (call.area && !light.can(TM_LIGHT_AREA))
    warn("light-area",
         fmt::format("\"{}\" is not an area light; it shines without its geometry", call.shader.name));
  if (!call.area && light.can(TM_LIGHT_AREA))
    warn("light-area",
         fmt::format("\"{}\" needs AreaLightSource and geometry; it casts no light", call.shader.name));
}

std::unique_ptr<const BoundLight> Binder::light(const LightCall& call, int index) {
  BoundShaderPtr bound =
      bind(&call.shader, call.shader.where, fmt::format("light \"{}\"", call.handle), TM_LIGHT);
  if (!bound) return nullptr;
  auto light = std::make_unique<BoundLight>();
  light->bound = bound, light->index = index;
  setHostParams(*light, call, log_);
  const bool indirect = light->can(TM_LIGHT_INDIRECT);
  light->shadows = !indirect && (call.castsShadows || light->can(TM_LIGHT_SHADOWED));
  if (light->can(TM_LIGHT_AREA)) light->samples = std::max(1, static_cast<int>(bound->number("samples", 16)));
  if (indirect) light->samples = 3, light->query = queryOf(*bound);
  return light;
}

std::vector<Override> overridesOf(const BoundShader& bound, const std::vector<Primvar>& primvars) {
  std::vector<Override> out;
  for (int i = 0; i < bound.shader->paramCount; ++i) {
    const TmParamDecl& decl = bound.shader->params[i];
    const int width = decl.type == TM_FLOAT ? 1 : decl.type <= TM_NORMAL ? 3 : 0;
    int offset = 0;
    for (const Primvar& p : primvars) {
      if (p.name == decl.name && p.width == width && decl.arrayLength == 1) out.push_back({i, offset, width});
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

}  // namespace

BoundScene::BoundScene(const Scene& s, ShaderRegistry& registry, Log& l, Stats& st)
    : scene(s),
      log(l),
      stats(st),
      camera(s.options),
      cameraFromWorld(s.cameraFromWorldAtOpen()),
      textures(pathOf(s.options, "texture"), l, st) {
  Binder binder(scene, registry, log);
  for (const auto& call : scene.lights)
    lights.push_back(binder.light(*call, static_cast<int>(lights.size())));
  for (const ShadeGroup& group : scene.groups) {
    BoundGroup g;
    g.group = &group;
    const Attributes& a = *group.attributes;
    SourceLoc where;
    if (group.exampleObject >= 0) {
      const Object& o = scene.objects[static_cast<size_t>(group.exampleObject)];
      g.object = objectName(o), where = o.where;
    }
    g.surface = binder.surface(a.surface, where, g.object);
    g.indirectSurface = binder.indirectSurface(a, where, g.object);
    g.displacement = binder.displacement(a.displacement, g.object);
    g.surfaceOverrides = overridesOf(*g.surface, group.primvars);
    if (g.indirectSurface) g.indirectOverrides = overridesOf(*g.indirectSurface, group.primvars);
    if (g.displacement) g.displacementOverrides = overridesOf(*g.displacement, group.primvars);
    findPrimvars(g);
    for (int index : a.lights)
      if (index >= 0 && index < static_cast<int>(lights.size()) && lights[static_cast<size_t>(index)])
        g.lights.push_back(lights[static_cast<size_t>(index)].get());
    for (const BoundLight* light : g.lights)
      if (light->can(TM_LIGHT_INDIRECT) && a.indirect.receive && !g.indirect) {
        g.indirect = light->query;
        if (a.irradianceMaxError) g.indirect->maxError = *a.irradianceMaxError;
      }
    groups.push_back(std::move(g));
  }
}

}  // namespace tomales
