#include "reyes/prim/primvars.h"

#include "tests/unit/prim/support.h"

namespace tomales {
namespace {
using namespace test;

TEST(Primvars, StArrivesSplit) {
  Problems problems;
  const auto vars =
      takePrimvars({floats("st", Storage::Varying, ValueType::Float, {0, 1, 2, 3, 4, 5, 6, 7}, 2)}, {}, problems);
  ASSERT_EQ(vars.size(), 2u);
  for (const Primvar& v : vars) EXPECT_TRUE(v.width == 1 && v.type == ValueType::Float);
  EXPECT_EQ(vars[0].name, "s");
  EXPECT_EQ(vars[0].values, (std::vector<float>{0, 2, 4, 6}));
  EXPECT_EQ(vars[1].name, "t");
  EXPECT_EQ(vars[1].values, (std::vector<float>{1, 3, 5, 7}));
}

TEST(Primvars, PositionsAreNotAmongThem) {
  Problems problems;
  EXPECT_TRUE(
      takePrimvars({positions({0, 0, 0}), floats("Pz", Storage::Vertex, ValueType::Float, {1})}, {}, problems).empty());
  EXPECT_TRUE(problems.empty());
}

TEST(Primvars, IntegersBecomeFloats) {
  Param p;
  p.name = "id";
  p.storage = Storage::Uniform;
  p.type = ValueType::Integer;
  p.ints = {7};
  Problems problems;
  EXPECT_EQ(takePrimvars({p}, {}, problems).at(0).values, (std::vector<float>{7}));
}

TEST(Primvars, StringsAndWrongCountsAreDroppedWithASentence) {
  Param text;
  text.name = "label";
  text.storage = Storage::Varying;
  text.type = ValueType::String;
  text.strings = {"a"};
  Problems problems;
  const auto vars = takePrimvars({text, floats("Cs", Storage::Varying, ValueType::Color, {1, 2, 3}),
                                  floats("k", Storage::Constant, ValueType::Float, {4})},
                                 {}, problems);
  ASSERT_EQ(vars.size(), 1u);
  EXPECT_EQ(vars[0].name, "k");
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[1], "Cs has 3 values where 4 elements need 12 floats; it was dropped");
}

TEST(Primvars, AStringOfTheWholePrimitiveIsLeftToItsShaders) {
  Param text;
  text.name = "label";
  text.type = ValueType::String;
  text.strings = {"a"};
  Problems problems;
  for (const Storage storage : {Storage::Constant, Storage::Uniform}) {
    text.storage = storage;
    EXPECT_TRUE(takePrimvars({text}, {}, problems).empty());
  }
  EXPECT_TRUE(problems.empty());
}

TEST(Primvars, AHomogeneousPointOfWeightZeroIsDroppedWithASentence) {
  for (const size_t zero : {3u, 7u, 11u}) {
    std::vector<float> values = {2, 4, 6, 2, 3, 6, 9, 3, 1, 2, 3, 1};
    Problems problems;
    const PrimvarCounts three{1, 1, 3, 1};
    const auto taken = [&] {
      return takePrimvars({floats("rest", Storage::Vertex, ValueType::HPoint, values)}, three, problems);
    };
    EXPECT_EQ(taken().at(0).values, (std::vector<float>{1, 2, 3, 1, 2, 3, 1, 2, 3}));
    EXPECT_TRUE(problems.empty());
    values[zero] = 0;
    EXPECT_TRUE(taken().empty()) << zero;
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0], "rest has a point of weight 0; it was dropped");
  }
}

Param weighted(std::vector<float> values) {
  return floats("Pw", Storage::Vertex, ValueType::HPoint, std::move(values));
}

TEST(Positions, OfUnequalWeightsAreDividedWithASentence) {
  Problems problems;
  const std::vector<vec3> points = {{1, 2, 3}, {4, 5, 6}};
  EXPECT_EQ(takePositions({weighted({2, 4, 6, 2, 8, 10, 12, 2})}, Count::Exactly, 2, problems), points);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(takePositions({weighted({2, 4, 6, 2, 4, 5, 6, 1})}, Count::Exactly, 2, problems), points);
  EXPECT_EQ(problems.size(), 1u);
  EXPECT_EQ(errorOf([&] {
              takePositions({weighted({2, 4, 6, 2, 4, 5, 6, 0})}, Count::Exactly, 2, problems);
            }),
            "Pw of vertex 1 has weight 0");
}

TEST(Positions, MayBeMoreThanAreNeededWhereThatIsAllowed) {
  Problems problems;
  const auto error = [&](size_t floatCount, Count count, size_t needed) {
    return errorOf([&] { takePositions({positions(std::vector<float>(floatCount, 1))}, count, needed, problems); });
  };
  EXPECT_EQ(error(9, Count::AtLeast, 3), "");
  EXPECT_EQ(error(9, Count::AtLeast, 2), "");
  EXPECT_EQ(error(9, Count::AtLeast, 4), "P has 9 values where 4 vertices need 12 floats");
  EXPECT_EQ(error(9, Count::Exactly, 3), "");
  EXPECT_EQ(error(9, Count::Exactly, 2), "P has 9 values where 2 vertices need 6 floats");
  EXPECT_EQ(error(8, Count::AtLeast, 2), "P has 8 values where 2 vertices need 6 floats");
}

TEST(Positions, KeepTheirWeightsWherePatchesAreRational) {
  const std::vector<vec4> kept = {{2, 4, 6, 2}, {4, 5, 6, 1}}, whole = {{1, 2, 3, 1}, {4, 5, 6, 1}};
  EXPECT_EQ(takeHomogeneous({weighted({2, 4, 6, 2, 4, 5, 6, 1})}, 2), kept);
  EXPECT_EQ(takeHomogeneous({positions({1, 2, 3, 4, 5, 6})}, 2), whole);
}

TEST(Faces, NeedAsManyVerticesAsTheyNameAndNoNegativeOnes) {
  const auto error = [](const std::vector<int>& counts, const std::vector<int>& vertices) {
    return errorOf([&] { requireFaces(counts, vertices); });
  };
  EXPECT_EQ(requireFaces({3, 3}, {0, 1, 2, 5, 4, 3}), 6u);
  EXPECT_EQ(requireFaces({1}, {0}), 1u);
  EXPECT_EQ(error({}, {}), "the mesh has no faces");
  EXPECT_EQ(error({3, -2}, {0}), "face 1 has -2 vertices");
  EXPECT_EQ(error({3, 4}, {0, 1, 2, 3, 4, 5}), "the faces need 7 vertex indices and 6 are given");
  EXPECT_EQ(error({3}, {0, -3, 1}), "vertex index -3 is negative");
}

TEST(Primvars, MatricesAndArraysKeepTheirWidth) {
  Problems problems;
  const auto vars = takePrimvars({floats("m", Storage::Constant, ValueType::Matrix, std::vector<float>(16, 1)),
                                  floats("w", Storage::Uniform, ValueType::Color, std::vector<float>(6, 1), 2)},
                                 {}, problems);
  ASSERT_EQ(vars.size(), 2u);
  EXPECT_EQ(vars[0].width, 16);
  EXPECT_EQ(vars[1].width, 6);
}

// Caches free what is large by what it says, so a primitive must not forget a part of itself.
TEST(Primitives, TellHowMuchTheyHold) {
  Problems problems;
  const auto row = [](int count) {
    std::vector<float> p;
    for (int i = 0; i < count; ++i) p.insert(p.end(), {static_cast<float>(i), static_cast<float>(i % 2), 0});
    return ParamList{positions(std::move(p))};
  };
  const auto grid = [](int nu, int nv) {
    std::vector<float> p;
    for (int j = 0; j < nv; ++j)
      for (int i = 0; i < nu; ++i)
        p.insert(p.end(), {static_cast<float>(i), static_cast<float>(j), 0.1f * static_cast<float>(i % 3)});
    return ParamList{positions(std::move(p))};
  };
  const auto line = [](int controls) {
    NurbsDirection out{controls, 4, {}, 3, static_cast<float>(controls)};
    for (int i = 0; i < controls + 4; ++i) out.knots.push_back(static_cast<float>(i));
    return out;
  };
  const auto strip = [](int faces) {  // counts and vertices of quadrilaterals between two rows of points
    std::pair<std::vector<int>, std::vector<int>> out;
    for (int i = 0; i < faces; ++i) {
      out.first.push_back(4);
      out.second.insert(out.second.end(), {i, i + 1, i + faces + 2, i + faces + 1});
    }
    return out;
  };
  const struct {
    const char* name;
    std::function<PrimPtr(int)> make;  // of so many points, at least
    size_t least;                      // bytes of a point
  } rows[] = {
      {"Points", [&](int n) { return makePoints(row(n), problems); }, 12},
      {"Curves", [&](int n) { return makeCurves(false, bezierBasis(), {n}, false, row(n), problems); }, 12},
      {"tubes", [&](int n) { return makeTubes(false, bezierBasis(), {n}, false, row(n), problems); }, 24},
      {"bilinear", [&](int n) { return makeBilinearPatchMesh(n, false, 2, false, grid(n, 2), problems); }, 24},
      {"bicubic",
       [&](int n) {
         return makeBicubicPatchMesh(n + 3, false, bsplineBasis(), 4, false, bsplineBasis(), grid(n + 3, 4), problems);
       },
       192},  // 16 points for each patch
      {"NuPatch", [&](int n) { return makeNuPatch(line(n), line(4), {}, grid(n, 4), problems); }, 64 + 16},
      {"PointsPolygons",
       [&](int n) {
         const auto [counts, vertices] = strip(n);
         return makePolygons(counts, vertices, grid(n + 1, 2), problems);
       },
       24 + 16},
      {"SubdivisionMesh",
       [&](int n) {
         const auto [counts, vertices] = strip(n);
         return makeSubdivisionMesh("catmull-clark", counts, vertices, {{"interpolateboundary"}, {0, 0, 0}, {}, {}, {}},
                                    grid(n + 1, 2), problems);
       },
       400 + 24},
  };
  for (const auto& shape : rows) {
    const size_t few = shape.make(500)->bytes(), many = shape.make(2000)->bytes();
    EXPECT_GE(few, 500 * shape.least) << shape.name;
    EXPECT_LT(few, 500 * 4000u) << shape.name;
    EXPECT_NEAR(static_cast<double>(many) / static_cast<double>(few), 4, 1.1) << shape.name;
  }
  EXPECT_TRUE(problems.empty());
}

}  // namespace
}  // namespace tomales
