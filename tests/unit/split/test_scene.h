// A scene of hand-placed primitives for tests of splitting and dicing.
#pragma once
#include "reyes/scene.h"

namespace tomales::test {

inline Scene sceneOf(std::vector<PrimPtr> prims, const mat4& cameraFromObject, float shadingRate = 1, int resolution = 128) {
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

}  // namespace tomales::test
