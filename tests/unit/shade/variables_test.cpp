// Tests the variables that Displays ask of a surface beside Ci and Oi.
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

class Variables : public Stage {
 protected:
  void show(const std::string& mode) { scene.options.displays.push_back({"a.exr", "openexr", mode, {}, {}}); }
  void channel(const std::string& name, const std::string& source) {
    scene.options.channels[name] = {name, ValueType::Color, {text("source", source)}, at(3)};
  }
  ShadedPoints shadeStored() {
    ShadeContext context;
    context.variables = true;
    return shade(points({vec3(0, 0, 5), vec3(1, 0, 5)}), context);
  }
  /// Variable number k of the list, the three floats of a point.
  static vec3 stored(const ShadedPoints& s, int k, size_t point = 1) {
    const auto at = [&](int c) { return s.variables.at(static_cast<size_t>(3 * k + c))[point]; };
    return {at(0), at(1), at(2)};
  }
};

TEST_F(Variables, TheOutputsOfPlasticAddUpToItsColour) {
  attributes.color = {0.5f, 0.25f, 1};
  attributes.opacity = vec3(0.75f);
  surface("plastic", {number("roughness", 1)});
  light("ambientlight", {number("intensity", 0.3f)});
  light("pointlight", {point("from", {1, 2, 0}), number("intensity", 9)});
  light("indirectlight");
  services.E = {0.2f, 0.4f, 0.1f};
  for (const char* name : {"ambient", "diffuse", "specular", "indirectdiffuse"})
    scene.options.channels[name] = {name, ValueType::Color, {}, at(3)};
  show("ambient,diffuse,specular,indirectdiffuse");
  const ShadedPoints out = shadeStored();
  vec3 sum(0.0f);
  for (int k = 0; k < 4; ++k) {
    EXPECT_GT(stored(out, k).x, 0) << k;
    sum += stored(out, k);
  }
  expectColor(sum, out.color(1));
  expectColor(stored(out, 3), 0.75f * 0.5f * attributes.color * services.E);  // Os Cs Kd E
}

TEST_F(Variables, LightGroupsAddUpToTheColourAndAreNamedByTheLight) {
  surface("plastic");
  light("ambientlight", {text("lightgroup", "b")});
  light("pointlight", {point("from", {1, 2, 0}), number("intensity", 9), text("__group", "a")});
  light("distantlight", {number("intensity", 2), text("lightgroup", "b")});
  channel("one", "lightgroup:a");
  channel("two", "lightgroup:b");
  channel("rest", "lightgroup:");
  show("one,two,rest");
  const ShadedPoints out = shadeStored();
  EXPECT_EQ(log.entries().size(), 0u);
  EXPECT_GT(stored(out, 0).x, 0);
  expectColor(stored(out, 0) + stored(out, 1), out.color(1));
  expectColor(stored(out, 2), vec3(0.0f));
}

TEST_F(Variables, ShadowRaysAreTracedOnceForAllGroups) {
  surface("matte");
  light("pointlight", {text("shadowname", "raytrace")});
  channel("one", "lightgroup:pointlight");
  show("one");
  shadeStored();
  EXPECT_EQ(services.shadowRays, 2);
}

TEST_F(Variables, AlbedoIsPremultipliedAndNormalFacesTheViewer) {
  attributes.color = {0.5f, 0.25f, 1};
  attributes.opacity = vec3(0.5f);
  surface("matte");
  show("albedo,normal,P");
  const ShadedPoints out = shadeStored();
  expectColor(stored(out, 0), {0.25f, 0.125f, 0.5f});
  expectColor(stored(out, 1), {0, 0, -1});
  expectColor(stored(out, 2), {1, 0, 5});
}

TEST_F(Variables, PrimitiveVariablesAreFoundByName) {
  primvar("wear", ValueType::Color);
  surface("matte");
  scene.options.channels["wear"] = {"wear", ValueType::Color, {}, at(3)};
  show("wear");
  ShadePoints p = points({vec3(0, 0, 5)});
  p.primvar(1)[0] = 0.5f;
  ShadeContext context;
  context.variables = true;
  EXPECT_FLOAT_EQ(stored(shade(p, context), 0, 0).y, 0.5f);
}

TEST_F(Variables, ColoursAmongThePrimitiveVariablesArePremultiplied) {
  attributes.opacity = vec3(0.5f, 0.25f, 1);
  primvar("wear", ValueType::Color);
  surface("matte");
  scene.options.channels["wear"] = {"wear", ValueType::Color, {}, at(3)};
  show("wear");
  ShadePoints p = points({vec3(0, 0, 5)});
  for (int k = 0; k < 3; ++k) p.primvar(k)[0] = 0.5f;
  ShadeContext context;
  context.variables = true;
  expectColor(stored(shade(p, context), 0, 0), {0.25f, 0.125f, 0.5f});
}

TEST_F(Variables, WhatNobodyWritesIsReportedAndHoldsItsFill) {
  surface("matte");
  scene.options.channels["fruit"] = {"fruit", ValueType::Color, {number("fill", 0.5f)}, at(3)};
  show("fruit");
  expectColor(stored(shadeStored(), 0), vec3(0.5f));
  EXPECT_EQ(log.count("channel-unwritten"), 1);
}

TEST_F(Variables, WhatNobodyWritesIsReportedAtTheEndIfProceduralsMayBringMoreSurfaces) {
  Procedural later;
  later.attributes = std::make_shared<const Attributes>();
  scene.procedurals.push_back(later);
  surface("matte");
  scene.options.channels["fruit"] = {"fruit", ValueType::Color, {}, at(3)};
  show("fruit");
  system();
  EXPECT_EQ(log.count("channel-unwritten"), 0);
  shading.reset();
  EXPECT_EQ(log.count("channel-unwritten"), 1);
}

TEST_F(Variables, NothingIsStoredForRays) {
  surface("matte");
  show("N");
  EXPECT_TRUE(shade(points({vec3(0, 0, 5)})).variables.empty());
}

}  // namespace
}  // namespace tomales
