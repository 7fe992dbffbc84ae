// Defaults that a shader computes when it runs, found without the rest of it.
#include "tests/unit/rsl/shaded.h"

namespace tomales::compiler {
namespace {

constexpr int kPoints = 20;

size_t named(const CompiledText& compiled, std::string_view name) {
  const std::vector<Parameter>& all = compiled.shader().lowered().parameters;
  const auto it = std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return !p.output && p.name == name; });
  return static_cast<size_t>(it - all.begin());
}

class Defaults : public ::testing::Test {
 protected:
  RslValue value(std::string_view name) { return compiled.shader().value(named(compiled, name), grid.grid); }
  void SetUp() override {
    ASSERT_TRUE(compiled.good()) << compiled.said();
    grid.bindOutputs(compiled.shader().lowered());
    grid.grid.shader = compiled.shader().host();
  }
  const CompiledText compiled{
      "float power(float n) { float i, x = 1; for (i = 0; i < n; i += 1) { if (i > 2) return x; x *= 2; } return x; }"
      "surface test(float a = 2; float p = power(5); string t = \"x\"; float b = 3 * a; float moved = b + s; color c = "
      "color(1, b, 0);"
      " string n = concat(t, \"y\"); float l[2] = {b, 2 * b}; matrix m = scale(1, vector(b, 1, 1));"
      " float elsewhere = xcomp(transform(\"shader\", P)); output float o = 1;) {"
      " o = b + comp(c, 0) + l[0] + comp(m, 0, 0) + moved + elsewhere + p; if (n == \"xy\") Ci = c; Oi = a; }"};
  ServedGrid grid{kPoints};
};

TEST_F(Defaults, OfNumbersFollowTheParametersThatTheyAreComputedFrom) {
  const RslValue b = value("b");
  EXPECT_FALSE(b.varies);
  EXPECT_EQ(b.floats, std::vector<float>{6});
}

TEST_F(Defaults, ThatVaryHaveAValueForEachPoint) {
  const RslValue moved = value("moved");
  ASSERT_TRUE(moved.varies);
  for (int i = 0; i < kPoints; ++i)
    EXPECT_EQ(moved.floats[static_cast<size_t>(i)], 6 + grid.grid.s[i]) << "point " << i;
}

TEST_F(Defaults, OfEveryTypeAreFound) {
  EXPECT_EQ(value("c").floats, (std::vector<float>{1, 6, 0}));
  EXPECT_EQ(value("l").floats, (std::vector<float>{6, 12}));
  EXPECT_EQ(value("m").floats, (std::vector<float>{6, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
  EXPECT_EQ(value("n").texts, std::vector<std::string>{"xy"});
}

TEST_F(Defaults, AreFixedIfNeitherPointsNorTheSceneDecide) {
  const auto fixed = [&](std::string_view name) {
    return compiled.shader().fixedValue(named(compiled, name), grid.grid.params);
  };
  ASSERT_TRUE(fixed("b"));
  EXPECT_EQ(fixed("b")->floats, std::vector<float>{6});
  ASSERT_TRUE(fixed("n"));
  EXPECT_EQ(fixed("n")->texts, std::vector<std::string>{"xy"});
  ASSERT_TRUE(fixed("p")) << "loops and returns of functions do not decide either";
  EXPECT_EQ(fixed("p")->floats, std::vector<float>{8});
  EXPECT_FALSE(fixed("moved"));
  EXPECT_FALSE(fixed("elsewhere"));
}

TEST_F(Defaults, LeaveWhatTheShaderWritesAlone) {
  const size_t o = outputNamed(compiled, "o");
  const float before = grid.grid.params[o].c[0][3];
  value("moved");
  EXPECT_EQ(grid.grid.params[o].c[0][3], before);
}

}  // namespace
}  // namespace tomales::compiler
