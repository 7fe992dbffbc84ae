#include "reyes/prim/subdivision_tags.h"

#include <gtest/gtest.h>

namespace tomales {
namespace {

struct Read {
  Problems problems;
  MeshTags tags;

  Read(const std::string& name, const std::vector<int>& ints, const std::vector<std::string>& strings = {}) {
    const SubdivisionTags given{
        {name}, {static_cast<int>(ints.size()), 0, static_cast<int>(strings.size())}, ints, {}, strings};
    tags = readTags(given, EdgeFaces({4}, {0, 1, 2, 3}), 1, 4, problems);
  }
};

TEST(SubdivisionTag, OfACreaseMethodNamesOneOfTwo) {
  EXPECT_TRUE(Read("creasemethod", {}, {"chaikin"}).tags.chaikin);
  EXPECT_FALSE(Read("creasemethod", {}, {"normal"}).tags.chaikin);
  EXPECT_TRUE(Read("creasemethod", {}, {"normal"}).problems.empty());
  for (const std::vector<std::string>& bad : {std::vector<std::string>{}, {"sharp"}}) {
    const Read r("creasemethod", {}, bad);
    EXPECT_FALSE(r.tags.chaikin);
    ASSERT_EQ(r.problems.size(), 1u);
    EXPECT_NE(r.problems[0].find("has no method"), std::string::npos);
  }
}

TEST(SubdivisionTag, OfSmoothTrianglesIsOnForTwo) {
  for (const int value : {0, 1, 2}) {
    const Read r("smoothtriangles", {value});
    EXPECT_EQ(r.tags.smoothTriangles, value == 2);
    EXPECT_TRUE(r.problems.empty());
  }
  EXPECT_FALSE(Read("smoothtriangles", {}).tags.smoothTriangles);
  EXPECT_EQ(Read("smoothtriangles", {3}).problems.size(), 1u);
  EXPECT_EQ(Read("smoothtriangles", {-1}).problems.size(), 1u);
}

TEST(SubdivisionTag, OfBoundariesChoosesAmongItsValues) {
  using B = MeshTags::Boundary;
  using F = MeshTags::FaceVaryingBoundary;
  const B boundaries[] = {B::None, B::EdgeAndCorner, B::EdgeOnly};
  for (int k = 0; k < 3; ++k) EXPECT_EQ(Read("interpolateboundary", {k}).tags.boundary, boundaries[k]);
  EXPECT_EQ(Read("interpolateboundary", {}).tags.boundary, B::EdgeAndCorner);
  EXPECT_EQ(Read("interpolateboundary", {3}).tags.boundary, B::None);
  const F faceVarying[] = {F::Linear, F::EdgeAndCorner, F::EdgeOnly, F::AlwaysSharp};
  for (int k = 0; k < 4; ++k) EXPECT_EQ(Read("facevaryinginterpolateboundary", {k}).tags.faceVarying, faceVarying[k]);
  EXPECT_EQ(Read("facevaryinginterpolateboundary", {4}).problems.size(), 1u);
  EXPECT_TRUE(Read("facevaryingpropagatecorners", {1}).tags.propagateCorners);
  EXPECT_FALSE(Read("facevaryingpropagatecorners", {0}).tags.propagateCorners);
  EXPECT_FALSE(Read("facevaryingpropagatecorners", {}).tags.propagateCorners);
}

TEST(SubdivisionTag, OfANameThatIsGivenTwiceCountsAsGivenLast) {
  const auto last = [](const std::string& name, int first, int second) {
    Problems problems;
    return readTags({{name, name}, {1, 0, 0, 1, 0, 0}, {first, second}, {}, {}}, EdgeFaces({4}, {0, 1, 2, 3}), 1, 4,
                    problems);
  };
  EXPECT_EQ(last("interpolateboundary", 2, 0).boundary, MeshTags::Boundary::None);
  EXPECT_EQ(last("facevaryinginterpolateboundary", 2, 0).faceVarying, MeshTags::FaceVaryingBoundary::Linear);
  EXPECT_FALSE(last("smoothtriangles", 2, 0).smoothTriangles);
}

TEST(SubdivisionTag, WithTooFewArgumentsThrowsASentence) {
  Problems problems;
  for (const std::vector<int>& counts :
       {std::vector<int>{2, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {1, 0}, {0, 0, 0, 0}})
    EXPECT_THROW(readTags({{"hole"}, counts, {0}, {}, {}}, EdgeFaces({4}, {0, 1, 2, 3}), 1, 4, problems), PrimError);
}

}  // namespace
}  // namespace tomales
