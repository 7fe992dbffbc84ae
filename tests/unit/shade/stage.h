// A scene of one object with hand-made points, and stand-ins for rays, so that every expected value can be
// worked out on paper.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "reyes/prim_factories.h"
#include "reyes/shade.h"
#include "reyes/shader_registry.h"

namespace tomales {

inline Param number(const std::string& name, float v) {
  Param p;
  p.name = name;
  p.floats = {v};
  return p;
}
inline Param triple(const std::string& name, ValueType type, const vec3& v) {
  Param p;
  p.name = name;
  p.type = type;
  p.floats = {v.x, v.y, v.z};
  return p;
}
inline Param color(const std::string& name, const vec3& v) { return triple(name, ValueType::Color, v); }
inline Param point(const std::string& name, const vec3& v) { return triple(name, ValueType::Point, v); }
inline Param text(const std::string& name, const std::string& v) {
  Param p;
  p.name = name;
  p.type = ValueType::String;
  p.strings = {v};
  return p;
}

/// Geometry is never asked of it; only its primitive variables matter.
class BlankPrim final : public Prim {
 public:
  explicit BlankPrim(std::vector<Primvar> primvars) : Prim(std::move(primvars)) {}
  uint32_t patchCount() const override { return 1; }
  PatchInfo info(uint32_t) const override { return {}; }
  Bound3 bound(uint32_t, const UvRect&) const override { return {}; }
  void evaluate(uint32_t, int, const float*, const float*, SurfacePoints) const override {}
  void interpolate(uint32_t, int, int, const float*, const float*, float*, int) const override {}
};

/// Rays that are functions; unset ones leave everything as it is.
class FakeServices final : public ShadeServices {
 public:
  std::function<float(const vec3& P, const vec3& toward)> visible;
  std::function<float(const vec3& P, const vec3& direction)> met;  ///< Distance
  std::function<vec3(const vec3& direction)> seen;                 ///< Colour
  mutable std::vector<RayQuery> asked;
  bool deep = false;  ///< Rays are past the limit of their depth.
  std::function<void(float a, float b, vec3& P, vec3& N, float& area)> emitter;
  vec3 E{0.0f}, dominant[3] = {vec3(0, 0, -1), vec3(0, 0, -1), vec3(0, 0, -1)};
  mutable int shadowRays = 0, gathers = 0;
  mutable std::vector<IndirectQuery> queries;

  void transmission(const ShadePoints& points, const uint8_t* active, TmConstVec3 toward, const ShadowRays& rays,
                    const ShadeContext&, TmVec3 light) const override {
    lastSolar = rays.solar;
    for (int i = 0; i < points.count(); ++i) {
      if (!active[i]) continue;
      ++shadowRays;
      const float v = visible ? visible(points.position(i), {toward.x[i], toward.y[i], toward.z[i]}) : 1.0f;
      light.x[i] *= v;
      light.y[i] *= v;
      light.z[i] *= v;
    }
  }
  bool tracesFrom(const ShadePoints&, const RayQuery&, const ShadeContext&) const override { return !deep; }
  void trace(const ShadePoints& points, const uint8_t* active, TmConstVec3 P, TmConstVec3 d, const RayQuery& query,
             const ShadeContext&, const RayResult& result) const override {
    asked.push_back(query);
    for (int i = 0; i < points.count(); ++i) {
      if (!active[i]) continue;
      const vec3 toward{d.x[i], d.y[i], d.z[i]};
      const float way = met ? met({P.x[i], P.y[i], P.z[i]}, toward) : kInfinity,
                  distance = way < query.maxDistance ? way : kInfinity;
      if (result.effective) result.effective[i] = 2 * distance;
      if (result.distance) result.distance[i] = distance;
      if (result.leaves) result.leaves[i] = met && distance == kInfinity;
      const vec3 color = seen && toward != vec3(0) ? seen(toward) : vec3(0);
      for (const RayOutput& o : result.outputs)
        for (int k = 0; k < o.floats && distance < kInfinity; ++k) o.c[k][i] = o.name == "surface:Ci" ? color[k] : 1.0f;
      if (result.color.x) {
        set(result.color, i, color);
      }
    }
  }
  bool interpolatedHemisphere(const ShadePoints& points, const uint8_t* active, TmConstVec3, const HemisphereQuery&,
                              const ShadeContext&, TmVec3 out) const override {
    if (!interpolated) return false;
    for (int i = 0; i < points.count(); ++i)
      if (active[i]) set(out, i, vec3(*interpolated));
    return true;
  }
  std::optional<float>
      interpolated;  ///< What records answer to occlusion() and indirectdiffuse(); none: rays must tell.
  bool volumesBefore(const ShadePoints& points, const ShadeContext&, ShadedPoints& out) const override {
    if (!volumes) return false;
    out.resize(points.count());
    for (int i = 0; i < points.count(); ++i) out.set(i, volumes->first, volumes->second);
    return true;
  }
  std::optional<std::pair<vec3, vec3>> volumes;  ///< The colour and opacity of Volumes before every point.
  float emitterReach(int) const override { return 0; }
  float emitterArea(int) const override { return 1; }
  bool sampleEmitter(int, int count, TmConstVec3 from, const float* a, const float* b,
                     const EmitterPoints& out) const override {
    if (!emitter) return false;
    for (int i = 0; i < count; ++i) {
      vec3 p, n;
      float area = 0;
      emitter(a[i], b[i], p, n, area);
      const vec3 path = p - vec3(from.x[i], from.y[i], from.z[i]);
      const float cosine = -dot(n, glm::normalize(path));
      set(out.P, i, p);
      set(out.N, i, n);
      out.pdf[i] = cosine > 1e-5f ? dot(path, path) / (cosine * area) : 0.0f;
      out.meetPdf[i] = 0;
    }
    return true;
  }
  void meetEmitter(int, int count, TmConstVec3, TmConstVec3, const EmitterPoints& out) const override {
    std::fill_n(out.pdf, count, 0.0f);
  }
  void indirectDiffuse(const ShadePoints& points, const uint8_t* active, TmConstVec3, const IndirectQuery& query,
                       const ShadeContext&, IndirectResult out) const override {
    queries.push_back(query);
    for (int i = 0; i < points.count(); ++i) {
      if (!active[i]) continue;
      ++gathers;
      set(out.E, i, E);
      for (int k = 0; k < 3; ++k) {
        set(out.dominant[k], i, dominant[k]);
      }
    }
  }
  vec3 stored{0.0f};  ///< E/pi
  void storedIrradiance(const ShadePoints& points, const uint8_t* active, TmVec3 out) const override {
    for (int i = 0; i < points.count(); ++i)
      if (active[i]) set(out, i, stored);
  }
  mutable bool lastSolar = false;
};

class Stage : public ::testing::Test {
 protected:
  Stage() : registry(log) { registry.addLibrary(tomales_builtin_shaders(), "built-in"); }

  static SourceLoc at(int line) { return {std::make_shared<const std::string>("stage.rib"), line}; }
  static ShaderCall call(const std::string& name, ParamList params, int line = 7) {
    return {name, std::move(params), Motion::still(mat4(1.0f)), at(line)};
  }
  void surface(const std::string& name, ParamList params = {}) {
    attributes.surface = std::make_shared<const ShaderCall>(call(name, std::move(params)));
  }
  void displacement(const std::string& name, ParamList params = {}) {
    attributes.displacement = std::make_shared<const ShaderCall>(call(name, std::move(params), 8));
  }
  LightCall& light(const std::string& name, ParamList params = {}, bool area = false) {
    auto l = std::make_shared<LightCall>();
    l->shader = call(name, std::move(params), 5);
    l->handle = name;
    l->area = area;
    l->index = static_cast<int>(scene.lights.size());
    attributes.lights.switchOn(l->index);
    scene.lights.push_back(l);
    return *l;
  }
  void primvar(const std::string& name, ValueType type) {
    primvars.push_back({name, Storage::Varying, type, floatsPerValue(type), {}});
  }

  /// Freezes the scene around the one object.
  ShadingSystem& system() {
    if (shading) return *shading;
    Object o;
    attributes.name = "thing";
    o.shapes = {std::make_shared<BlankPrim>(primvars)};
    o.worldFromObject = worldFromObject;
    o.attributes = std::make_shared<const Attributes>(attributes);
    o.where = at(9);
    scene.objects.push_back(o);
    scene.freeze();
    shading = std::make_unique<ShadingSystem>(scene, registry, &services, log, stats);
    return *shading;
  }

  /// Points that face the eye unless told otherwise; u, v, s, t run over them.
  ShadePoints points(const std::vector<vec3>& P, const vec3& N = vec3(0, 0, -1)) {
    int floats = 0;
    for (const Primvar& p : primvars) floats += p.width;
    ShadePoints out(0, floats);
    for (size_t k = 0; k < P.size(); ++k) {
      const int i = out.add(static_cast<uint32_t>(1000 + k));
      out.set3(kPx, i, P[k]);
      out.set3(kNx, i, N);
      out.set3(kNgx, i, N);
      out.set3(kIx, i, vec3(0, 0, 1));
      out.channel(kU)[i] = out.channel(kS)[i] = static_cast<float>(k) / static_cast<float>(P.size());
      out.channel(kV)[i] = out.channel(kT)[i] = 0.5f;
    }
    return out;
  }
  ShadedPoints shade(const ShadePoints& p, const ShadeContext& context = {}) {
    ShadedPoints out;
    system().shade(p, context, out);
    return out;
  }
  vec3 shadeOne(const ShadeContext& context = {}) { return shade(points({vec3(0, 0, 5)}), context).color(0); }

  Log log{Log::Verbosity::Quiet};
  Stats stats;
  ShaderRegistry registry;
  Scene scene;
  Attributes attributes;
  std::vector<Primvar> primvars;
  Motion worldFromObject;
  FakeServices services;
  std::unique_ptr<ShadingSystem> shading;
};

inline std::vector<vec3> emissionOf(const ShadingSystem& shading, const ShadePoints& points) {
  std::vector<vec3> out;
  shading.areaLightRadiance(points, out);
  return out;
}

inline void expectColor(const vec3& is, const vec3& should, float tolerance = 1e-5f) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(is[k], should[k], tolerance) << "channel " << k;
}

}  // namespace tomales
