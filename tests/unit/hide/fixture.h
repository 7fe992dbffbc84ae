// A scene whose camera space is raster space: orthographic, one unit a pixel, y down. Grids are built by
// hand.
#pragma once
#include <functional>

#include "reyes/hide.h"

namespace tomales::test {

/// Nothing asks it for geometry: the grids of these tests come ready made, and end where their vertices are.
class NoPrim : public Prim {
 public:
  explicit NoPrim(std::vector<Primvar> primvars = {}) : Prim(std::move(primvars)) {}
  bool isLone() const override { return true; }
  uint32_t patchCount() const override { return 1; }
  PatchInfo info(uint32_t) const override { return {}; }
  Bound3 bound(uint32_t, const UvRect&) const override { return {vec3(0), vec3(1)}; }
  void evaluate(uint32_t, int, const float*, const float*, SurfacePoints) const override {}
  void interpolate(uint32_t, int, int, const float*, const float*, float*, int) const override {}
};

inline Options rasterOptions(int resolution = 64) {
  Options o;
  o.xResolution = o.yResolution = resolution;
  const float size = static_cast<float>(resolution);
  o.screenWindow = {0, size, -size, 0};
  return o;
}

/// Raster (x, y) at depth z in the camera space of rasterOptions.
inline vec3 at(float x, float y, float z = 1) { return {x, -y, z}; }

struct World {
  Scene scene;

  explicit World(const Options& options = rasterOptions()) { scene.options = options; }
  /// Returns the object's index; call freeze() after the last.
  int add(const Attributes& attributes = {}, std::vector<Primvar> primvars = {}) {
    Object o;
    o.shapes = {std::make_shared<NoPrim>(std::move(primvars))};
    o.attributes = std::make_shared<Attributes>(attributes);
    scene.objects.push_back(std::move(o));
    return static_cast<int>(scene.objects.size()) - 1;
  }
  void freeze() { scene.freeze(); }
};

using Surface = std::function<vec3(float u, float v, int key)>;

/// Vertices P = surface(u, v, key) on a regular lattice of (u,v) in 0..1; normals towards the viewer.
inline std::shared_ptr<Grid> makeGrid(int object, uint32_t name, int nu, int nv, const Surface& surface, int keys = 1) {
  auto g = std::make_shared<Grid>();
  g->object = object;
  g->pieces[0].sampleKey = name;
  g->pieces[0].openEdges = kAllEdges;
  g->allocate(nu, nv, keys, 0);
  for (int k = 0; k < g->vertexCount(); ++k) {
    const float u = static_cast<float>(k % (nu + 1)) / static_cast<float>(nu);
    const float v = static_cast<float>(k / (nu + 1)) / static_cast<float>(nv);
    for (int key = 0; key < keys; ++key)
      for (int axis = 0; axis < 3; ++axis) g->P(key, axis)[k] = surface(u, v, key)[axis];
    g->N(2)[k] = -1;
    g->u()[k] = u;
    g->v()[k] = v;
  }
  return g;
}

/// The axis-aligned raster rectangle at depth z.
inline Surface rectangle(float x0, float y0, float x1, float y1, float z = 1) {
  return [=](float u, float v, int) { return at(x0 + (x1 - x0) * u, y0 + (y1 - y0) * v, z); };
}

}  // namespace tomales::test
