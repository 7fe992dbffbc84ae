// The reference path tracer against closed forms and integrals: what it brings beyond one diffuse bounce.
#include <gtest/gtest.h>

#include "fixture.h"
#include "reyes/base/rng.h"

namespace tomales::test {
namespace {

/// A floor at z = 5 that faces the eye, with a lamp before it; what arrives at points that look away from the eye and
/// see the floor alone.
struct OverFloor {
  explicit OverFloor(const ShaderCall& surface, bool areaLamp) {
    SceneBuilder b(32);
    if (areaLamp) {
      auto lamp = std::make_shared<LightCall>();
      lamp->shader = call("arealight");
      lamp->area = true;
      lamp->index = 0;
      b.scene.lights.push_back(lamp);
    } else {
      b.light("pointlight", {floatParam("intensity", 3), pointParam("from", kLamp)});
    }
    b.quad({-40, -40, 5}, {40, -40, 5}, {40, 40, 5}, {-40, 40, 5}, vec3(1));
    attributes(b, 0).surface = std::make_shared<ShaderCall>(surface);
    b.lights.clear();
    b.quad({0.5f, -0.5f, 3}, {1.5f, -0.5f, 3}, {1.5f, 0.5f, 3}, {0.5f, 0.5f, 3}, vec3(1));
    attributes(b, 1).areaLight = areaLamp ? 0 : -1;
    attributes(b, 1).visibility.diffuse = attributes(b, 1).visibility.specular = areaLamp;
    world = std::make_unique<World>(std::move(b.scene));
  }
  static Attributes& attributes(SceneBuilder& b, size_t object) {
    return const_cast<Attributes&>(*b.scene.objects[object].attributes);
  }

  /// E/pi at (0, 0, 4).
  float arrives(GiMode mode) const {
    const auto services = world->use({mode, 1 << 16});
    ShadePoints points(world->scene.objects[1].group, 0);
    points.add(11U);
    points.set3(kPx, 0, {0, 0, 4});
    points.set3(kIx, 0, {0, 0, -1});
    points.set3(kNx, 0, {0, 0, 1});
    points.set3(kNgx, 0, {0, 0, 1});
    std::vector<float> out(12 * kLanes);
    const auto vec = [&](size_t k) {
      return TmVec3{&out[3 * k * kLanes], &out[(3 * k + 1) * kLanes], &out[(3 * k + 2) * kLanes]};
    };
    const uint8_t active[kLanes] = {1};
    services->indirectDiffuse(points, active, points.vec(kNx), {}, {}, {vec(0), {vec(1), vec(2), vec(3)}});
    return out[0];
  }

  static constexpr vec3 kLamp{0.7f, 0.2f, 3};
  std::unique_ptr<World> world;
};

/// Sum of value(point) over the square of this half-width around (x, 0, z), each cell by its area.
template <class Value>
double overSquare(float x, float z, float half, int cells, const Value& value) {
  double sum = 0;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const vec2 at =
          (2.0f * vec2(static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f) / static_cast<float>(cells) - 1.0f) *
          half;
      sum += value(vec3(x + at.x, at.y, z)) * 4 * double{half} * double{half} / static_cast<double>(cells * cells);
    }
  return sum;
}

TEST(Reference, HighlightsOfWhatAPathMeetsCount) {
  const OverFloor floor(call("metal", {floatParam("roughness", 0.4f)}), false);
  const vec3 P(0, 0, 4);
  const double expected = overSquare(0, 5, 40, 2000, [&](const vec3& x) {
    const vec3 toward = P - x, lamp = OverFloor::kLamp - x;
    const vec3 V = glm::normalize(toward), L = glm::normalize(lamp), H = glm::normalize(V + L);
    const double highlight = std::pow(std::max(0.0, -double{H.z}), 8 / 0.4) * 3 / double{dot(lamp, lamp)};
    return highlight * double{V.z} * double{V.z} / (double{kPi} * double{dot(toward, toward)});
  });
  EXPECT_NEAR(floor.arrives(GiMode::Reference) / expected, 1, 0.005);
  EXPECT_NEAR(floor.arrives(GiMode::Gather) / expected, 1, 0.02) << "those of specular() count for gather rays, too";
}

TEST(Reference, AMirrorShowsTheLampAsItsImageBehindIt) {
  const OverFloor floor(call("mirror"), true);
  const vec3 P(0, 0, 4);
  const double expected = overSquare(1, 7, 0.5f, 400, [&](const vec3& x) {
    const vec3 path = x - P;
    const double cosine = double{path.z} / double{glm::length(path)};
    return cosine * cosine / (double{kPi} * double{dot(path, path)});
  });
  EXPECT_NEAR(floor.arrives(GiMode::Reference) / expected, 1, 0.01);
}

// Inner reflections weaker than a fifth pass too (shaders/glass.cpp); counted, they would leave 2 eta / (eta^2 + 1),
// 0.923.
TEST(Reference, AGlassSlabPassesWhatItsFirstSurfaceDoesNotMirror) {
  SceneBuilder b(32);
  b.quad({-9, -9, 4}, {9, -9, 4}, {9, 9, 4}, {-9, 9, 4}, vec3(1));
  b.quad({-9, -9, 5}, {-9, 9, 5}, {9, 9, 5}, {9, -9, 5}, vec3(1));
  b.quad({-9, -9, 6}, {9, -9, 6}, {9, 9, 6}, {-9, 9, 6}, vec3(1));
  for (size_t i = 0; i < 3; ++i) {
    Attributes& a = OverFloor::attributes(b, i);
    a.surface = std::make_shared<ShaderCall>(call(i < 2 ? "glass" : "constant"));
    a.trace.maxSpecularDepth = 20;
  }
  b.scene.options.maxRayDepth = 30;
  const World world(std::move(b.scene));
  const auto services = const_cast<World&>(world).use({GiMode::Reference, 16});
  ShadePoints points(world.scene.objects[0].group, 0);
  points.add(1U);
  const vec3 P(0.01f, 0.02f, 4);
  points.set3(kPx, 0, P);
  points.set3(kIx, 0, P);
  points.set3(kNx, 0, {0, 0, -1});
  points.set3(kNgx, 0, {0, 0, -1});
  ShadedPoints out;
  world.shading.shade(points, {}, out);
  EXPECT_NEAR(out.color(0).x, 0.96, 0.002);
}

}  // namespace
}  // namespace tomales::test
