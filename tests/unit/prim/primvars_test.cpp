#include "tests/unit/prim/support.h"

namespace tomales {
namespace {
using namespace test;

TEST(Primvars, StArrivesSplit) {
  Problems problems;
  const auto vars =
      takePrimvars({floats("st", Storage::Varying, ValueType::Float, {0, 1, 2, 3, 4, 5, 6, 7}, 2)}, {}, problems);
  ASSERT_EQ(vars.size(), 2u);
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
  p.name = "id", p.storage = Storage::Uniform, p.type = ValueType::Integer, p.ints = {7};
  Problems problems;
  EXPECT_EQ(takePrimvars({p}, {}, problems).at(0).values, (std::vector<float>{7}));
}

TEST(Primvars, StringsAndWrongCountsAreDroppedWithASentence) {
  Param text;
  text.name = "label", text.storage = Storage::Varying, text.type = ValueType::String, text.strings = {"a"};
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
  text.name = "label", text.type = ValueType::String, text.strings = {"a"};
  Problems problems;
  for (const Storage storage : {Storage::Constant, Storage::Uniform}) {
    text.storage = storage;
    EXPECT_TRUE(takePrimvars({text}, {}, problems).empty());
  }
  EXPECT_TRUE(problems.empty());
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

}  // namespace
}  // namespace tomales
