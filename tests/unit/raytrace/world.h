// A small world for ray tests: objects in camera space, real shaders, and the rays' view of them.
#pragma once
#include "raytrace/trace.h"
#include "reyes/prim_factories.h"
#include "reyes/shader_registry.h"

extern const TmShaderLibrary* tomales_builtin_shaders(void);

namespace tomales::test {

inline mat4 translation(const vec3& t) {
  mat4 m(1.0f);
  m[3] = vec4(t, 1);
  return m;
}

inline Param floatsParam(std::string name, ValueType type, Storage storage, std::vector<float> values) {
  Param p;
  p.name = std::move(name);
  p.type = type;
  p.storage = storage;
  p.floats = std::move(values);
  return p;
}

inline PrimPtr sphere(float radius = 1) {
  Problems problems;
  return makeSphere(radius, -radius, radius, 360, {}, problems);
}

/// Corner, and the edges along u and v: the normal is along cross(u, v).
inline PrimPtr parallelogram(const vec3& o, const vec3& u, const vec3& v) {
  const vec3 p[4] = {o, o + u, o + v, o + u + v};
  std::vector<float> values;
  for (const vec3& q : p) values.insert(values.end(), {q.x, q.y, q.z});
  Problems problems;
  return makeBilinearPatchMesh(2, false, 2, false, {floatsParam("P", ValueType::Point, Storage::Vertex, values)},
                               problems);
}

/// A wavy sheet over -1..1 in x and y, of as many patches as instances share.
inline PrimPtr waves() {
  std::vector<float> values;
  for (int j = 0; j <= 8; ++j)
    for (int i = 0; i <= 8; ++i) {
      const float x = static_cast<float>(i) / 4 - 1, y = static_cast<float>(j) / 4 - 1;
      values.insert(values.end(), {x, y, 0.2f * std::sin(4 * x) * std::cos(3 * y)});
    }
  Problems problems;
  return makeBilinearPatchMesh(9, false, 9, false, {floatsParam("P", ValueType::Point, Storage::Vertex, values)},
                               problems);
}

inline std::shared_ptr<const ShaderCall> shader(const std::string& name, ParamList params = {}) {
  return std::make_shared<ShaderCall>(ShaderCall{name, std::move(params), Motion{}, {}});
}

struct World {
  World() : registry(log) {
    scene.options.xResolution = scene.options.yResolution = 256;
    scene.options.projection = ProjectionKind::Perspective;
    scene.options.fov_degrees = 60;
    scene.options.nearClip = 0.01f;
    registry.addLibrary(tomales_builtin_shaders(), "built-in");
    attributes.surface = shader("constant");
  }

  /// Adds an object with the current `attributes`.
  int add(PrimPtr prim, const mat4& cameraFromObject = mat4(1.0f)) {
    Object o;
    o.shapes = {std::move(prim)};
    o.worldFromObject = Motion::still(cameraFromObject);
    o.attributes = std::make_shared<Attributes>(attributes);
    scene.objects.push_back(std::move(o));
    return static_cast<int>(scene.objects.size()) - 1;
  }

  /// Six walls of the box lo..hi, normals inwards.
  void addRoom(const vec3& lo, const vec3& hi) {
    const vec3 s = hi - lo, x(s.x, 0, 0), y(0, s.y, 0), z(0, 0, s.z);
    add(parallelogram(lo, x, y));
    add(parallelogram(lo + z, y, x));
    add(parallelogram(lo, y, z));
    add(parallelogram(lo + x, z, y));
    add(parallelogram(lo, z, x));
    add(parallelogram(lo + y, x, z));
  }

  int addAreaLight() {
    auto light = std::make_shared<LightCall>();
    light->shader.name = "arealight";
    light->area = true;
    light->index = static_cast<int>(scene.lights.size());
    scene.lights.push_back(std::move(light));
    return scene.lights.back()->index;
  }

  void build(const RaySettings& settings = {}) {
    scene.freeze();
    camera = std::make_unique<Camera>(scene.options);
    shading = std::make_unique<ShadingSystem>(scene, registry, nullptr, log, stats);
    rays = std::make_unique<RayScene>(scene, *camera, *shading, settings, stats, log);
  }

  Ray rayFrom(int object, const vec3& origin, const vec3& direction, float tMax = kInfinity) const {
    Ray ray{origin, glm::normalize(direction), tMax};
    rays->prepareOrigin(scene.objects[static_cast<size_t>(object)].group, origin, 0, ray);
    return ray;
  }

  vec3 transmission(const Ray& ray) const {
    int64_t adjusted = 0;
    return rays->transmission({ray}, {SampleName{}}, *shading, ShadeContext{}, adjusted)[0];
  }

  Log log{Log::Verbosity::Quiet};
  Stats stats;
  Scene scene;
  Attributes attributes;
  ShaderRegistry registry;
  std::unique_ptr<Camera> camera;
  std::unique_ptr<ShadingSystem> shading;
  std::unique_ptr<RayScene> rays;
};

}  // namespace tomales::test
