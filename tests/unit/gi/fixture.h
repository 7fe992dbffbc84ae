// Small scenes in camera space, with everything that GiServices stands on.
#pragma once
#include "gi/frame/state.h"
#include "gi/photons.h"
#include "gi/services.h"
#include "reyes/dice.h"
#include "reyes/prim_factories.h"
#include "reyes/shader_registry.h"

namespace tomales::test {

inline Param floatParam(const std::string& name, float value) {
  return {name, Storage::Uniform, ValueType::Float, 1, {value}, {}, {}};
}
inline Param pointParam(const std::string& name, const vec3& p) {
  return {name, Storage::Uniform, ValueType::Point, 1, {p.x, p.y, p.z}, {}, {}};
}

inline ShaderCall call(const std::string& name, ParamList params = {}) {
  return {name, std::move(params), Motion{}, SourceLoc{}};
}

class SceneBuilder {
 public:
  explicit SceneBuilder(int resolution = 64) {
    Options& o = scene.options;
    o.xResolution = o.yResolution = resolution;
    o.projection = ProjectionKind::Perspective;
    o.fov_degrees = 50;
    o.nearClip = 0.01f;
  }
  void light(const std::string& shader, ParamList params) {
    auto l = std::make_shared<LightCall>();
    l->shader = call(shader, std::move(params));
    l->index = static_cast<int>(scene.lights.size());
    l->castsShadows = shader == "pointlight" && shadows;
    lights.switchOn(l->index);
    scene.lights.push_back(std::move(l));
  }
  void add(PrimPtr prim, const vec3& color, const vec3& center = vec3(0)) {
    auto attributes = std::make_shared<Attributes>();
    attributes->color = color;
    attributes->lights = lights;
    attributes->surface = std::make_shared<ShaderCall>(call("matte"));
    Object o;
    o.shapes = {std::move(prim)};
    mat4 m(1.0f);
    m[3] = vec4(center, 1);
    o.worldFromObject = Motion::still(m);
    o.attributes = attributes;
    scene.objects.push_back(std::move(o));
  }
  void sphere(float radius, const vec3& color, const vec3& center) {
    Problems problems;
    add(makeSphere(radius, -radius, radius, 360, {}, problems), color, center);
  }
  void quad(const vec3& a, const vec3& b, const vec3& c, const vec3& d, const vec3& color) {
    Problems problems;
    Param P{"P", Storage::Vertex, ValueType::Point, 1, {}, {}, {}};
    for (const vec3& p : {a, b, c, d}) P.floats.insert(P.floats.end(), {p.x, p.y, p.z});
    add(makePolygons({4}, {0, 1, 2, 3}, {P}, problems), color);
  }

  Scene scene;
  LightList lights;
  bool shadows = false;
};

/// A room with a red and a green wall, open towards the eye, with a ball in it.
inline SceneBuilder cornell(ParamList indirect = {}, int resolution = 64) {
  SceneBuilder b(resolution);
  b.shadows = true;
  b.light("pointlight", {floatParam("intensity", 1), pointParam("from", {0.1f, 0.7f, 3.0f})});
  b.light("indirectlight", std::move(indirect));
  const float n = 2.2f, f = 4.2f;
  const vec3 white(0.7f);
  b.quad({-1, -1, n}, {1, -1, n}, {1, -1, f}, {-1, -1, f}, white);
  b.quad({-1, 1, n}, {-1, 1, f}, {1, 1, f}, {1, 1, n}, white);
  b.quad({-1, -1, f}, {1, -1, f}, {1, 1, f}, {-1, 1, f}, white);
  b.quad({-1, -1, n}, {-1, -1, f}, {-1, 1, f}, {-1, 1, n}, {0.7f, 0.1f, 0.1f});
  b.quad({1, -1, n}, {1, 1, n}, {1, 1, f}, {1, -1, f}, {0.1f, 0.6f, 0.1f});
  b.sphere(0.4f, white, {-0.3f, -0.6f, 3.3f});
  return b;
}

/// Shading and rays over a scene; services are switched in by `use`.
struct World {
  /// `plugins`: beside the built-in shaders.
  explicit World(Scene s, const TmShaderLibrary* plugins = nullptr)
      : scene(frozen(std::move(s))),
        camera(scene.options),
        registry(log),
        shading(bind(scene, registry, plugins, log, stats)),
        rays(scene, camera, shading, {}, stats, log) {}

  std::unique_ptr<GiServices> use(const GiSettings& settings) {
    auto services = std::make_unique<GiServices>(scene, camera, rays, shading, settings, stats);
    shading.setServices(services.get());
    return services;
  }

  RayTools tools() const { return {&rays, &shading}; }

  static Scene frozen(Scene s) {
    s.freeze();
    return s;
  }
  static ShadingSystem bind(const Scene& scene, ShaderRegistry& registry, const TmShaderLibrary* plugins, Log& log,
                            Stats& stats) {
    registry.addLibrary(tomales_builtin_shaders(), "built-in");
    if (plugins) registry.addLibrary(plugins, "test");
    return ShadingSystem(scene, registry, nullptr, log, stats);
  }

  Scene scene;
  Camera camera;
  Log log{Log::Verbosity::Quiet};
  Stats stats;
  ShaderRegistry registry;
  ShadingSystem shading;
  RayScene rays;
};

inline std::vector<StoredPhoton> traced(World& world, const PhotonSettings& settings) {
  const auto services = world.use({.mode = GiMode::None});
  std::vector<StoredPhoton> out;
  const auto store = [&](std::span<const StoredPhoton> photons) {
    out.insert(out.end(), photons.begin(), photons.end());
  };
  tracePhotons(world.scene, world.rays, world.shading, settings, store, {}, world.stats, world.log);
  return out;
}

/// Returns the power of all photons, in green.
inline double powerOf(const std::vector<StoredPhoton>& photons) {
  double sum = 0;
  for (const StoredPhoton& p : photons) sum += double{p.power.y};
  return sum;
}

/// Makes by rays what a hider would make of the frame with one sample a pixel. Each pixel has a facet of its own.
inline DeepFrame frameOf(const World& world, int bucket) {
  DeepFrame frame;
  frame.crop = frame.padded = {0, 0, world.camera.xResolution(), world.camera.yResolution()};
  frame.bucketWidth = frame.bucketHeight = bucket;
  frame.columns = (frame.crop.width() + bucket - 1) / bucket;
  frame.rows = (frame.crop.height() + bucket - 1) / bucket;
  for (int t = 0; t < frame.columns * frame.rows; ++t) {
    DeepTile tile;
    const int x0 = t % frame.columns * bucket, y0 = t / frame.columns * bucket;
    tile.rect = {x0, y0, std::min(x0 + bucket, frame.crop.x1), std::min(y0 + bucket, frame.crop.y1)};
    std::vector<int> batchOfGroup(world.scene.groups.size(), -1);
    for (int y = tile.rect.y0; y < tile.rect.y1; ++y)
      for (int x = tile.rect.x0; x < tile.rect.x1; ++x) {
        Ray ray;
        world.camera.ray({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}, ray.origin, ray.direction);
        const Hit hit = world.rays.closest(ray, kMaskSpecular);
        tile.pixels.push_back({static_cast<uint32_t>(tile.fragments.size()), hit.object < 0 ? 0U : 1U});
        if (hit.object < 0) continue;
        const int group = world.scene.objects[static_cast<size_t>(hit.object)].group;
        int& b = batchOfGroup[static_cast<size_t>(group)];
        int floats = 0;
        for (const Primvar& p : world.scene.groups[static_cast<size_t>(group)].primvars) floats += p.width;
        if (b < 0) {
          b = static_cast<int>(tile.batches.size());
          tile.batches.emplace_back(group, floats);
        }
        ShadePoints& batch = tile.batches[static_cast<size_t>(b)];
        const int i = batch.add(static_cast<uint32_t>(y * 10000 + x));
        if (floats > 0) evaluatePoint(world.scene, hit.object, hit.patch, hit.u, hit.v, batch, i);
        const vec3 P = ray.origin + hit.t * ray.direction;
        batch.set3(kPx, i, P);
        batch.set3(kIx, i, P);
        batch.set3(kNx, i, hit.normal);
        batch.set3(kNgx, i, hit.geometricNormal);
        tile.fragments.push_back({static_cast<uint32_t>(tile.facets.size()), P.z, 1});
        tile.facets.push_back({b, {i, i, i, i}});
      }
    frame.tiles.push_back(std::move(tile));
  }
  return frame;
}

inline void gatherFrame(GiServices& services, const DeepFrame& frame) {
  services.gatherPass(frame, readerOf(frame), {}, {});
}

/// indirectDiffuse() at every point of a batch, on the side of the eye.
inline std::vector<vec3> indirectAt(const GiServices& services, const ShadePoints& points, const IndirectQuery& query,
                                    const ShadeContext& context = {}) {
  const size_t n = static_cast<size_t>(points.count());
  std::vector<uint8_t> active(n, 1);
  AlignedVector<float> N[3], E[3];
  for (int c = 0; c < 3; ++c) {
    N[c].resize(n);
    E[c].resize(n);
  }
  for (int i = 0; i < points.count(); ++i)
    for (int c = 0; c < 3; ++c) N[c][static_cast<size_t>(i)] = points.facingNormal(i)[c];
  services.indirectDiffuse(points, active.data(), {N[0].data(), N[1].data(), N[2].data()}, query, context,
                           {{E[0].data(), E[1].data(), E[2].data()}, {}});
  std::vector<vec3> out(n);
  for (size_t i = 0; i < n; ++i) out[i] = {E[0][i], E[1][i], E[2][i]};
  return out;
}

/// Returns the indirect light at all points of a frame, by batch.
inline std::vector<vec3> indirectOf(const GiServices& services, const World& world, const DeepFrame& frame) {
  std::vector<vec3> out(static_cast<size_t>(frame.crop.width() * frame.crop.height()));
  for (const DeepTile& tile : frame.tiles)
    for (const ShadePoints& batch : tile.batches) {
      const std::vector<vec3> E = indirectAt(services, batch, *world.shading.group(batch.group()).indirectQuery());
      for (int i = 0; i < batch.count(); ++i)
        out[static_cast<size_t>(batch.key(i) / 10000 * static_cast<uint32_t>(frame.crop.width()) +
                                batch.key(i) % 10000)] = E[static_cast<size_t>(i)];
    }
  return out;
}

}  // namespace tomales::test
