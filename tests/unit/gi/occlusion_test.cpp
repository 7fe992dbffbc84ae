// Ambient occlusion against closed forms (form factors of a point to a sphere and to a wall), through shader, service
// and rays.
#include <gtest/gtest.h>

#include <map>

#include "fixture.h"
#include "reyes/base/parallel.h"

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
    points.set3(kPx, 0, P);
    points.set3(kIx, 0, {0, 1, 0});
    points.set3(kNx, 0, {0, -1, 0});
    points.set3(kNgx, 0, {0, -1, 0});
    ShadedPoints out;
    world->shading.shade(points, {}, out);
    return out.color(0).x;
  }
  size_t object = 0;
  std::unique_ptr<World> world;
  std::unique_ptr<GiServices> services;
};

SceneBuilder underSky() {
  SceneBuilder b(1024);  // coarse polygons are 16 pixels long
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

/// A ball on a floor, before the eye, both under the sky.
SceneBuilder ballOnFloor(ParamList asked) {
  SceneBuilder b(96);
  b.light("occlusionlight", std::move(asked));
  b.quad({-900, -1, -900}, {900, -1, -900}, {900, -1, 900}, {-900, -1, 900}, vec3(1));
  b.sphere(0.5f, vec3(1), {0, -0.5f, 3});
  for (Object& o : b.scene.objects) {
    auto lit = std::make_shared<Attributes>(*o.attributes);
    lit->surface = std::make_shared<ShaderCall>(call("matte", {floatParam("Kd", 0)}));
    o.attributes = lit;
  }
  return b;
}

struct Error {
  float mean = 0, most = 0;
  int points = 0;
};

/// The error of shading with the services of `world` against the form factor of the ball, over the part of the floor
/// that the eye sees up to z = 6.
Error errorOnFloor(const World& world, const DeepFrame& frame) {
  Error error;
  for (const DeepTile& tile : frame.tiles)
    for (const ShadePoints& batch : tile.batches) {
      ShadedPoints out;
      world.shading.shade(batch, {}, out);
      for (int i = 0; i < batch.count(); ++i) {
        const vec3 P = batch.position(i);
        if (P.y > -0.999f || P.z > 6) continue;
        const float x2 = P.x * P.x + (P.z - 3) * (P.z - 3), clear = 1 - 0.125f * std::pow(0.25f + x2, -1.5f);
        const float off = std::abs(out.color(i).x - clear);
        error.mean += off;
        error.most = std::max(error.most, off);
        ++error.points;
      }
    }
  error.mean /= static_cast<float>(error.points);
  return error;
}

TEST(Occlusion, IsInterpolatedWithinItsVariationFromFewRecords) {
  for (const GiMode mode : {GiMode::None, GiMode::Gather}) {
    World world(ballOnFloor({floatParam("samples", 1024), floatParam("maxvariation", 0.02f)}).scene);
    const DeepFrame frame = frameOf(world, 16);
    const auto services = world.use({mode});
    gatherFrame(*services, frame);
    const int64_t records = world.stats.irradianceCache.samples, rays = world.stats.rays.gather;
    EXPECT_GT(records, 50);
    EXPECT_LT(records, 2500);
    const Error error = errorOnFloor(world, frame);
    EXPECT_GT(error.points, 2000);
    EXPECT_LE(world.stats.rays.gather, rays + 5 * 1100) << "all but a few from records";
    const auto traced = world.use({.mode = mode, .maxError = 0});
    const Error noise = errorOnFloor(world, frame);
    EXPECT_LT(error.mean, noise.mean + 0.006f) << "of the ball's coarse polygons, and of rays";
    EXPECT_LT(error.most, noise.most + 0.08f);
  }
}

TEST(Occlusion, IsTracedAtEveryPointWhereNobodyAllowsAVariation) {
  World world(ballOnFloor({floatParam("samples", 16)}).scene);
  const DeepFrame frame = frameOf(world, 16);
  const auto services = world.use({});
  gatherFrame(*services, frame);
  EXPECT_FALSE(world.shading.group(0).asksHemispheres()) << "so that no frame waits for it";
  EXPECT_EQ(world.stats.irradianceCache.samples, 0);
  const Error error = errorOnFloor(world, frame);
  EXPECT_GE(world.stats.rays.gather, 16 * error.points);
}

TEST(Occlusion, TakesItsVariationFromTheAttributeOfIrradiance) {
  SceneBuilder b = ballOnFloor({floatParam("samples", 64)});
  for (Object& o : b.scene.objects) {
    auto attributes = std::make_shared<Attributes>(*o.attributes);
    attributes->irradianceMaxError = 0.5f;
    o.attributes = attributes;
  }
  World world(std::move(b.scene));
  const DeepFrame frame = frameOf(world, 16);
  const auto services = world.use({});
  gatherFrame(*services, frame);
  EXPECT_TRUE(world.shading.group(0).asksHemispheres());
  EXPECT_GT(world.stats.irradianceCache.samples, 50);
}

TEST(Occlusion, OfRecordsDoesNotDependOnThreadsOrBuckets) {
  World world(ballOnFloor({floatParam("samples", 64), floatParam("maxvariation", 0.05f)}).scene);
  std::vector<vec3> first;
  for (const int threads : {1, 4})
    for (const int bucket : {16, 13}) {
      const ThreadLimit limit(threads);
      const DeepFrame frame = frameOf(world, bucket);
      const auto services = world.use({});
      gatherFrame(*services, frame);
      std::map<uint32_t, vec3> colors;
      for (const DeepTile& tile : frame.tiles)
        for (const ShadePoints& batch : tile.batches) {
          ShadedPoints out;
          world.shading.shade(batch, {}, out);
          for (int i = 0; i < batch.count(); ++i) colors[batch.key(i)] = out.color(i);
        }
      std::vector<vec3> all;
      for (const auto& [key, color] : colors) all.push_back(color);
      if (first.empty()) first = all;
      EXPECT_EQ(all, first) << threads << " threads, buckets of " << bucket;
    }
}

}  // namespace
}  // namespace tomales::test
