// Rays and point clouds.
#include "tests/unit/rsl_machine/services_fixture.h"

namespace tomales::compiler {
namespace {

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

TEST_F(Services, NoSamplesOfAHemisphereLeaveTheirNumberToTheList) {
  const int32_t covered = number(), P = b.global("P", Shape::Triple), N = b.global("N", Shape::Triple);
  b.emit(Op::Occlusion, {covered}, {P, N, b.number(0)}).settings = {setting("samples", b.number(7))};
  run();
  EXPECT_EQ(fake.rayOptions.samples, 7);
}

TEST_F(Services, AHemisphereWhoseSamplesNobodyGivesHasThoseOfALight) {
  const int32_t covered = number(), P = b.global("P", Shape::Triple), N = b.global("N", Shape::Triple);
  b.emit(Op::Occlusion, {covered}, {P, N, b.number(0)}).settings = {setting("samples", b.number(0))};
  run();
  EXPECT_EQ(fake.rayOptions.samples, 64);
}

TEST_F(Services, GatherRunsOneBodyForHitsAndTheOtherForMisses) {
  const int32_t hits = number(), misses = number(), color = triple(), value = number(),
                P = b.global("P", Shape::Triple);
  b.copy(hits, b.number(0));
  b.copy(misses, b.number(0));
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
  EXPECT_TRUE(reported("\"nonsense\", which is unknown"));
}

TEST_F(Services, WhoHasLeftIsGatheredNoMoreAndTheMaskOfTheQuestionStays) {
  const int32_t rounds = number(), P = b.global("P", Shape::Triple), label = b.label();
  b.copy(rounds, b.number(0));
  const Builder::Body count = [&] {
    b.copy(rounds, b.value(Op::Add, {rounds, b.number(1)}));
    b.branch(where(0.5f), [&] { b.leave(label); });
  };
  b.scope(label, [&] { b.nest(Op::Gather, {b.text(""), P, P, b.number(1), b.number(4)}, 0, {count, count}); });
  run();
  EXPECT_EQ(fake.output(0)[3], 1);
  EXPECT_EQ(fake.output(0)[13], 4);
  ASSERT_EQ(fake.masks.size(), 5u);
  for (const auto& mask : fake.masks) EXPECT_EQ(mask, fake.masks[0]);
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

TEST_F(Services, FindPhotonsCausticsAndLightUnderTheSurface) {
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

}  // namespace
}  // namespace tomales::compiler
