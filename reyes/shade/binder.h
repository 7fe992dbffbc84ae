// Private to bound_scene: finds the shaders of requests and resolves their parameters. Threads: one at a time.
#pragma once
#include <map>
#include <set>

#include "reyes/base/search_path.h"
#include "reyes/shade/bound_scene.h"
#include "reyes/shader_registry.h"

namespace tomales {

/// Returns the name of a request, with the folder of the file where it stands: the shader may lie beside that file.
ShaderName nameOf(const ShaderCall& call, TmKind kind);

/// Binds requests. Groups that share a request share its shader, so that each problem is reported once.
class Binder {
 public:
  Binder(const Scene& scene, ShaderRegistry& registry, const Textures& textures, const ShadowMaps& shadowMaps, Log& log)
      : scene_(scene),
        textures_(textures),
        shadowMaps_(shadowMaps),
        registry_(registry),
        log_(log),
        path_(pathOf(scene.options.searchPaths, "shader")),
        cameraFromWorld_(scene.cameraFromWorldAtOpen()) {
    for (const ShadeGroup& g : scene.groups) haveGeometry_.insert(g.attributes->areaLight);
  }

  BoundShaderPtr surface(const std::shared_ptr<const ShaderCall>& call, const SourceLoc& object,
                         const std::string& user) {
    return cached(call, object, user, TM_SURFACE);
  }
  BoundShaderPtr optional(const std::shared_ptr<const ShaderCall>& call, const std::string& user, TmKind kind) {
    return call ? cached(call, call->where, user, kind) : nullptr;
  }
  BoundShaderPtr imager(const std::optional<ShaderCall>& call, const std::string& user) {
    const bool none = !call || call->name.empty() || call->name == "null";
    return none ? nullptr : bind(&*call, call->where, user, TM_IMAGER);
  }
  /// Binds another surface by its bare name, in the space of the visible one.
  BoundShaderPtr indirectSurface(const Attributes& a, const SourceLoc& object, const std::string& user) {
    if (a.indirect.surface.empty()) return nullptr;
    ShaderCall call{a.indirect.surface, {}, {}, object};
    if (a.surface) {
      call.worldFromShader = a.surface->worldFromShader;
      call.where = a.surface->where;
    }
    return bind(&call, call.where, user, TM_SURFACE);
  }
  /// Notes a shader that is about to be bound. prepare() compiles the source files of all of these in parallel, so that
  /// binding them one by one finds them compiled.
  void expect(const ShaderCall* call, TmKind kind);
  void prepare();
  std::unique_ptr<BoundLight> light(const LightCall& call, int index);
  /// Makes the light that Options::wantsIndirect asks for.
  std::unique_ptr<BoundLight> addedIndirectLight(int index);

 private:
  BoundShaderPtr cached(const std::shared_ptr<const ShaderCall>& call, const SourceLoc& object, const std::string& user,
                        TmKind kind) {
    if (!call) return bind(nullptr, object, user, kind);
    const auto [it, isNew] = bound_.try_emplace(call.get());
    if (isNew) it->second = bind(call.get(), call->where, user, kind);
    return it->second;
  }
  BoundShaderPtr bind(const ShaderCall* call, const SourceLoc& where, const std::string& user, TmKind kind,
                      bool area = false);
  /// Returns the sky of a light with TM_LIGHT_SKY.
  std::shared_ptr<Sky> sky(const BoundShader& light);

  const Scene& scene_;
  const Textures& textures_;
  const ShadowMaps& shadowMaps_;
  ShaderRegistry& registry_;
  Log& log_;
  const std::string path_;
  const mat4 cameraFromWorld_;
  std::set<int> haveGeometry_;  ///< The area lights that some object belongs to.
  std::map<const ShaderCall*, BoundShaderPtr> bound_;
  std::set<const ShaderCall*> expected_;
  std::vector<ShaderName> names_;  ///< The shaders that have been expected since the last prepare().
};

/// Returns the openings to the sky that have been found for a scene.
Portals foundPortals(const Scene& scene);

/// Connects lights that filter an indirect light to their sources. Those without a source cast no light.
void connectFilters(BoundScene& scene);

}  // namespace tomales
