#include <gtest/gtest.h>

#include "reyes/output.h"

namespace tomales {
namespace {

Param text(const std::string& name, const std::string& value) {
  Param p;
  p.name = name;
  p.type = ValueType::String;
  p.strings = {value};
  return p;
}

Options showing(const std::string& mode, ParamList params = {}) {
  Options o;
  o.displays.push_back({"a.exr", "openexr", mode, std::move(params), {}});
  return o;
}

std::string names(const Options& o, Log& log) {
  const FrameOutput output = outputOf(o, &log);
  std::string out;
  for (const SelectedFloat& f : output.displays.at(0)) out += f.name + " ";
  return out;
}

class Output : public testing::Test {
 protected:
  Log log{Log::Verbosity::Quiet};
};

TEST_F(Output, LettersAndNamesSelectTheSamePicture) {
  EXPECT_EQ(names(showing("rgbaz"), log), "R G B A Z ");
  EXPECT_EQ(names(showing("Ci,a,z"), log), "R G B A Z ");
  EXPECT_EQ(names(showing("b"), log), "B ");
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(Output, ListsMayHaveLettersOfColourAndOpacity) {
  EXPECT_EQ(names(showing("rgba,N"), log), "R G B A N.X N.Y N.Z ");
  EXPECT_EQ(names(showing("s,rgb"), log), "s R G B ");
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(Output, AChannelThatIsSpelledOfLettersIsTheChannel) {
  Options o = showing("bar");
  EXPECT_EQ(names(o, log), "B A R ");
  o.channels["bar"] = {"bar", ValueType::Float, {}, {}};
  EXPECT_EQ(names(o, log), "bar ");
}

TEST_F(Output, AChannelOfOneLetterIsTheChannelAndNoLetterOfAMode) {
  Options o = showing("r");
  o.channels["r"] = {"r", ValueType::Color, {}, {}};
  EXPECT_EQ(names(o, log), "r.R r.G r.B ");
  for (const auto& [mode, wanted] : {std::pair("rgba", "R G B A "), std::pair("Ci,a,r", "R G B A r.R r.G r.B "),
                                     std::pair("g,b", "G B "), std::pair("rgb,r", "R G B r.R r.G r.B ")}) {
    o.displays[0].mode = mode;
    EXPECT_EQ(names(o, log), wanted) << mode;
  }
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(Output, ColoursHaveComponentsRgbAndVectorsXyz) {
  EXPECT_EQ(names(showing("Ci,N,s,albedo"), log), "R G B N.X N.Y N.Z s albedo.R albedo.G albedo.B ");
}

TEST_F(Output, WhatIsNotDeclaredIsLeftOutWithAWarning) {
  EXPECT_EQ(names(showing("Ci,sparkle"), log), "R G B ");
  EXPECT_EQ(log.count("display-channel"), 1);
  EXPECT_EQ(names(showing("sparkle"), log), "R G B A ");
}

TEST_F(Output, AVariableIsStoredOnceHoweverManyDisplaysShowIt) {
  Options o = showing("N");
  o.displays.push_back({"b.exr", "openexr", "N,u", {text("filter", "zmin")}, {}});
  const FrameOutput output = outputOf(o);
  EXPECT_EQ(output.floatsPerPoint, 4);    // N and u
  EXPECT_EQ(output.channels.size(), 6u);  // Ci a z, N filtered, N and u of the nearest
  EXPECT_EQ(output.floatsPerPixel, 5 + 3 + 3 + 1);
}

TEST_F(Output, ADisplayChannelSaysHowItIsSampledAndTheDisplayHasTheLastWord) {
  Options o = showing("mine", {text("filter", "box")});
  Param width;
  width.name = "filterwidth";
  width.floats = {3, 1};
  o.channels["mine"] = {"mine", ValueType::Float, {text("filter", "triangle"), width, text("source", "s")}, {}};
  const FrameOutput output = outputOf(o);
  EXPECT_EQ(output.channels.back().sampling, (Sampling{Reduce::Filter, "box", 3, 1}));
  EXPECT_EQ(output.variables.at(0).source, "s");
}

TEST_F(Output, FramesThatWantDepthAloneNeedNoShader) {
  Options o = showing("z");
  EXPECT_FALSE(outputOf(o).shades);
  o.displays.push_back({"b.exr", "openexr", "rgb", {}, {}});
  EXPECT_TRUE(outputOf(o).shades);
}

}  // namespace
}  // namespace tomales
