#include "reyes/base/morton.h"
#include "reyes/base/rng.h"
#include "tests/unit/split/test_scene.h"

namespace tomales {
namespace {
using namespace test;

TEST(PatchTree, BoxesOfEveryLevelHoldThePatchesBelow) {
  std::vector<Param> params(1);
  params[0].name = "P";
  params[0].type = ValueType::Point;
  params[0].storage = Storage::Vertex;
  const int n = 61;  // 3600 patches: 57 leaves, 4 boxes of leaves, 1.
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      for (const float x : {static_cast<float>(i), static_cast<float>(j), static_cast<float>(i * j % 7)})
        params[0].floats.push_back(x);
  Problems problems;
  const PrimPtr mesh = makeBilinearPatchMesh(n, false, n, false, params, problems);
  const PatchTree tree({mesh});
  ASSERT_EQ(tree.top(), 2u);
  EXPECT_EQ(tree.count(0), 57u);
  EXPECT_EQ(tree.count(2), 1u);
  const auto holds = [](const Bound3& out, const Bound3& in) {
    return glm::all(glm::lessThanEqual(out.lo, in.lo)) && glm::all(glm::greaterThanEqual(out.hi, in.hi));
  };
  std::vector<int> found(mesh->patchCount());
  float longest = 0;
  for (uint32_t leaf = 0; leaf < tree.count(0); ++leaf) {
    for (const uint32_t p : tree.patches(0, leaf)) {
      ++found[p];
      for (uint32_t level = 0, index = leaf; level <= tree.top(); ++level, index /= PatchTree::kFan)
        EXPECT_TRUE(holds(tree.box(level, index), mesh->bound(p, UvRect{})));
    }
    longest += std::max(tree.box(0, leaf).size().x, tree.box(0, leaf).size().y) / 57;
  }
  for (const int times : found) EXPECT_EQ(times, 1);
  EXPECT_EQ(tree.patches(1, 0).size(), PatchTree::patchesOfBox(1));
  EXPECT_EQ(tree.patches(1, 1).data(), tree.patches(0, PatchTree::kFan).data());
  EXPECT_EQ(tree.patches(2, 0).size(), mesh->patchCount());
  EXPECT_LT(longest, 30);  // Row by row a leaf is 60 long.
}

TEST(PatchTree, PatchesFollowMortonsCurveAndThoseOfOnePlaceStayInOrder) {
  std::vector<Param> params(1);
  params[0].name = "P";
  params[0].type = ValueType::Point;
  params[0].storage = Storage::Vertex;
  for (uint32_t i = 0; i < 3 * 5000; ++i) params[0].floats.push_back(i / 3 < 4000 ? unitFloat(hash32(i)) : 0.5f);
  Problems problems;
  const PrimPtr points = makePoints(params, problems);
  const PatchTree tree({points});
  Bound3 all;
  for (uint32_t p = 0; p < points->patchCount(); ++p) all.extend(points->bound(p, {}));
  std::vector<std::pair<uint32_t, uint32_t>> order;
  for (uint32_t leaf = 0; leaf < tree.count(0); ++leaf)
    for (const uint32_t p : tree.patches(0, leaf))
      order.emplace_back(mortonPlace(points->bound(p, {}).center(), all), p);
  EXPECT_EQ(order.size(), 5000u);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST(PlaceBox, ACrossedEyePlaneIsTheWholeWindowAndWhatIsBehindIsNowhere) {
  const Scene scene = sceneOf({sphere()}, mat4(1.0f));
  const Camera camera(scene.options);
  const auto place = [&](float z) {
    return placeBox({{vec3(-1), vec3(1)}, Motion::still(translation({0, 0, z})), {0.0f}, 0}, camera, camera.crop());
  };
  EXPECT_FALSE(place(-3).has_value());
  ASSERT_TRUE(place(0).has_value());
  EXPECT_LE(place(0)->raster.lo.x, 0);
  EXPECT_GE(place(0)->raster.hi.y, 128);
  EXPECT_FLOAT_EQ(place(5)->zMin, 4);
}

}  // namespace
}  // namespace tomales
