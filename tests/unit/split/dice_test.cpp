#include "reyes/dice.h"

#include "tests/unit/split/test_scene.h"

namespace tomales {
namespace {
using test::sceneOf;
using test::sphere;
using test::translation;

double area(const Grid& g) {
  double sum = 0;
  for (int j = 0; j < g.nv; ++j)
    for (int i = 0; i < g.nu; ++i) {
      const int a = j * (g.nu + 1) + i, d = a + g.nu + 2;
      const vec3 p = g.position(0, a), q = g.position(0, a + 1), r = g.position(0, d - 1), s = g.position(0, d);
      sum += 0.5 * glm::length(cross(q - p, r - p)) + 0.5 * glm::length(cross(s - q, s - r));
    }
  return sum;
}

TEST(Dice, AreaOfADicedSphereTendsToFourPiAtSecondOrder) {
  const Scene scene = sceneOf({sphere()}, translation({0, 0, 5}));
  const auto error = [&](int n) { return 4 * 3.14159265358979 - area(diceAtOpen(scene, 0, 0, {}, 2 * n, n)); };
  const double coarse = error(16), fine = error(32);
  EXPECT_GT(coarse, 0);
  EXPECT_GT(fine, 0);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.05);
}

TEST(Dice, PiecesOfOnePatchShareTheirEdgeBitForBit) {
  const Scene scene = sceneOf({sphere()}, translation({0.3f, -0.2f, 5}));
  const Grid a = diceAtOpen(scene, 0, 0, {0.125f, 0.25f, 0.5f, 0.75f}, 8, 5),
             b = diceAtOpen(scene, 0, 0, {0.25f, 0.375f, 0.5f, 0.75f}, 3, 5);
  for (int v = 0; v <= 5; ++v) EXPECT_EQ(a.position(0, v * 9 + 8), b.position(0, v * 4));
}

TEST(Dice, PiecesThatShareAGridAreWhatTheyAreAlone) {
  const Scene scene = sceneOf({sphere()}, translation({0.3f, -0.2f, 5}));
  const std::vector<float> times = {0};
  const DiceKeys keys{times, scene.objects[0].cameraFromObject};
  const std::vector<PatchPiece> pieces = {
      {0, {}}, {0, {0.125f, 0.25f, 0.5f, 0.75f}}, {0, {0.25f, 0.5f, 0, 1}}, {0, {}}};
  const int nu = 3, nv = 2;
  const Grid all = dice(scene, 0, pieces, nu, nv, keys);
  ASSERT_EQ(all.pieceCount(), 4);
  EXPECT_EQ(all.cellCount(), 4 * nu * nv);
  int cells = 0;
  for (int number = 0; number < all.cellNumbers(); ++number) cells += all.isCell(number);
  EXPECT_EQ(cells, all.cellCount());
  for (int p = 0; p < all.pieceCount(); ++p) {
    const PatchPiece& piece = pieces[static_cast<size_t>(p)];
    const Grid one = dice(scene, 0, piece.patch, piece.rect, nu, nv, keys);
    const Grid::Piece &a = all.pieces[static_cast<size_t>(p)], &b = one.pieces[0];
    EXPECT_EQ(a.sampleKey, b.sampleKey);
    EXPECT_EQ(a.openEdges, b.openEdges);
    for (int v = 0; v < one.vertexCount(); ++v) {
      const int k = p * all.verticesOfPiece() + v;
      EXPECT_EQ(all.position(0, k), one.position(0, v));
      EXPECT_EQ(all.normal(k), one.normal(v));
      EXPECT_EQ(vec2(all.u()[k], all.v()[k]), vec2(one.u()[v], one.v()[v]));
    }
    for (int cell = 0; cell < one.cellCount(); ++cell) {
      const int number = p * (nv + 1) * nu + cell;
      EXPECT_TRUE(all.isCell(number));
      EXPECT_EQ(all.pieceOfCell(number), p);
      EXPECT_EQ(all.cellInPiece(number), cell);
      EXPECT_EQ(all.onPatch(number, {0.3f, 0.6f}), one.onPatch(cell, {0.3f, 0.6f}));
    }
  }
}

TEST(Dice, NormalsPointOutwardsThroughMirrorsAndInsideOut) {
  for (const float mirror : {1.0f, -1.0f})
    for (const bool inside : {false, true}) {
      mat4 m = translation({0, 0, 5});
      m[0][0] = mirror;
      Scene scene = sceneOf({sphere()}, m);
      auto attributes = std::make_shared<Attributes>();
      attributes->insideOut = inside;
      scene.objects[0].attributes = attributes;
      scene.objects[0].group = -1;
      scene.freeze();
      const Grid g = diceAtOpen(scene, 0, 0, {}, 12, 8);
      for (int i = 0; i < g.vertexCount(); ++i) {
        const vec3 outward = g.position(0, i) - vec3(0, 0, 5);
        EXPECT_GT(dot(glm::normalize(g.normal(i)), outward) * (inside ? -1 : 1), 0.99f);
      }
      // Normals measured from the lattice agree with the analytic ones, poles included.
      AlignedVector<float> n[3];
      for (auto& x : n) x.resize(static_cast<size_t>(g.stride()));
      calculateNormals(g, scene.objects[0].flipsNormal, n[0].data(), n[1].data(), n[2].data());
      for (size_t i = 0; i < static_cast<size_t>(g.vertexCount()); ++i)
        EXPECT_GT(dot(vec3(n[0][i], n[1][i], n[2][i]), glm::normalize(g.normal(static_cast<int>(i)))), 0.8f) << i;
    }
}

TEST(Dice, MotionKeysFollowTheTransformation) {
  Scene scene = sceneOf({sphere()}, translation({0, 0, 5}));
  scene.options.shutterClose = 1;
  scene.objects[0].worldFromObject = {{0, 1}, {translation({0, 0, 5}), translation({2, 0, 5})}};
  scene.objects[0].group = -1;
  scene.freeze();
  ASSERT_EQ(scene.objects[0].keyTimes.size(), 2u);
  const Grid g = dice(scene, 0, 0, {}, 4, 4, {scene.objects[0].keyTimes, scene.objects[0].cameraFromObject});
  for (int i = 0; i < g.vertexCount(); ++i) EXPECT_NEAR(g.P(1, 0)[i] - g.P(0, 0)[i], 2.0f, 1e-6f);
}

/// A square that counts how often it is evaluated.
struct Counting : Prim {
  int* count;

  explicit Counting(int* c) : Prim({}), count(c) {}
  uint32_t patchCount() const override { return 1; }
  PatchInfo info(uint32_t) const override { return {}; }
  Bound3 bound(uint32_t, const UvRect&) const override { return {vec3(0), vec3(1)}; }
  void evaluate(uint32_t, int n, const float* u, const float* v, SurfacePoints s) const override {
    ++*count;
    for (int i = 0; i < n; ++i) {
      s.px[i] = u[i];
      s.py[i] = v[i];
      s.pz[i] = 0;
    }
  }
  void interpolate(uint32_t, int, int, const float*, const float*, float*, int) const override {}
};

TEST(Dice, WhatMovesWithoutDeformingIsEvaluatedOnce) {
  int count = 0;
  Scene scene = sceneOf({std::make_shared<Counting>(&count)}, translation({0, 0, 5}));
  scene.options.shutterClose = 1;
  scene.objects[0].worldFromObject = {{0, 0.5f, 1},
                                      {translation({0, 0, 5}), translation({1, 0, 5}), translation({2, 0, 5})}};
  scene.objects[0].group = -1;
  scene.freeze();
  const Grid g =
      dice(scene, 0, 0, {0, 0.5f, 0, 0.5f}, 4, 4, {scene.objects[0].keyTimes, scene.objects[0].cameraFromObject});
  EXPECT_EQ(count, 1);
  for (int key = 0; key < 3; ++key) EXPECT_EQ(g.P(key, 0)[1], 0.125f + static_cast<float>(key));
}

TEST(Dice, APointOfARayHitIsTheSamePointAsAVertex) {
  const Scene scene = sceneOf({sphere()}, translation({0, 0, 5}));
  const Grid g = diceAtOpen(scene, 0, 0, {}, 8, 8);
  ShadePoints points(0, 0);
  points.add(1);
  evaluatePoint(scene, 0, 0, 0.25f, 0.5f, points, 0);
  EXPECT_NEAR(glm::length(points.position(0) - g.position(0, 4 * 9 + 2)), 0, 1e-6f);
  EXPECT_FLOAT_EQ(points.channel(kS)[0], 0.25f);
  EXPECT_FLOAT_EQ(points.channel(kT)[0], 0.5f);
  // dP/du of a unit sphere at its equator is 2 pi per unit u; dP/dv runs pole to pole, pi.
  EXPECT_NEAR(glm::length(points.get3(kDpduX, 0)), 2 * kPi, 1e-4f);
  EXPECT_NEAR(glm::length(points.get3(kDpdvX, 0)), kPi, 1e-4f);
}

}  // namespace
}  // namespace tomales
