// How finely patches are diced.
#include <bit>

#include "reyes/dice.h"
#include "tests/unit/split/test_scene.h"

namespace tomales {
namespace {
using namespace test;

TEST(Rate, ClosedShapesKeepAShapeHoweverSmall) {
  const Scene scene = sceneOf({sphere(1e-3f)}, translation({0, 0, 4}));
  Stats stats;
  const std::vector<SubPatch> pieces = split(scene, stats);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_GE(pieces[0].nu, 6);
  EXPECT_GE(pieces[0].nv, 4);
}

size_t micropolygons(const Scene& scene) {
  Stats stats;
  size_t n = 0;
  for (const SubPatch& p : split(scene, stats)) n += static_cast<size_t>(p.nu) * static_cast<size_t>(p.nv);
  return n;
}

Scene withFactors(Scene scene, float motion, float focus) {
  auto attributes = std::make_shared<Attributes>(*scene.objects[0].attributes);
  attributes->motionFactor = motion, attributes->focusFactor = focus;
  scene.objects[0].attributes = attributes;
  scene.freeze();
  return scene;
}

TEST(Rate, GeometricApproximationLeavesWhatIsStillAndSharpAlone) {
  const Scene scene = sceneOf({sphere()}, translation({0, 0, 4}));
  EXPECT_EQ(micropolygons(withFactors(scene, 0, 0)), micropolygons(withFactors(scene, 5, 5)));
}

TEST(Rate, FocusFactorDicesWhatIsBlurredCoarser) {
  Scene scene = sceneOf({sphere()}, translation({0, 0, 4}));
  // Circle of confusion at z = 4: 128 / (2 tan 30) * lens diameter * |1/12 - 1/4| = 18.5 d; 32 px.
  scene.options.fStop = 1, scene.options.focalDistance = 12, scene.options.focalLength = 32 / 18.475f;
  const double sharp = static_cast<double>(micropolygons(withFactors(scene, 0, 0)));
  // Edges of 8 px, the bounds of pieces letting some off.
  EXPECT_LT(static_cast<double>(micropolygons(withFactors(scene, 0, 1))), sharp / 25);
  EXPECT_GT(static_cast<double>(micropolygons(withFactors(scene, 0, 0.25f))), sharp / 10);
}

TEST(Rate, ASmallBallFarOutOfFocusKeepsAShape) {
  Scene scene = sceneOf({sphere(0.15f)}, translation({0, 0, 12}));
  scene.options.fStop = 0.1f, scene.options.focalDistance = 2, scene.options.focalLength = 0.2f;
  Stats stats;
  scene.freeze();
  for (const SubPatch& p : split(scene, stats)) {
    EXPECT_GE(p.nu, 3);
    EXPECT_GE(p.nv, 2);
  }
}

TEST(Rate, MotionFactorDicesWhatMovesFarCoarser) {
  Scene scene = sceneOf({sphere(0.3f)}, translation({0, 0, 4}));
  scene.options.shutterClose = 1;
  scene.objects[0].worldFromObject = {{0, 1}, {translation({-0.5f, 0, 4}), translation({0.5f, 0, 4})}};
  // 128 / (2 tan 30) / 4 = 27.7 px: areas of 6.9 px2 with factor 1.
  const double fine = static_cast<double>(micropolygons(withFactors(scene, 0, 1)));
  EXPECT_NEAR(fine / static_cast<double>(micropolygons(withFactors(scene, 1, 1))), 6.9, 1.5);
}

TEST(Rate, MicropolygonsAreNoLargerThanTheShadingRateAsks) {
  for (const float rate : {0.25f, 1.0f, 4.0f}) {
    const Scene scene = sceneOf({sphere()}, translation({0, 0, 4}), rate);
    const Camera camera(scene.options);
    Stats stats;
    for (const SubPatch& p : split(scene, stats)) {
      const Grid g = dice(scene, p.object, p.patch, p.rect, p.nu, p.nv, 1);
      for (int j = 0; j <= g.nv; ++j)
        for (int i = 0; i < g.nu; ++i) {
          const int k = j * (g.nu + 1) + i;
          EXPECT_LT(glm::length(camera.raster(g.position(0, k + 1)) - camera.raster(g.position(0, k))), 1.35f * std::sqrt(rate));
        }
    }
  }
}

Scene withDicing(Scene scene, bool binary, bool rasterOrient) {
  auto attributes = std::make_shared<Attributes>(*scene.objects[0].attributes);
  attributes->binaryDice = binary, attributes->rasterOrient = rasterOrient;
  scene.objects[0].attributes = std::move(attributes);
  return scene;
}

TEST(Rate, BinaryDicingMakesPowersOfTwo) {
  Stats stats;
  for (const SubPatch& p : split(withDicing(sceneOf({sphere()}, translation({0, 0, 4})), true, true), stats)) {
    EXPECT_TRUE(std::has_single_bit(static_cast<unsigned>(p.nu)) && std::has_single_bit(static_cast<unsigned>(p.nv)));
    EXPECT_LE(p.nu * p.nv, 256);
  }
}

TEST(Rate, WithoutRasterOrientAForeshortenedPatchIsDicedAsIfItFacedTheEye) {
  Stats stats;
  const auto cells = [&](bool rasterOrient) {
    int64_t n = 0;
    for (const SubPatch& p : split(withDicing(sceneOf({quad(1, -0.2f)}, translation({0, 0, 8})), false, rasterOrient), stats))
      n += int64_t{p.nu} * p.nv;
    return n;
  };
  EXPECT_GT(cells(false), 4 * cells(true));
}

}  // namespace
}  // namespace tomales
