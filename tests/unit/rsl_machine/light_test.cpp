// Light: loops over its samples, cones, shadows, the scale of highlights.
#include <cmath>

#include "tests/unit/rsl_machine/services_fixture.h"

namespace tomales::compiler {
namespace {

class IlluminanceTest : public Services {
 protected:
  IlluminanceTest() {
    fake.lights = {{[](int i) { return i % 2 == 0; }, {0, 0, 5}, {1, 0, 0}, 0.5f},
                   {[](int) { return true; }, {0, 3, 0}, {0, 1, 0}, 0.25f}};
  }
  void loop(std::vector<int32_t> in, const Builder::Body& body, std::vector<Setting> settings = {}) {
    b.nest(Op::Illuminance, std::move(in), 0, {body}, {L, Cl}, std::move(settings));
  }
  int32_t L = b.global("L", Shape::Triple), Cl = b.global("Cl", Shape::Triple), P = b.global("P", Shape::Triple);
};

TEST_F(IlluminanceTest, RunsItsBodyForThePointsThatASampleReaches) {
  const int32_t sum = triple();
  b.copy(sum, b.number(0));
  b.branch(where(0.5f), [&] {
    loop({-1, P, -1, -1}, [&] {
      b.copy(sum, b.value(Op::Add, {sum, b.value(Op::Add, {L, Cl}, Shape::Triple)}, Shape::Triple));
    });
  });
  run();
  expect(at(0, 4), {1, 4, 5});
  expect(at(0, 5), {0, 4, 0});
  expect(at(0, 10), {0, 0, 0});
  EXPECT_FALSE(fake.hasP) << "the shaded points themselves";
}

TEST_F(IlluminanceTest, AsksElsewhereWithACopyOfThePlace) {
  const int32_t place = b.variable(Shape::Triple), out = triple();
  b.copy(place, b.triple(1, 1, 1));
  loop({b.text("key"), place, b.triple(0, 0, 1), b.global("u", Shape::Number)}, [&] {
    b.copy(place, b.number(7));
    b.copy(out, place);
  });
  bool moved = false;
  const auto ask = fake.services.illuminance;
  static std::remove_const_t<decltype(ask)> inner;
  static bool* wrong;
  inner = ask;
  wrong = &moved;
  fake.services.illuminance = [](void* h, const TmGrid* g, TmIlluminance* q) -> int32_t {
    *wrong |= std::string_view(q->category) != "key" || q->P.x[2] != 1 || q->axis.z[3] != 1 || q->angles[10] != 0.5f;
    return inner(h, g, q);
  };
  run();
  EXPECT_FALSE(moved);
  expect(at(0, 0), {7, 7, 7});
}

TEST_F(IlluminanceTest, WhoHasLeftIsNotLitAgainAndTheMaskOfTheQuestionStays) {
  const int32_t rounds = number(), label = b.label();
  b.copy(rounds, b.number(0));
  b.scope(label, [&] {
    loop({-1, P, -1, -1}, [&] {
      b.copy(rounds, b.value(Op::Add, {rounds, b.number(1)}));
      b.branch(where(0.25f), [&] { b.leave(label); });
    });
    b.copy(rounds, b.value(Op::Add, {rounds, b.number(10)}));
  });
  run();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(fake.output(0)[i], i < 5 ? 1 : i % 2 == 0 ? 12 : 11) << i;
  ASSERT_EQ(fake.masks.size(), 3u);
  EXPECT_EQ(fake.masks[0], fake.masks[1]);
  EXPECT_EQ(fake.masks[0], fake.masks[2]);
}

TEST_F(IlluminanceTest, ListsSendAndAskAndTheBodyAsksTheLight) {
  const int32_t listed = number(), asked = number(), told = number(), outside = number();
  fake.answers["5:shared"] = {TM_FLOAT, {7}, ""};
  loop({-1, P, -1, -1},
       [&] {
         Instruction& i = b.emit(Op::Ask, {told}, {b.text("dimmed")}, TM_OF_LIGHT);
         i.settings = {setting("", asked, true)};
       },
       {setting("lightcache", b.text("refresh")), setting("send:light:power", b.number(3)),
        setting("light:dimmed", listed, true), setting("nonsense", b.number(1))});
  b.emit(Op::Ask, {outside}, {b.text("dimmed")}, TM_OF_LIGHT).settings = {setting("", asked, true)};
  run();
  EXPECT_EQ(fake.output(0)[3], 0.25f);
  EXPECT_EQ(fake.output(1)[3], 0.25f);
  EXPECT_EQ(fake.output(2)[3], 1);
  EXPECT_EQ(fake.output(3)[3], 0) << "no light outside of the loop";
  ASSERT_EQ(fake.sent.size(), 1u);
  EXPECT_EQ(fake.sent[0], (std::pair<std::string, float>("power", 3)));
  EXPECT_TRUE(reported("\"nonsense\", which is unknown"));
}

TEST_F(Services, ConesOfLightAreSampledEvenly) {
  const int32_t out = triple();
  float *const x = fake.array(), *const y = fake.array();
  x[0] = 0;
  x[1] = 1;
  x[2] = 1;
  y[2] = 0.25f;
  fake.grid.xi0 = x;
  fake.grid.xi1 = y;
  b.copy(out, b.value(Op::ConeLight, {b.triple(0, 0, 2), b.number(1)}, Shape::Triple));
  run();
  expect(at(0, 0), {0, 0, 1});
  const rsl::Vec3 a = at(0, 1), c = at(0, 2);
  EXPECT_NEAR(a.z, std::cos(1.0f), 1e-6f);
  EXPECT_NEAR(rsl::length(a), 1, 1e-6f);
  EXPECT_NEAR(a.x * c.x + a.y * c.y, 0, 1e-6f) << "a quarter turn";
}

TEST_F(Services, ShadowsTakeTheirList) {
  const int32_t out = triple(), from = b.temporary(Shape::Triple);
  b.emit(Op::Shadow, {from}, {b.text("map"), b.global("P", Shape::Triple)}).settings = {
      setting("bias", b.number(0.5f)), setting("blur", b.global("u", Shape::Number))};
  b.copy(out, from);
  fake.active[0] = 0;
  run();
  expect(at(0, 3), {3, 0.5f, 0.05f});
  EXPECT_EQ(fake.asked, "map");
  EXPECT_TRUE(reported("\"blur\" that may differ from point to point"));
}

TEST_F(Services, TheHighlightsScaleIsTheOptions) {
  const int32_t out = number();
  fake.answers["7:shade:specular"] = {TM_STRING, {}, "rispec"};
  b.emit(Op::SpecularScale, {out}, {});
  run();
  EXPECT_EQ(fake.output(0)[3], 1);
}

}  // namespace
}  // namespace tomales::compiler
