// Ambient occlusion against closed forms (form factors of a point to a sphere and to a wall), through shader, service and rays.
#include <gtest/gtest.h>

#include "fixture.h"

namespace tomales::test {
namespace {

/// Share of the sky above points of the floor y = 0 (up is -y, as the camera stands) that is not covered.
struct Floor {
  explicit Floor(SceneBuilder b) {
    b.quad({-900, 0, -900}, {900, 0, -900}, {900, 0, 900}, {-900, 0, 900}, vec3(1));
    auto lit = std::make_shared<Attributes>(*b.scene.objects.back().attributes);
    lit->surface = std::make_shared<ShaderCall>(call("matte", {floatParam("Kd", 0)}));
    lit->lights = {0};
    b.scene.objects.back().attributes = lit;
    object = b.scene.objects.size() - 1;
    world = std::make_unique<World>(std::move(b.scene));
    services = world->use({GiMode::None});
  }
  float clear(const vec3& P) const {
    ShadePoints points(world->scene.objects[object].group, 0);
    points.add(11U);
    points.set3(kPx, 0, P), points.set3(kIx, 0, {0, 1, 0}), points.set3(kNx, 0, {0, -1, 0}), points.set3(kNgx, 0, {0, -1, 0});
    ShadedPoints out;
    world->shading.shade(points, {}, out);
    return out.color(0).x;
  }
  size_t object = 0;
  std::unique_ptr<World> world;
  std::unique_ptr<GiServices> services;
};

SceneBuilder underSky() {
  SceneBuilder b(1024);  // coarse polygons are 8 pixels long
  b.light("occlusionlight", {floatParam("samples", 16384)});
  return b;
}

TEST(Occlusion, OfASphereOnAPlaneIsItsFormFactor) {
  SceneBuilder b = underSky();
  b.sphere(1, vec3(1), {0, -1, 5});
  const Floor floor(std::move(b));
  for (const float x : {0.5f, 1.0f, 2.0f, 4.0f}) {
    const float clear = 1 - std::pow(1 + x * x, -1.5f);  // r^3 / (r^2 + x^2)^(3/2) of the light is covered
    EXPECT_NEAR(floor.clear({x, 0, 5}) / clear, 1, 0.005f) << x;
  }
}

TEST(Occlusion, InACornerIsTheFormFactorOfTheWall) {
  SceneBuilder b = underSky();
  const float h = 2, far = 3000;
  b.quad({0, 0, -far}, {0, -h, -far}, {0, -h, far}, {0, 0, far}, vec3(1));
  const Floor floor(std::move(b));
  for (const float x : {0.01f, 0.2f, 1.0f, 5.0f}) {
    const float clear = 1 - 0.5f * (1 - x / std::sqrt(x * x + h * h));
    EXPECT_NEAR(floor.clear({x, 0, 5}) / clear, 1, 0.005f) << x;
  }
}

}  // namespace
}  // namespace tomales::test
