// What instructions ask of the renderer, and what comes back into registers.
#include <gtest/gtest.h>

#include "reyes/rsl/machine/machine.h"
#include "tests/unit/rsl_machine/builder.h"
#include "tests/unit/rsl_machine/fake_grid.h"

namespace tomales::compiler {
namespace {

/// A code with outputs, to look at what registers hold.
class Services : public ::testing::Test {
 protected:
  int32_t number() { return b.parameter("out" + std::to_string(b.code.parameters.size()), Base::Float, {-5}, true); }
  int32_t triple() {
    return b.parameter("out" + std::to_string(b.code.parameters.size()), Base::Color, {-5, -5, -5}, true);
  }
  void run() {
    fake.bind(b.code);
    const Program program(std::move(b.code));
    compiler::run(program, fake.grid);
  }
  rsl::Vec3 at(size_t output, int i) const {
    return {fake.output(output)[i], fake.output(output, 1)[i], fake.output(output, 2)[i]};
  }
  void expect(const rsl::Vec3& is, const rsl::Vec3& should) {
    EXPECT_EQ(is.x, should.x);
    EXPECT_EQ(is.y, should.y);
    EXPECT_EQ(is.z, should.z);
  }
  int32_t where(float u) { return b.value(Op::Less, {b.global("u", Shape::Number), b.number(u)}); }
  Setting setting(const std::string& name, int32_t value, bool fills = false, Base base = Base::Float) {
    return {b.text(name), value, fills, base};
  }
  bool reported(const std::string& what) const {
    return std::any_of(fake.reports.begin(), fake.reports.end(),
                       [&](const std::string& r) { return r.find(what) != std::string::npos; });
  }
  FakeGrid fake{20};
  Builder b;
};

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

// --- Light

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
  loop({b.text("key"), place, b.triple(0, 0, 1), b.global("u", Shape::Number)},
       [&] { b.copy(place, b.number(7)), b.copy(out, place); });
  bool moved = false;
  const auto ask = fake.services.illuminance;
  static std::remove_const_t<decltype(ask)> inner;
  static bool* wrong;
  inner = ask, wrong = &moved;
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
  EXPECT_TRUE(reported("\"nonsense\", which there is not"));
}

TEST_F(Services, ConesOfLightAreSampledEvenly) {
  const int32_t out = triple();
  float *const x = fake.array(), *const y = fake.array();
  x[0] = 0, x[1] = 1, x[2] = 1, y[2] = 0.25f;
  fake.grid.xi0 = x, fake.grid.xi1 = y;
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

TEST_F(Services, SpacesAndTheirMatrices) {
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
  EXPECT_STREQ(fake.textureOptions.filter, "gaussian");
  EXPECT_EQ(fake.textureOptions.region[0], nullptr);
  EXPECT_TRUE(reported("\"nothing\", which there is not"));
  EXPECT_TRUE(reported("\"width\" that has a value of another type"));
}

TEST_F(Services, TexturesOfOneChannelOverARegion) {
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

TEST_F(Services, EnvironmentsAndWhatIsKnownOfPictures) {
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

// --- Rays

TEST_F(Services, RaysTakeTheirLists) {
  const int32_t color = triple(), far = number(), through = triple(), P = b.global("P", Shape::Triple);
  b.emit(Op::Trace, {color}, {P, b.triple(0, 0, 2)}).settings = {setting("samples", b.number(9)),
                                                                 setting("raydepth", b.number(2))};
  b.emit(Op::TraceDistance, {far}, {P, b.triple(0, 0, 2)});
  b.emit(Op::Transmission, {through}, {P, b.triple(0, 0, 2)}).settings = {setting("samplecone", b.number(0.1f))};
  run();
  expect(at(0, 1), {1, 2, 5});
  EXPECT_EQ(fake.output(1)[1], 2);
  expect(at(2, 1), {-1, -2, -1});
  EXPECT_EQ(fake.rayOptions.coneAngle, 0.1f);
  EXPECT_TRUE(reported("\"raydepth\" has no effect"));
}

TEST_F(Services, TheHemisphereGivesWhatIsCoveredAndWhatArrives) {
  const int32_t covered = number(), light = triple(), direction = triple(), P = b.global("P", Shape::Triple),
                N = b.global("N", Shape::Triple);
  b.emit(Op::Occlusion, {covered}, {P, N, b.number(16)}).settings = {
      setting("environmentdir", direction, true, Base::Vector), setting("maxvariation", b.number(0.125f))};
  b.branch(where(0.5f), [&] {
    b.emit(Op::IndirectDiffuse, {light}, {P, N, -1}).settings = {setting("samples", b.number(4))};
  });
  run();
  EXPECT_EQ(fake.output(0)[2], 0.5f);
  expect(at(1, 2), {0, 0, -1});
  expect(at(1, 12), {-5, -5, -5});
  expect(at(2, 2), {0, 1, 0});
  EXPECT_EQ(fake.rayOptions.samples, 4);
}

TEST_F(Services, GatherRunsOneBodyForHitsAndTheOtherForMisses) {
  const int32_t hits = number(), misses = number(), color = triple(), value = number(),
                P = b.global("P", Shape::Triple);
  b.copy(hits, b.number(0)), b.copy(misses, b.number(0));
  const auto more = [&](int32_t to) { return [&, to] { b.copy(to, b.value(Op::Add, {to, b.number(1)})); }; };
  b.branch(where(0.5f), [&] {
    b.nest(Op::Gather, {b.text("samplepattern"), P, b.triple(0, 0, 1), b.number(0.5f), b.number(3)}, 0,
           {more(hits), more(misses)}, {},
           {setting("surface:Ci", color, true, Base::Color), setting("ray:length", value, true),
            setting("bias", b.number(0.25f)), setting("nonsense", b.number(0))});
  });
  run();
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(fake.output(0)[i], i % 2 == 0 ? 2 : 1);
    EXPECT_EQ(fake.output(1)[i], i % 2 == 0 ? 1 : 2);
    EXPECT_EQ(fake.output(3)[i], i % 2 == 0 ? 20 + static_cast<float>(i) : 10 + static_cast<float>(i))
        << "of the last hit";
  }
  EXPECT_EQ(fake.output(0)[10], 0);
  expect(at(2, 3), {1, 2, 3});
  EXPECT_EQ(fake.channels, (std::vector<std::string>{"surface:Ci", "ray:length"}));
  EXPECT_EQ(fake.rayOptions.maxDistance, 0);
  EXPECT_EQ(fake.rayOptions.uniform, 1);
  EXPECT_EQ(fake.rayOptions.bias, 0.25f);
  EXPECT_TRUE(reported("\"nonsense\", which there is not"));
}

TEST_F(Services, GatherOfAnUnknownCategoryIsReported) {
  const int32_t hits = number(), P = b.global("P", Shape::Triple);
  b.nest(Op::Gather, {b.text("pointless"), P, P, b.number(1), b.number(1)}, 0,
         {[&] { b.copy(hits, b.number(1)); }, [] {}});
  run();
  EXPECT_TRUE(reported("gathers \"pointless\""));
  EXPECT_EQ(fake.output(0)[0], -5);
}

// --- Point clouds

TEST_F(Services, CloudsTakeChannelsByTheNamesThatAreNoOptions) {
  const int32_t told = number(), found = number(), value = number(), P = b.global("P", Shape::Triple),
                N = b.global("N", Shape::Triple);
  b.emit(Op::Bake3d, {told}, {b.text("a.ptc"), b.text(""), P, N}).settings = {
      setting("radius", b.number(2)), setting("_area", b.number(5)), setting("_light", b.triple(4, 0, 0)),
      setting("interpolate", b.number(1))};
  b.emit(Op::Texture3d, {found}, {b.text("b.ptc"), P, N}).settings = {setting("_area", value, true)};
  run();
  EXPECT_EQ(fake.output(0)[0], 1);
  EXPECT_EQ(fake.channels, (std::vector<std::string>{"_area 1 5.000000", "_light 3 4.000000", "radius 2.000000"}));
  EXPECT_EQ(fake.output(1)[2], 1);
  EXPECT_EQ(fake.output(1)[3], 0);
  EXPECT_EQ(fake.output(2)[2], 5);
  EXPECT_EQ(fake.output(2)[3], -5);
  EXPECT_TRUE(reported("\"interpolate\" has no effect"));
}

TEST_F(Services, PhotonsCausticsAndSubsurface) {
  const int32_t map = triple(), caustic = triple(), below = triple(), P = b.global("P", Shape::Triple),
                N = b.global("N", Shape::Triple);
  b.emit(Op::PhotonMap, {map}, {b.text("p.ptc"), P, N}).settings = {setting("estimator", b.number(7))};
  b.emit(Op::Caustic, {caustic}, {P, N});
  b.emit(Op::Subsurface, {below}, {b.text("s.ptc"), P, N}).settings = {
      setting("scattering", b.triple(2, 3, 4), false, Base::Color)};
  run();
  expect(at(0, 0), {7, 0, 0});
  expect(at(1, 0), {0, 0, 0});
  expect(at(2, 0), {2, 1.3f, 0});
  EXPECT_EQ(fake.asked, "s.ptc");
}

// --- Messages

TEST_F(Services, AskFillsWhatFitsAndLeavesTheRest) {
  const int32_t told[] = {number(), number(), number(), number()}, n = number(), c = triple(),
                text = b.variable(Shape::Text), same = number(), m = b.variable(Shape::Matrix);
  fake.answers["6:user:size"] = {TM_FLOAT, {3}, ""};
  fake.answers["6:Ri:Color"] = {TM_COLOR, {1, 2, 3}, ""};
  fake.answers["6:identifier:name"] = {TM_STRING, {}, "thing"};
  const auto ask = [&](int32_t out, const char* name, int32_t value) {
    b.emit(Op::Ask, {out}, {b.text(name)}, TM_OF_ATTRIBUTES).settings = {setting("", value, true)};
  };
  b.branch(where(0.5f), [&] { ask(told[0], "user:size", n), ask(told[1], "Ri:Color", c); });
  ask(told[2], "user:size", c);
  ask(told[3], "identifier:name", text);
  b.copy(same, b.value(Op::TextEqual, {text, b.text("thing")}));
  ask(told[0], "user:size", m);
  run();
  EXPECT_EQ(fake.output(4)[3], 3);
  EXPECT_EQ(fake.output(4)[13], -5);
  expect(at(5, 3), {1, 2, 3});
  expect(at(5, 13), {-5, -5, -5});
  EXPECT_EQ(fake.output(1)[3], 1);
  EXPECT_EQ(fake.output(1)[13], -5) << "not asked";
  EXPECT_EQ(fake.output(2)[3], 0) << "a number is no color";
  EXPECT_EQ(fake.output(3)[3], 1);
  EXPECT_EQ(fake.output(6)[3], 1);
}

TEST_F(Services, TheRayThatCame) {
  const int32_t told = number(), type = number(), origin = triple(), kind = b.variable(Shape::Text),
                label = b.variable(Shape::Text), no = number();
  b.emit(Op::RayInfo, {told}, {b.text("type")}).settings = {setting("", type, true)};
  b.emit(Op::RayInfo, {told}, {b.text("origin")}).settings = {setting("", origin, true)};
  b.emit(Op::RayInfo, {told}, {b.text("type")}).settings = {setting("", kind, true)};
  b.emit(Op::RayInfo, {no}, {b.text("weather")}).settings = {setting("", origin, true)};
  b.emit(Op::RayLabel, {label}, {});
  b.emit(Op::Print, {}, {b.text("%s %s"), kind, label});
  run();
  EXPECT_EQ(fake.output(0)[0], 1);
  EXPECT_EQ(fake.output(1)[0], 2);
  expect(at(2, 0), {2, 5, 6});
  EXPECT_EQ(fake.output(3)[0], 0);
  EXPECT_EQ(fake.printed.at(0), "specular mirror");
}

TEST_F(Services, TheNameOfAnotherShader) {
  fake.answers["1:__shadername"] = {TM_STRING, {}, "bumpy"};
  const int32_t name = b.variable(Shape::Text), none = b.variable(Shape::Text);
  b.emit(Op::ShaderName, {name}, {b.text("displacement")});
  b.emit(Op::ShaderName, {none}, {b.text("weather")});
  b.emit(Op::Print, {}, {b.text("<%s> <%s>"), name, none});
  run();
  EXPECT_EQ(fake.printed.at(0), "<bumpy> <>");
}

TEST_F(Services, PrintWritesALineForEachActivePoint) {
  const int32_t s = b.global("s", Shape::Number);
  b.branch(where(0.1f), [&] {
    b.emit(Op::Print, {}, {b.text("%f of %d: %c %%"), s, b.number(20), b.triple(1, 2, 3)});
  });
  b.emit(Op::Report, {}, {b.text("calls f(), which there is not")});
  run();
  EXPECT_EQ(fake.printed, (std::vector<std::string>{"0.000000 of 20: 1.000000 2.000000 3.000000 %",
                                                    "1.000000 of 20: 1.000000 2.000000 3.000000 %"}));
  EXPECT_TRUE(reported("calls f()"));
}

}  // namespace
}  // namespace tomales::compiler
