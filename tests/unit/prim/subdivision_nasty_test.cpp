#include "tests/unit/prim/subdivision.h"

namespace tomales {
namespace {
using namespace test;

TEST(NastyMesh, WrongTopologyThrowsASentence) {
  const auto error = [](Mesh mesh) { return errorOf([&] { mesh.make(); }); };
  const ParamList square = {positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0})};
  EXPECT_EQ(error({{4}, {0, 1, 2, 7}, square, {}}), "P has 12 values where 8 vertices need 24 floats");
  EXPECT_NE(error({{4}, {0, 1, 2, -1}, square, {}}), "");
  EXPECT_NE(error({{-4}, {0, 1, 2, 3}, square, {}}), "");
  EXPECT_NE(error({{5}, {0, 1, 2, 3}, square, {}}), "");
  EXPECT_EQ(error({{2, 4}, {0, 1, 0, 1, 2, 3}, square, {}}), "face 0 has 2 vertices, where 3 to 65535 will do");
  EXPECT_EQ(error({{4}, {0, 1, 1, 3}, square, {}}), "face 0 has vertex 1 more than once");
  EXPECT_NE(error({{}, {}, square, {}}), "");
  Mesh loop = cube();
  loop.scheme = "loop";
  EXPECT_EQ(error(loop), "face 0 has 4 vertices, where 3 to 3 will do");
  loop.scheme = "doo-sabin";
  EXPECT_EQ(error(loop), "subdivision scheme \"doo-sabin\" is not supported");
  Mesh tags = cube();
  tags.tags = {{"hole"}, {5, 0, 0}, {1}, {}, {}};
  EXPECT_NE(error(tags), "");
  tags.tags = {{"hole"}, {1}, {1}, {}, {}};
  EXPECT_NE(error(tags), "");
}

TEST(NastyMesh, TagsThatMakeNoSenseAreDroppedWithASentence) {
  for (const Mesh& bad :
       {cube().tag("crease", {0, 6}, {2}), cube().tag("crease", {0, 1, 2}, {1, 2, 3}), cube().tag("crease", {0}, {1}),
        cube().tag("corner", {99}, {1}), cube().tag("corner", {0}), cube().tag("hole", {-1}),
        cube().tag("nonsense", {1}), cube().tag("interpolateboundary", {9})}) {
    Mesh mesh = bad;
    EXPECT_EQ(mesh.make()->patchCount(), 6u);
    EXPECT_EQ(mesh.problems.size(), 1u);
  }
}

/// Whatever becomes of it: no crash, and what is drawn is sound.
void expectSurvives(Mesh mesh) {
  mesh.tag("interpolateboundary", {1});
  try {
    const PrimPtr prim = mesh.make();
    expectSoundEverywhere(*prim);
  } catch (const PrimError& error) {
    EXPECT_NE(std::string(error.what()), "");
  }
}

TEST(NastyMesh, NonManifoldMeshesSurvive) {
  const ParamList points = {
      positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1, 1, 1, 1, 2, 0, 0, 2, 1, 0, 9, 9, 9})};
  expectSurvives({{4, 4, 4}, {0, 1, 2, 3, 1, 2, 5, 4, 1, 6, 7, 2}, points, {}});  // three faces at an edge
  expectSurvives({{4, 4}, {0, 1, 2, 3, 1, 2, 7, 6}, points, {}});  // neighbours that disagree on the outside
  expectSurvives({{4, 4}, {0, 1, 2, 3, 0, 1, 2, 3}, points, {}});  // the same face twice
  expectSurvives({{4, 4}, {0, 1, 2, 3, 3, 2, 1, 0}, points, {}});  // and once from behind
  expectSurvives({{3, 3}, {0, 1, 2, 2, 4, 5}, points, {}});        // two fans at one vertex
}

TEST(NastyMesh, CollapsedAndOddFacesSurvive) {
  expectSurvives({{4}, {0, 1, 2, 3}, {positions(std::vector<float>(12, 3))}, {}});
  expectSurvives({{3}, {0, 1, 2}, {positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}, {}});
  Mesh fan;  // a vertex of valence 64
  std::vector<float> p = {0, 0, 1};
  for (int i = 0; i < 64; ++i) {
    p.insert(p.end(),
             {std::cos(2 * kPi * static_cast<float>(i) / 64), std::sin(2 * kPi * static_cast<float>(i) / 64), 0});
    fan.counts.push_back(3);
    fan.vertices.insert(fan.vertices.end(), {0, 1 + i, 1 + (i + 1) % 64});
  }
  fan.params = {positions(p)};
  expectSurvives(fan);
  Mesh disk;  // one face of 64 vertices
  disk.counts = {64};
  for (int i = 0; i < 64; ++i) disk.vertices.push_back(i + 1);
  disk.params = {positions(p)};
  expectSurvives(disk);
}

}  // namespace
}  // namespace tomales
