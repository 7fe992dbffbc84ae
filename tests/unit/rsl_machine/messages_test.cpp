// What shaders ask of each other and of the ray that came; what they print.
#include "tests/unit/rsl_machine/services_fixture.h"

namespace tomales::compiler {
namespace {

TEST_F(Services, AskFillsWhatFitsAndLeavesTheRest) {
  const int32_t told[] = {number(), number(), number(), number()}, n = number(), c = triple(),
                text = b.variable(Shape::Text), same = number(), m = b.variable(Shape::Matrix);
  fake.answers["6:user:size"] = {TM_FLOAT, {3}, ""};
  fake.answers["6:Ri:Color"] = {TM_COLOR, {1, 2, 3}, ""};
  fake.answers["6:identifier:name"] = {TM_STRING, {}, "thing"};
  const auto ask = [&](int32_t out, const char* name, int32_t value) {
    b.emit(Op::Ask, {out}, {b.text(name)}, TM_OF_ATTRIBUTES).settings = {setting("", value, true)};
  };
  b.branch(where(0.5f), [&] {
    ask(told[0], "user:size", n);
    ask(told[1], "Ri:Color", c);
  });
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

TEST_F(Services, TellOfTheRayThatCame) {
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

TEST_F(Services, TellTheNameOfAnotherShader) {
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
  b.emit(Op::Report, {}, {b.text("calls f(), which is unknown")});
  run();
  EXPECT_EQ(fake.printed, (std::vector<std::string>{"0.000000 of 20: 1.000000 2.000000 3.000000 %",
                                                    "1.000000 of 20: 1.000000 2.000000 3.000000 %"}));
  EXPECT_TRUE(reported("calls f()"));
}

}  // namespace
}  // namespace tomales::compiler
