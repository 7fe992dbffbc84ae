// What registers hold: globals of every kind of shader, parameters, outputs, arrays, texts.
#include <gtest/gtest.h>

#include "reyes/computed_default.h"
#include "reyes/rsl/machine/machine.h"
#include "reyes/shader/shadeops.h"
#include "tests/unit/rsl_machine/builder.h"
#include "tests/unit/rsl_machine/fake_grid.h"

namespace tomales::compiler {
namespace {

class Values : public ::testing::TestWithParam<int> {
 protected:
  int32_t output(std::vector<float> value = {-5}) {
    const Base base = value.size() == 3 ? Base::Color : Base::Float;
    return b.parameter("out" + std::to_string(b.code.parameters.size()), base, std::move(value), true);
  }
  void run() {
    fake.bind(b.code);
    if (given) given();
    const Program program(std::move(b.code));
    compiler::run(program, fake.grid);
  }
  static void expect(const rsl::Vec3& is, const rsl::Vec3& should) {
    EXPECT_EQ(is.x, should.x);
    EXPECT_EQ(is.y, should.y);
    EXPECT_EQ(is.z, should.z);
  }
  float out(size_t parameter, int i, int component = 0) const { return fake.output(parameter, component)[i]; }
  FakeGrid fake{20};
  Builder b;
  std::function<void()> given;
};

TEST_F(Values, OfASurfacesNAreItsOwn) {
  const int32_t N = b.global("N", Shape::Triple), o = output({0, 0, 0});
  b.copy(N, b.triple(1, 2, 3));
  b.copy(o, N);
  run();
  expect({out(0, 4), out(0, 4, 1), out(0, 4, 2)}, {1, 2, 3});
  expect(rsl::get(fake.grid.N, 4), {0, 0, -1});
}

TEST_F(Values, OfSomeGlobalsAreTheSameForAllPoints) {
  fake.grid.E[1] = 4;
  b.emit(Op::Print, {},
         {b.text("%f %f %f %p %f %f"), b.global("time", Shape::Number, false), b.global("dtime", Shape::Number, false),
          b.global("ncomps", Shape::Number, false), b.global("E", Shape::Triple, false),
          b.global("__near", Shape::Number, false), b.global("__far", Shape::Number, false)});
  std::fill_n(fake.active.begin(), 19, uint8_t{0});
  run();
  EXPECT_EQ(fake.printed,
            (std::vector<std::string>{"0.250000 0.500000 3.000000 0.000000 4.000000 0.000000 1.000000 100.000000"}));
}

TEST_F(Values, ComponentsOfAGlobalMayBeOneArray) {
  const float* const zero = fake.array();
  fake.grid.dPdtime = {zero, zero, zero};
  const int32_t o = output({1, 1, 1});
  b.copy(o, b.global("dPdtime", Shape::Triple));
  run();
  expect({out(0, 4), out(0, 4, 1), out(0, 4, 2)}, {0, 0, 0});
}

TEST_F(Values, ADisplacementMovesPointsThatAreActive) {
  b.code.kind = ShaderKind::Displacement;
  fake.active[2] = 0;
  const int32_t P = b.global("P", Shape::Triple), N = b.global("N", Shape::Triple);
  b.copy(P, b.value(Op::Add, {P, b.triple(0, 0, 10)}, Shape::Triple));
  b.copy(N, b.value(Op::CalculateNormal, {P}, Shape::Triple));
  run();
  expect(rsl::get(fake.grid.P, 1), {1, 2, 13});
  expect(rsl::get(fake.grid.P, 2), {2, 4, 3});
  expect(rsl::get(fake.grid.N, 1), {-1, -2, -13});
  expect(rsl::get(fake.grid.Ci, 1), FakeGrid::kBefore);
}

TEST_F(Values, AVolumeAndAnImagerChangeWhatIsThere) {
  for (const ShaderKind kind : {ShaderKind::Volume, ShaderKind::Imager}) {
    FakeGrid grid(5);
    Builder v(kind);
    const int32_t Ci = v.global("Ci", Shape::Triple);
    v.copy(Ci, v.value(Op::Mul, {Ci, v.number(2)}, Shape::Triple));
    if (kind == ShaderKind::Imager) {
      const int32_t alpha = v.global("alpha", Shape::Number);
      v.copy(alpha, v.value(Op::Add, {alpha, v.number(0.5f)}));
    }
    const Program program(std::move(v.code));
    compiler::run(program, grid.grid);
    expect(rsl::get(grid.grid.Ci, 1), {-14, -14, -14});
    expect(rsl::get(grid.grid.Oi, 1), FakeGrid::kBefore);
    EXPECT_EQ(grid.grid.alpha[1], kind == ShaderKind::Imager ? 0.625f : 0.125f);
  }
}

TEST_F(Values, ALightsLPointsFromTheLightAndIsStoredTowardsIt) {
  b.code.kind = ShaderKind::Light;
  const int32_t L = b.global("L", Shape::Triple), Cl = b.global("Cl", Shape::Triple),
                Ps = b.global("Ps", Shape::Triple);
  b.branch(b.value(Op::Less, {b.global("u", Shape::Number), b.number(0.5f)}), [&] {
    b.copy(L, b.value(Op::Sub, {Ps, b.triple(0, 0, 1)}, Shape::Triple));
    b.copy(Cl, b.number(3));
  });
  run();
  expect(rsl::get(fake.grid.L, 2), {-2, -4, -2});
  expect(rsl::get(fake.grid.Cl, 2), {3, 3, 3});
  expect(rsl::get(fake.grid.Cl, 12), {0, 0, 0});
}

TEST_F(Values, AnAreaLightsPAndNAreThoseOfTheLightAndItsLIsTheHosts) {
  b.code.kind = ShaderKind::Light;
  const TmVec3 Pl = fake.triples(), Nl = fake.triples();
  for (int i = 0; i < 20; ++i) {
    rsl::set(Pl, i, {9, 9, 9});
    rsl::set(Nl, i, {0, 1, 0});
    rsl::set(fake.grid.L, i, {0, 0, 4});
  }
  fake.grid.Pl = rsl::view(Pl);
  fake.grid.Nl = rsl::view(Nl);
  const int32_t P = output({0, 0, 0}), N = output({0, 0, 0}), Ps = output({0, 0, 0}), Ns = output({0, 0, 0}),
                along = output({0, 0, 0});
  const int32_t L = b.global("L", Shape::Triple);
  for (const auto& [to, name] : {std::pair(P, "P"), std::pair(N, "N"), std::pair(Ps, "Ps"), std::pair(Ns, "Ns")})
    b.copy(to, b.global(name, Shape::Triple));
  b.copy(along, L);
  b.copy(L, b.triple(7, 7, 7));
  run();
  EXPECT_EQ(out(0, 3), 9);
  EXPECT_EQ(out(1, 3, 1), 1);
  EXPECT_EQ(out(2, 3), 3);
  EXPECT_EQ(out(3, 3, 2), -1);
  EXPECT_EQ(out(4, 3, 2), -4);
  expect(rsl::get(fake.grid.L, 3), {0, 0, 4});
}

// --- Parameters

TEST_F(Values, ParametersAreUniformOrVaryingAndMayBeAssigned) {
  const int32_t a = b.parameter("a", Base::Float, {2}), v = b.parameter("v", Base::Color, {1, 2, 3}),
                w = b.parameter("w", Base::Float, {4});
  const int32_t first = output(), second = output({0, 0, 0}), third = output();
  given = [&] {
    float* const x = fake.array();
    for (int i = 0; i < 20; ++i) x[i] = static_cast<float>(i);
    fake.params[0].c[0] = x;
    fake.params[0].step = 1;
  };
  b.copy(first, a);
  b.copy(second, v);
  b.branch(b.value(Op::Less, {a, b.number(10)}), [&] { b.copy(w, a); });
  b.copy(third, w);
  run();
  EXPECT_EQ(fake.output(3)[7], 7);
  EXPECT_EQ(fake.output(4, 2)[7], 3);
  EXPECT_EQ(fake.output(5)[7], 7);
  EXPECT_EQ(fake.output(5)[17], 4);
  EXPECT_EQ(fake.params[0].c[0][3], 3) << "what is given stays";
}

TEST_F(Values, OutputsStartWithTheirDefault) {
  const int32_t color = output({1, 2, 3});
  (void)color;
  fake.active[1] = 0;
  run();
  expect({out(0, 0), out(0, 0, 1), out(0, 0, 2)}, {1, 2, 3});
  EXPECT_EQ(out(0, 1), 0) << "not active";
}

TEST_F(Values, OutputsThatNobodyWantsAreNotStored) {
  const int32_t o = output();
  b.copy(o, b.number(3));
  given = [&] { fake.params[0] = {}; };
  run();
}

TEST_F(Values, OfParametersMayBeArraysMatricesAndTexts) {
  std::vector<float> m(16);
  for (size_t k = 0; k < 16; ++k) m[k] = static_cast<float>(k);
  const int32_t f = b.parameter("f", Base::Float, {1, 2, 3}), c = b.parameter("c", Base::Color, {1, 2, 3, 4, 5, 6}),
                matrix = b.parameter("m", Base::Matrix, m), t = b.parameter("t", Base::String, {});
  b.code.registers[static_cast<size_t>(t)].length = 3;
  b.code.parameters.back().type.length = 2;
  b.code.parameters.back().texts = {"one", "two"};
  b.emit(Op::Print, {}, {b.text("%f|%c|%m|%s"), f, c, matrix, t});
  std::fill_n(fake.active.begin(), 19, uint8_t{0});
  run();
  EXPECT_EQ(
      fake.printed.at(0),
      "1.000000 2.000000 3.000000|1.000000 2.000000 3.000000 4.000000 5.000000 6.000000|0.000000 1.000000 2.000000 "
      "3.000000 4.000000 5.000000 "
      "6.000000 7.000000 8.000000 9.000000 10.000000 11.000000 12.000000 13.000000 14.000000 15.000000|one two two");
}

TEST_F(Values, TheMarkOfAComputedDefaultDiffersFromItself) {
  const int32_t a = b.parameter("a", Base::Float, {kComputedNumber}), o = output();
  b.branch(b.value(Op::NotEqual, {a, a}), [&] { b.copy(a, b.global("s", Shape::Number)); });
  b.copy(o, a);
  run();
  EXPECT_EQ(fake.output(1)[6], 6);
}

// --- Arrays

TEST_F(Values, ElementsAreHeldToTheArrayAndThatIsTold) {
  const int32_t array = b.numbers({10, 20, 30}), s = b.global("s", Shape::Number), o = output(), last = output();
  b.code.registers[static_cast<size_t>(array)].name = "knots";
  b.copy(o, b.value(Op::ElementF, {array, s}));
  b.copy(last, b.value(Op::ElementF, {array, b.number(-1)}));
  run();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(fake.output(0)[i], i == 0 ? 10 : i == 1 ? 20 : 30);
  EXPECT_EQ(fake.output(1)[3], 10);
  ASSERT_FALSE(fake.reports.empty());
  EXPECT_NE(fake.reports[0].find("\"knots\" of 3"), std::string::npos);
}

TEST_F(Values, WhoIsNotActiveMayAskForAnyElement) {
  const int32_t array = b.numbers({10, 20}), s = b.global("s", Shape::Number), o = output();
  b.branch(b.value(Op::Less, {s, b.number(2)}), [&] { b.copy(o, b.value(Op::ElementF, {array, s})); });
  run();
  EXPECT_TRUE(fake.reports.empty());
  EXPECT_EQ(fake.output(0)[1], 20);
}

TEST_F(Values, ArraysVaryAndAreCopiedWhole) {
  const int32_t a = b.variable(Shape::Triple, true, 2), c = b.variable(Shape::Triple, true, 2), o = output({0, 0, 0}),
                s = b.global("s", Shape::Number);
  b.copy(a, b.number(7));  // every element
  b.emit(Op::SetElement, {a}, {b.value(Op::Less, {s, b.number(5)}), b.triple(1, 2, 3)});
  b.branch(b.value(Op::Less, {s, b.number(10)}), [&] { b.copy(c, a); });
  b.copy(o, b.value(Op::ElementT, {c, b.number(1)}, Shape::Triple));
  run();
  expect({out(0, 4), out(0, 4, 1), out(0, 4, 2)}, {1, 2, 3});
  expect({out(0, 5), out(0, 5, 1), out(0, 5, 2)}, {7, 7, 7});
  expect({out(0, 10), out(0, 10, 1), out(0, 10, 2)}, {0, 0, 0});
}

TEST_F(Values, OfAnArrayMayBeMatrices) {
  const int32_t a = b.variable(Shape::Matrix, true, 2), o = output(), s = b.global("s", Shape::Number);
  b.emit(Op::SetElement, {a}, {b.number(1), b.value(Op::MatrixOf, {s}, Shape::Matrix)});
  b.copy(o, b.value(Op::MatrixElement,
                    {b.value(Op::ElementM, {a, b.number(1)}, Shape::Matrix), b.number(2), b.number(2)}));
  run();
  EXPECT_EQ(fake.output(0)[6], 6);
}

// --- Texts

TEST_F(Values, TextsAreComparedJoinedAndMatched) {
  const int32_t a = b.variable(Shape::Text), list = b.variable(Shape::Text, false, 2),
                o[] = {output(), output(), output()};
  b.emit(Op::Concat, {a}, {b.text("in"), b.text("side")});
  b.emit(Op::SetElement, {list}, {b.number(1), a});
  b.copy(o[0], b.value(Op::TextEqual, {b.value(Op::ElementS, {list, b.number(1)}, Shape::Text), b.text("inside")}));
  b.copy(o[1], b.value(Op::Match, {b.text("^in"), a}));
  b.copy(o[2], b.value(Op::Match, {b.text("^side"), a}));
  b.emit(Op::Print, {}, {b.text("%s"), b.value(Op::Format, {b.text("<%s %f>"), a, b.number(2)}, Shape::Text)});
  run();
  EXPECT_EQ(fake.output(0)[0], 1);
  EXPECT_EQ(fake.output(1)[0], 1);
  EXPECT_EQ(fake.output(2)[0], 0);
  EXPECT_EQ(fake.printed.at(0), "<inside 2.000000>");
}

// --- Colors and splines

TEST_F(Values, ColorsAreTransformedBetweenSpaces) {
  const int32_t o = output({0, 0, 0}), same = output({0, 0, 0});
  b.copy(o, b.value(Op::ColorTransform, {b.text("hsv"), b.text("rgb"), b.triple(0, 1, 0.5f)}, Shape::Triple, false));
  b.copy(same,
         b.value(Op::ColorTransform, {b.text("rgb"), b.text("hsv"), b.global("Cs", Shape::Triple)}, Shape::Triple));
  run();
  expect({out(0, 4), out(0, 4, 1), out(0, 4, 2)}, {0.5f, 0, 0});
  const rsl::Color hsv = rsl::hsvFromRgb({0.25f, 0.5f, 1});
  expect({out(1, 19), out(1, 19, 1), out(1, 19, 2)}, hsv);
}

TEST_F(Values, SplinesGoThroughTheirKnots) {
  const int32_t o[] = {output(), output(), output({0, 0, 0}), output()};
  const int32_t u = b.global("u", Shape::Number), linear = b.text("linear");
  const std::vector<float> knots = {0, 0, 10, 20, 30, 30};
  std::vector<int32_t> in{linear, u};
  for (const float k : knots) in.push_back(b.number(k));
  b.copy(o[0], b.value(Op::SplineF, in));
  b.copy(o[1], b.value(Op::SplineF, {linear, u, b.numbers(knots)}));
  const int32_t black = b.triple(0, 0, 0), white = b.triple(1, 2, 4);
  b.copy(o[2], b.value(Op::SplineT, {linear, u, black, black, white, white}, Shape::Triple));
  b.copy(o[3], b.value(Op::SplineF, {b.text("solvelinear"), b.value(Op::Mul, {u, b.number(30)}), b.numbers(knots)}));
  run();
  for (int i = 0; i < 20; ++i) {
    const float x = static_cast<float>(i) / 20;
    EXPECT_NEAR(fake.output(0)[i], 30 * x, 1e-5f);
    EXPECT_EQ(fake.output(0)[i], fake.output(1)[i]);
    EXPECT_NEAR(fake.output(2, 2)[i], 4 * x, 1e-6f);
    EXPECT_NEAR(fake.output(3)[i], x, 1e-6f);
  }
}

// --- Batches

TEST_P(Values, AreTheSameInBatchesOfAnySizeAndInSlotsThatTheCodeGives) {
  FakeGrid grid(GetParam());
  Builder v;
  const int32_t o = v.parameter("o", Base::Color, {0, 0, 0}, true), P = v.global("P", Shape::Triple),
                sum = v.variable(Shape::Triple), k = v.variable(Shape::Number, false);
  v.copy(k, v.number(2));
  v.copy(sum, v.value(Op::Mul, {P, v.value(Op::Add, {k, v.number(1)}, Shape::Number, false)}, Shape::Triple));
  v.copy(o, v.value(Op::Add, {sum, k}, Shape::Triple));
  v.code.registers[static_cast<size_t>(sum)].slot = 4;
  v.code.registers[static_cast<size_t>(k)].slot = 1;
  v.code.varyingFloats = 7;
  v.code.uniformFloats = 2;
  grid.bind(v.code);
  const Program program(std::move(v.code));
  compiler::run(program, grid.grid);
  for (int i = 0; i < GetParam(); ++i)
    expect({grid.output(0)[i], grid.output(0, 1)[i], grid.output(0, 2)[i]},
           3 * rsl::get(grid.grid.P, i) + rsl::Vec3{2, 2, 2});
  for (int i = GetParam(); i < grid.n; ++i) EXPECT_EQ(grid.output(0)[i], 0) << "beyond the batch";
}
INSTANTIATE_TEST_SUITE_P(Sizes, Values, ::testing::Values(1, 15, 16, 17, 256, 1000, 4096));

}  // namespace
}  // namespace tomales::compiler
