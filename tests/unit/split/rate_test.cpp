// How finely patches are diced.
#include <bit>

#include "reyes/base/rng.h"
#include "reyes/dice.h"
#include "reyes/split/rate.h"
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
  attributes->motionFactor = motion;
  attributes->focusFactor = focus;
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
  scene.options.fStop = 1;
  scene.options.focalDistance = 12;
  scene.options.focalLength = 32 / 18.475f;
  const double sharp = static_cast<double>(micropolygons(withFactors(scene, 0, 0)));
  // Edges of 8 px, the bounds of pieces and what keeps it round letting some off.
  EXPECT_LT(static_cast<double>(micropolygons(withFactors(scene, 0, 1))), sharp / 20);
  EXPECT_GT(static_cast<double>(micropolygons(withFactors(scene, 0, 0.25f))), sharp / 10);
}

TEST(Rate, ASmallBallFarOutOfFocusKeepsAShape) {
  Scene scene = sceneOf({sphere(0.15f)}, translation({0, 0, 12}));
  scene.options.fStop = 0.1f;
  scene.options.focalDistance = 2;
  scene.options.focalLength = 0.2f;
  Stats stats;
  scene.freeze();
  for (const SubPatch& p : split(scene, stats)) {
    EXPECT_GE(p.nu, 3);
    EXPECT_GE(p.nv, 2);
  }
}

TEST(Rate, MotionFactorDicesWhatMovesFarCoarser) {
  Scene scene = sceneOf({sphere(1)}, translation({0, 0, 4}));
  scene.options.shutterClose = 1;
  scene.objects[0].worldFromObject = {{0, 1}, {translation({-0.5f, 0, 4}), translation({0.5f, 0, 4})}};
  // 128 / (2 tan 30) / 4 = 27.7 px, and 30 px where it is nearest: areas of 6.9 to 7.5 px2 with factor 1. Whole numbers
  // of cells are up to a tenth off either way: a ratio of 5.6 to 9.2, and the few cells of the coarse ball are a little
  // fewer yet.
  const double fine = static_cast<double>(micropolygons(withFactors(scene, 0, 1)));
  EXPECT_NEAR(fine / static_cast<double>(micropolygons(withFactors(scene, 1, 1))), 7.2, 2);
}

mat4 placed(float z, float size) { return translation({0, 0, z}) * mat4(mat3(size)); }

/// A ball that has these places, evenly over the shutter.
Scene moving(const std::vector<mat4>& places) {
  Scene scene = sceneOf({sphere()}, places[0]);
  scene.options.shutterClose = 1;
  Motion& motion = scene.objects[0].worldFromObject;
  motion = {{}, places};
  for (size_t k = 0; k < places.size(); ++k)
    motion.times.push_back(static_cast<float>(k) / static_cast<float>(places.size() - 1));
  scene.freeze();
  return scene;
}

TEST(Rate, WhatGrowsOverTheShutterIsDicedForItsLargestSize) {
  const size_t still = micropolygons(sceneOf({sphere()}, placed(4, 1)));
  EXPECT_EQ(micropolygons(moving({placed(4, 0.05f), placed(4, 1)})), still);
  EXPECT_EQ(micropolygons(moving({placed(4, 1), placed(4, 0.05f)})), still);
  EXPECT_EQ(micropolygons(moving({placed(80, 1), placed(4, 1)})), still);
  EXPECT_EQ(micropolygons(moving({placed(4, 0.05f), placed(4, 1), placed(4, 0.05f)})), still);

  Scene deforming = sceneOf({sphere(0.05f)}, placed(4, 1));
  deforming.options.shutterClose = 1;
  Object& o = deforming.objects[0];
  o.shapes.push_back(sphere());
  o.shapeTimes = {0, 1};
  deforming.freeze();
  EXPECT_EQ(micropolygons(deforming), still);
  deforming.options.shutterClose = 0.5f;  // as large as 0.525
  deforming.freeze();
  EXPECT_EQ(micropolygons(deforming), micropolygons(sceneOf({sphere(0.525f)}, placed(4, 1))));
}

TEST(Rate, WhatLeavesThePictureOrPassesTheEyeIsDicedForWhereItIsSeen) {
  const size_t still = micropolygons(sceneOf({sphere()}, placed(40, 1)));
  EXPECT_EQ(micropolygons(moving({placed(40, 1), placed(-4, 1)})), still);
  EXPECT_EQ(micropolygons(moving({placed(40, 1), translation({3, 0, 1.1f})})), still);
}

TEST(Rate, MicropolygonsAreInTheMeanAsLargeAsTheShadingRateAsksAndNowhereMuchLarger) {
  for (const float rate : {0.25f, 1.0f, 4.0f}) {
    const Scene scene = sceneOf({sphere()}, translation({0, 0, 4}), rate);
    const Camera camera(scene.options);
    Stats stats;
    float area_px2 = 0, count = 0;
    for (const SubPatch& p : split(scene, stats)) {
      const Grid g = diceAtOpen(scene, p.object, p.patch, p.rect, p.nu, p.nv);
      for (int j = 0; j < g.nv; ++j)
        for (int i = 0; i < g.nu; ++i) {
          const int k = j * (g.nu + 1) + i;
          const auto at = [&](int vertex) { return camera.raster(g.position(0, vertex)); };
          const vec2 u = at(k + 1) - at(k), v = at(k + g.nu + 1) - at(k);
          const float area = std::abs(u.x * v.y - u.y * v.x);
          area_px2 += area;
          count += 1;
          // Lines run faster in some places of a piece than in the mean, most of all at the horizon.
          EXPECT_LT(area, 2.3f * rate);
          EXPECT_LT(std::max(glm::length(u), glm::length(v)), 3 * std::sqrt(rate));
        }
    }
    EXPECT_GT(area_px2 / count, 0.6f * rate);
    EXPECT_LT(area_px2 / count, rate);
  }
}

/// A parallelogram in the plane of the picture whose sides meet at an angle.
PrimPtr slanted(float degrees) {
  Problems problems;
  Param P;
  P.name = "P";
  P.type = ValueType::Point;
  P.storage = Storage::Vertex;
  const float c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
  P.floats = {0, 0, 0, 1, 0, 0, c, s, 0, 1 + c, s, 0};
  return makeBilinearPatchMesh(2, false, 2, false, {P}, problems);
}

TEST(Rate, WhatIsSlantedHasMicropolygonsOfTheAreaAsked) {
  // Sides of 128 / (2 tan 30) / 4 = 27.7 px.
  for (const float degrees : {90.0f, 60.0f, 35.0f}) {
    const double area_px = 27.71 * 27.71 * std::sin(glm::radians(degrees));
    EXPECT_NEAR(static_cast<double>(micropolygons(sceneOf({slanted(degrees)}, translation({-0.5f, 0, 4})))), area_px,
                0.12 * area_px);
  }
}

TEST(Rate, WhatIsSmallHasNoMoreMicropolygonsThanItsAreaAsks) {
  // 1.3 px wide and high: two of 0.85 px2, and not four.
  EXPECT_EQ(micropolygons(sceneOf({slanted(90)}, translation({-0.5f, 0, 27.71f * 4 / 1.3f}))), 2u);
}

Scene withDicing(Scene scene, bool binary, bool rasterOrient) {
  auto attributes = std::make_shared<Attributes>(*scene.objects[0].attributes);
  attributes->binaryDice = binary;
  attributes->rasterOrient = rasterOrient;
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
    for (const SubPatch& p :
         split(withDicing(sceneOf({quad(1, -0.2f)}, translation({0, 0, 8})), false, rasterOrient), stats))
      n += int64_t{p.nu} * p.nv;
    return n;
  };
  EXPECT_GT(cells(false), 4 * cells(true));
}

TEST(Rate, DisksThatAreTakenForDotsUnmeasuredWouldTakeFewCells) {
  Param P, N, width;
  P.name = "P";
  P.type = ValueType::Point;
  P.storage = Storage::Vertex;
  N.name = "N";
  N.type = ValueType::Normal;
  N.storage = Storage::Vertex;
  width.name = "width";
  width.type = ValueType::Float;
  width.storage = Storage::Vertex;
  constexpr uint32_t kDisks = 2000;
  for (uint32_t i = 0; i < kDisks; ++i) {
    const auto random = [i](uint32_t dimension) { return unitFloat(hashCombine(i, dimension)); };
    const float z = 0.3f + 4 * random(0);
    for (const float x : {(random(1) - 0.5f) * z, (random(2) - 0.5f) * z, z}) P.floats.push_back(x);
    for (const float n : {random(3) - 0.5f, random(4) - 0.5f, random(5) - 0.5f}) N.floats.push_back(n);
    width.floats.push_back(4 * random(6) * z / 110);  // A pixel is about a hundred and tenth of z.
  }
  Problems problems;
  for (const ParamList& params : {ParamList{P, width}, ParamList{P, N, width}}) {
    const Scene scene = sceneOf({makePoints(params, problems)}, mat4(1));
    const Camera camera(scene.options);
    Stats stats;
    int dots = 0;
    for (const SubPatch& p : split(scene, stats)) {
      const Cells c = cells(measure(scene.objects[0], camera, p.patch, UvRect{}), {});
      EXPECT_EQ(p.round, c.nu * c.nv <= 6) << c.nu << " x " << c.nv;
      dots += p.round;
    }
    EXPECT_GT(dots, 500);
    EXPECT_LT(dots, 1900);
  }
}

TEST(Rate, RoundingDoesNotTurnTheCellsOfASquare) {
  const auto cut = [](float u_px, float v_px) {
    PatchSize size;
    size.u.px = u_px;
    size.v.px = v_px;
    size.area_px2 = u_px * v_px;
    return cells(size, {});
  };
  for (const float px : {9.77f, 3.4f, 17.6f, 5.2f}) {
    const Cells even = cut(px, px);
    for (const float other : {std::nextafter(px, 0.0f), std::nextafter(px, 100.0f), px * 1.00001f, px * 0.99999f}) {
      EXPECT_EQ(cut(px, other).nu, even.nu) << px;
      EXPECT_EQ(cut(px, other).nv, even.nv) << px;
    }
  }
}

}  // namespace
}  // namespace tomales
