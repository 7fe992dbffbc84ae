// A scene of hand-placed primitives for tests of splitting and dicing.
#pragma once
#include <gtest/gtest.h>

#include <numeric>

#include "reyes/prim_factories.h"
#include "reyes/split.h"

namespace tomales::test {

inline Scene sceneOf(std::vector<PrimPtr> prims, const mat4& cameraFromObject, float shadingRate = 1,
                     int resolution = 128) {
  Scene scene;
  scene.options.xResolution = scene.options.yResolution = resolution;
  scene.options.projection = ProjectionKind::Perspective;
  scene.options.fov_degrees = 60;
  scene.options.nearClip = 0.01f;
  auto attributes = std::make_shared<Attributes>();
  attributes->shadingRate = shadingRate;
  for (PrimPtr& p : prims) {
    Object o;
    o.shapes = {std::move(p)};
    o.worldFromObject = Motion::still(cameraFromObject);
    o.attributes = attributes;
    scene.objects.push_back(std::move(o));
  }
  scene.freeze();
  return scene;
}

inline PrimPtr sphere(float radius = 1) {
  Problems problems;
  return makeSphere(radius, -radius, radius, 360, {}, problems);
}

inline mat4 translation(const vec3& t) {
  mat4 m(1.0f);
  m[3] = vec4(t, 1);
  return m;
}

inline PrimPtr quad(float size, float y) {
  Problems problems;
  Param P;
  P.name = "P";
  P.type = ValueType::Point;
  P.storage = Storage::Vertex;
  P.floats = {-size, y, -size, size, y, -size, -size, y, size, size, y, size};
  return makeBilinearPatchMesh(2, false, 2, false, {P}, problems);
}

/// Splits all objects, in view of the whole frame.
inline std::vector<SubPatch> split(const Scene& scene, Stats& stats, Log& log) {
  const Camera camera(scene.options);
  std::vector<SubPatch> all;
  for (int o = 0; o < static_cast<int>(scene.objects.size()); ++o) {
    std::vector<uint32_t> patches(scene.objects[static_cast<size_t>(o)].shape().patchCount());
    std::iota(patches.begin(), patches.end(), 0U);
    const auto pieces = splitPatches({scene, camera, camera.crop(), stats, log}, o, patches);
    all.insert(all.end(), pieces.begin(), pieces.end());
  }
  return all;
}
inline std::vector<SubPatch> split(const Scene& scene, Stats& stats) {
  Log log(Log::Verbosity::Quiet);
  return split(scene, stats, log);
}

}  // namespace tomales::test
