// Arguments and results of services; the surface and pictures.
#include "tests/unit/rsl_machine/services_fixture.h"

namespace tomales::compiler {
namespace {

TEST_F(Services, ObeyTheMask) {
  fake.active[3] = 0;
  const int32_t Ci = b.global("Ci", Shape::Triple);
  b.branch(where(0.5f), [&] { b.copy(Ci, b.value(Op::Ambient, {}, Shape::Triple)); });
  run();
  ASSERT_EQ(fake.masks.size(), 1u);
  for (int i = 0; i < 20; ++i) {
    const bool on = i < 10 && i != 3;
    EXPECT_EQ(fake.masks[0][static_cast<size_t>(i)], on);
    EXPECT_EQ(fake.grid.Ci.z[i], i == 3 ? -7 : on ? static_cast<float>(i) : 1.0f) << "Ci starts as Cs";
    EXPECT_EQ(fake.grid.Oi.y[i], i == 3 ? -7 : 0.5f) << "what is not assigned of Oi is Os";
  }
}

TEST_F(Services, LeaveZeroInTemporariesWhereNobodyIsActive) {
  const int32_t out = triple();
  int32_t light = -1;
  b.branch(where(0.5f), [&] { light = b.value(Op::Ambient, {}, Shape::Triple); });
  b.copy(out, light);
  run();
  expect(at(0, 9), {1, 2, 9});
  expect(at(0, 10), {0, 0, 0});
}

TEST_F(Services, TakeUniformArgumentsAsArrays) {
  const int32_t out = triple();
  b.copy(out, b.value(Op::Specular, {b.triple(1, 2, 3), b.global("N", Shape::Triple), b.number(0.5f)}, Shape::Triple));
  run();
  expect(at(0, 19), {1, 2, 2.5f});
}

TEST_F(Services, GiveAUniformRegisterTheFirstActivePointsValue) {
  fake.active[0] = 0;
  const int32_t out = triple(), one = b.variable(Shape::Triple, false);
  b.emit(Op::Ambient, {one}, {});
  b.copy(out, one);
  run();
  expect(at(0, 7), {1, 2, 1});
}

// --- The surface

TEST_F(Services, StepsAreDerivativesTimesTheSizeOfAMicropolygon) {
  const int32_t out = triple();
  b.branch(where(0.5f), [&] {});
  b.copy(out, b.value(Op::StepU, {b.global("P", Shape::Triple)}, Shape::Triple));
  const int32_t v = number();
  b.copy(v, b.value(Op::StepV, {b.global("s", Shape::Number)}));
  const int32_t none = number();
  b.copy(none, b.value(Op::StepV, {b.number(3)}));
  run();
  expect(at(0, 5), {5, 10, 3});
  EXPECT_EQ(fake.output(1)[5], 5 * 8 * 0.5f);
  EXPECT_EQ(fake.output(2)[5], 0);
}

TEST_F(Services, TransformBetweenSpacesAndGiveTheirMatrices) {
  const int32_t out = triple(), by = triple(), normal = triple();
  const int32_t P = b.global("P", Shape::Triple), current = b.text("current"), world = b.text("world");
  b.copy(out, b.value(Op::TransformSpace, {current, world, P}, Shape::Triple));
  const int32_t m = b.value(Op::SpaceMatrix, {current, world}, Shape::Matrix, false);
  b.emit(Op::Print, {}, {b.text("%m"), m});
  b.copy(by, b.value(Op::CalculateNormal, {P}, Shape::Triple));
  b.emit(Op::TransformSpace, {normal}, {current, world, P}, TM_AS_VECTOR);
  run();
  expect(at(0, 2), {5, 10, 9});
  expect(at(1, 2), {-2, -4, -3});
  expect(at(2, 2), {4, 8, 6});
  EXPECT_EQ(
      fake.printed.at(0),
      "2.000000 0.000000 0.000000 0.000000 0.000000 2.000000 0.000000 0.000000 0.000000 0.000000 2.000000 0.000000 "
      "1.000000 2.000000 3.000000 1.000000");
  EXPECT_TRUE(fake.reports.empty());
}

TEST_F(Services, RandomNumbersDifferFromPointToPointAndCallToCall) {
  const int32_t a = number(), c = triple();
  b.emit(Op::RandomF, {a}, {});
  b.emit(Op::RandomT, {c}, {});
  run();
  std::vector<float> all;
  for (int i = 0; i < 20; ++i) all.insert(all.end(), {fake.output(0)[i], at(1, i).x, at(1, i).y, at(1, i).z});
  for (const float x : all) EXPECT_TRUE(x >= 0 && x < 1);
  std::sort(all.begin(), all.end());
  EXPECT_EQ(std::unique(all.begin(), all.end()), all.end());
}

// --- Pictures

TEST_F(Services, TexturesHaveAChannelARegionAndAList) {
  const int32_t out = triple(), s = b.global("s", Shape::Number), t = b.global("t", Shape::Number);
  const std::vector<Setting> list = {setting("blur", b.number(0.25f)), setting("filter", b.text("gaussian")),
                                     setting("width", b.text("wide")), setting("nothing", b.number(1))};
  b.emit(Op::TextureT, {out}, {b.text("a.tex"), b.number(2), s, t, -1, -1, -1, -1}).settings = list;
  run();
  expect(at(0, 4), {4, -4, 2});
  EXPECT_EQ(fake.asked, "a.tex");
  EXPECT_EQ(fake.textureOptions.sblur, 0.25f);
  EXPECT_EQ(fake.filter, "gaussian");
  EXPECT_EQ(fake.textureOptions.region[0], nullptr);
  EXPECT_TRUE(reported("\"nothing\", which is unknown"));
  EXPECT_TRUE(reported("\"width\" that has a value of another type"));
}

TEST_F(Services, LookUpOneChannelOfATextureOverARegion) {
  const int32_t one = number(), u = b.global("u", Shape::Number);
  b.emit(Op::TextureF, {one}, {b.text("a.tex"), b.number(1), u, u, u, b.number(2), u, u});
  bool right = false;
  static bool* seen;
  seen = &right;
  fake.services.texture = [](void*, const TmGrid*, const char*, const TmTextureOptions* o, const float*, const float*,
                             TmVec3 out) -> int32_t {
    *seen = out.y == nullptr && o->channel == 1 && o->region[0][10] == 0.5f && o->region[1][19] == 2;
    return 1;
  };
  run();
  EXPECT_TRUE(right);
}

TEST_F(Services, LookUpEnvironmentsAndTellOfPictures) {
  const int32_t out = triple(), told = number(), size = b.variable(Shape::Number, false, 2), second = number(),
                wrong = number();
  b.emit(Op::EnvironmentT, {out}, {b.text("sky"), b.number(0), b.triple(1, 2, 3), b.number(0.5f)});
  b.emit(Op::TextureInfo, {told}, {b.text("a.tex"), b.text("resolution")}).settings = {setting("", size, true)};
  b.copy(second, b.value(Op::ElementF, {size, b.number(1)}, Shape::Number, false));
  const int32_t kind = b.variable(Shape::Text);
  b.emit(Op::TextureInfo, {wrong}, {b.text("a.tex"), b.text("resolution")}).settings = {setting("", kind, true)};
  run();
  expect(at(0, 4), {1, 2, 3});
  EXPECT_NE(fake.textureOptions.angle, nullptr);
  EXPECT_EQ(fake.output(1)[0], 1);
  EXPECT_EQ(fake.output(2)[0], 480);
  EXPECT_EQ(fake.output(3)[0], 0) << "numbers are no text";
}

}  // namespace
}  // namespace tomales::compiler
