// What gather rays and paths see in mirrors, behind glass and through what is transparent. In a closed room whose walls
// all shine alike, E/pi is their radiance, whatever else stands in it and loses nothing (a furnace).
#include <gtest/gtest.h>

#include "fixture.h"

namespace tomales::test {
namespace {

struct Furnace {
  explicit Furnace(const std::string& ballShader, const vec3& opacity = vec3(1), const vec3& color = vec3(1)) {
    SceneBuilder b;
    const vec3 lo(-1, -1, 2), hi(1, 1, 4), s = hi - lo;
    const auto wall = [&](const vec3& o, const vec3& u, const vec3& v) { b.quad(o, o + u, o + u + v, o + v, vec3(1)); };
    const vec3 x(s.x, 0, 0), y(0, s.y, 0), z(0, 0, s.z);
    wall(lo, x, y);
    wall(lo + z, y, x);
    wall(lo, y, z);
    wall(lo + x, z, y);
    wall(lo, z, x);
    wall(lo + y, x, z);
    for (auto& o : b.scene.objects) attributes(o).surface = std::make_shared<ShaderCall>(call("constant"));
    b.sphere(0.6f, color, {0, 0, 3});
    Attributes& ball = attributes(b.scene.objects.back());
    ball.surface = std::make_shared<ShaderCall>(call(ballShader));
    ball.opacity = opacity;
    ball.trace.maxSpecularDepth = 12;
    b.scene.options.maxRayDepth = 16;
    world = std::make_unique<World>(std::move(b.scene));
  }
  static Attributes& attributes(Object& o) { return const_cast<Attributes&>(*o.attributes); }

  /// E/pi on the floor below the ball.
  float floor(GiMode mode) const {
    const auto services = world->use({mode, 4096});
    ShadePoints points(world->scene.objects[0].group, 0);
    points.add(7U);
    points.set3(kPx, 0, {0.1f, 0.999f, 3.05f});
    points.set3(kIx, 0, {0, 1, 0});
    points.set3(kNx, 0, {0, -1, 0});
    points.set3(kNgx, 0, {0, -1, 0});
    std::vector<float> out(12 * kLanes);
    const auto vec = [&](size_t k) {
      return TmVec3{&out[3 * k * kLanes], &out[(3 * k + 1) * kLanes], &out[(3 * k + 2) * kLanes]};
    };
    const uint8_t active[kLanes] = {1};
    services->indirectDiffuse(points, active, points.vec(kNx), {}, {}, {vec(0), {vec(1), vec(2), vec(3)}});
    return out[0];
  }
  std::unique_ptr<World> world;
};

class BothModes : public ::testing::TestWithParam<GiMode> {};

TEST_P(BothModes, AMirrorBallTakesNoLight) { EXPECT_NEAR(Furnace("mirror").floor(GetParam()), 1, 0.005f); }

TEST_P(BothModes, AGlassBallTakesNoLight) { EXPECT_NEAR(Furnace("glass").floor(GetParam()), 1, 0.01f); }

TEST_P(BothModes, BehindAVeilStandsTheRoom) {
  EXPECT_NEAR(Furnace("constant", vec3(0.3f)).floor(GetParam()), 1, 0.005f);
}

TEST_P(BothModes, ABlackVeilTakesItsOpacityTwice) {
  const float open = Furnace("constant", vec3(0), vec3(0)).floor(GetParam()),
              black = Furnace("constant", vec3(1), vec3(0)).floor(GetParam());
  const float veiled = Furnace("constant", vec3(0.4f), vec3(0)).floor(GetParam());
  EXPECT_NEAR(open, 1, 0.005f);
  EXPECT_NEAR((veiled - black) / (open - black), 0.36f, 0.01f);
}

INSTANTIATE_TEST_SUITE_P(Gather, BothModes, ::testing::Values(GiMode::Gather, GiMode::Reference));

}  // namespace
}  // namespace tomales::test
