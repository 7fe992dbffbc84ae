// Tests which lights shine on what: handles, Illuminate, scopes, instances and archives.
#include "reyes/state_fields.h"
#include "rib_test_tools.h"

namespace tomales {
namespace {

std::string lamps(int count) {
  std::string out;
  for (int k = 0; k < count; ++k)
    out += "AttributeBegin AreaLightSource \"arealight\" \"" + std::to_string(k) + "\" " + kSphere +
           "AttributeEnd Illuminate \"" + std::to_string(k) + "\" 1\n";
  return out;
}

TEST(Lights, OutsideTheWorldKeepTheirPlace) {
  const Reading r("LightSource \"pointlight\" 1 Translate 0 0 5 " +
                  inWorld("Translate 0 2 0 LightSource \"spotlight\" 2 " + kSphere));
  ASSERT_EQ(r.scene().lights.size(), 2u);
  expectNear(transformPoint(r.scene().lights[0]->shader.worldFromShader.at(0), {0, 0, 0}), {0, 0, -5});
  expectNear(transformPoint(r.scene().lights[1]->shader.worldFromShader.at(0), {0, 0, 0}), {0, 2, 0});
  EXPECT_EQ(r.attributes(0).lights, (LightList{0, 1}));
  EXPECT_EQ(r.scene().lights[1]->index, 1);
}

TEST(Lights, WithoutAHandleHaveTheirPlaceForOne) {
  const Reading r(
      inWorld("\nLightSource \"pointlight\" \"intensity\" [2] \"from\" [1 2 3]\n"
              "LightSource \"ambientlight\" \"intensity\" .5\n"
              "AreaLightSource \"arealight\" \"intensity\" 3\n" +
              kSphere));
  EXPECT_EQ(r.message("rib-no-handle").count, 2);
  EXPECT_EQ(r.codes(), "rib-no-handle@3 rib-no-handle@5 ");
  ASSERT_EQ(r.scene().lights.size(), 3u);
  const auto& lights = r.scene().lights;
  EXPECT_EQ(findParam(lights[0]->shader.params, "intensity")->number(0), 2);
  EXPECT_EQ(findParam(lights[0]->shader.params, "from")->floats, (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(findParam(lights[1]->shader.params, "intensity")->number(0), .5f);
  EXPECT_TRUE(lights[2]->area);
  EXPECT_NE(lights[0]->handle, lights[1]->handle);
  EXPECT_EQ(r.attributes(0).lights, (LightList{0, 1, 2}));
}

TEST(Lights, OfGeometryShineOnWhatFollowsThem) {
  const Reading r(inWorld(lamps(3) + kSphere + "Illuminate \"1\" 0 " + kSphere + "Illuminate \"1\" 1 " + kSphere +
                          "Illuminate \"2\" 1 " + kSphere));
  EXPECT_EQ(r.attributes(0).lights, LightList{0});
  EXPECT_EQ(r.attributes(1).lights, (LightList{0, 1}));
  EXPECT_EQ(r.attributes(2).lights, (LightList{0, 1, 2}));
  EXPECT_EQ(r.attributes(3).lights, (LightList{0, 1, 2}));
  EXPECT_EQ(r.attributes(4).lights, (LightList{0, 2}));
  EXPECT_EQ(r.attributes(5).lights, (LightList{0, 2, 1})) << "the last to be switched on is the last to run";
  EXPECT_EQ(r.attributes(6).lights, (LightList{0, 1, 2})) << "even if it was on";
}

TEST(Lights, OfAScopeEndWithIt) {
  const Reading r(inWorld("LightSource \"pointlight\" \"a\" AttributeBegin Illuminate \"a\" 0 AttributeBegin " +
                          std::string("LightSource \"pointlight\" \"b\" ") + kSphere + "AttributeEnd " + kSphere +
                          "AttributeEnd " + kSphere + "TransformBegin LightSource \"pointlight\" \"c\" TransformEnd " +
                          kSphere));
  EXPECT_EQ(r.attributes(0).lights, LightList{1});
  EXPECT_TRUE(r.attributes(1).lights.empty());
  EXPECT_EQ(r.attributes(2).lights, LightList{0});
  EXPECT_EQ(r.attributes(3).lights, (LightList{0, 2})) << "TransformBegin keeps no lights";
}

TEST(Lights, OfInstancesAndArchivesAreThoseOfTheirPlaces) {
  const std::string archive = "Procedural \"DelayedReadArchive\" [\"a\"] [-1 1 -1 1 -1 1]\n";
  const Reading r(
      inWorld("LightSource \"pointlight\" 1 LightSource \"pointlight\" 2 Illuminate 2 0\n"
              "ObjectBegin 1 " +
              kSphere + "ObjectEnd ArchiveBegin \"a\" " + kSphere + "Illuminate 1 0 " + kSphere +
              "ArchiveEnd\nObjectInstance 1 Illuminate 2 1 ObjectInstance 1 " + archive +
              "Illuminate 1 0 ReadArchive \"a\" " + kSphere));
  EXPECT_EQ(r.attributes(0).lights, LightList{0});
  EXPECT_EQ(r.attributes(1).lights, (LightList{0, 1}));
  // What procedurals describe comes after all else.
  for (const size_t i : {2u, 3u, 4u}) EXPECT_EQ(r.attributes(i).lights, LightList{1}) << i;
  EXPECT_EQ(r.attributes(5).lights, (LightList{0, 1}));
  EXPECT_EQ(r.attributes(6).lights, LightList{1});
}

TEST(Lights, OfGeometryTakeMemoryInProportionToTheirNumber) {
  const auto bytes = [](int count) {
    const Reading r(inWorld(lamps(count)));
    size_t out = 0;
    for (const Object& object : r.scene().objects) out += pack(*object.attributes).size();
    return out;
  };
  EXPECT_EQ(bytes(400), 4 * bytes(100));
}

TEST(Lights, AreSwitchedByIlluminateWithinTheScope) {
  const Reading r(
      inWorld("LightSource \"pointlight\" 1 AttributeBegin LightSource \"pointlight\" \"key\" Illuminate 1 0 " +
              kSphere + "AttributeEnd " + kSphere + "Illuminate \"key\" 1 " + kSphere));
  EXPECT_EQ(r.attributes(0).lights, LightList{1});
  EXPECT_EQ(r.attributes(1).lights, LightList{0});
  EXPECT_EQ(r.attributes(2).lights, (LightList{0, 1}));
}

TEST(Lights, CastShadowsByTheAttributeWhateverTheirShadersAsk) {
  const Reading r(inWorld(
      R"(LightSource "spotlight" 1 "shadowname" "raytrace" LightSource "spotlight" 2 "shadowname" "a.shad"
    AttributeBegin Attribute "light" "shadows" "on" LightSource "pointlight" 3 AttributeEnd LightSource "pointlight" 4)"));
  const bool expected[] = {false, false, true, false};
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(r.scene().lights.at(i)->castsShadows, expected[i]) << i;
}

TEST(Lights, OfAreaBelongToTheGeometryThatFollows) {
  const Reading r(inWorld(kSphere + "AttributeBegin AreaLightSource \"arealight\" 3 \"intensity\" 2 " + kSphere +
                          "AttributeEnd " + kSphere));
  ASSERT_EQ(r.scene().lights.size(), 1u);
  EXPECT_TRUE(r.scene().lights[0]->area && r.scene().lights[0]->castsShadows);
  EXPECT_EQ(r.attributes(0).areaLight, -1);
  EXPECT_EQ(r.attributes(1).areaLight, 0);
  EXPECT_EQ(r.attributes(1).lights, LightList{0});
  EXPECT_EQ(r.attributes(2).areaLight, -1);
}

}  // namespace
}  // namespace tomales
