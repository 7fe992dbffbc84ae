// Each subset of a resource of attributes restores what belongs to it, and nothing else.
#include "rib_test_tools.h"

namespace tomales {
namespace resource_subsets {
namespace {

struct Row {
  const char* subset;
  std::string says;   ///< Changes an attribute.
  std::string after;  ///< Shows the change of a state that is no attribute of its own.
};

const std::vector<Row> kRows = {
    {"shading", "Color 1 0 0", ""},
    {"shading", "Opacity .5 .5 .5", ""},
    {"shading", "Surface \"matte\"", ""},
    {"shading", "LightSource \"pointlight\" 7", ""},
    {"shading", "AreaLightSource \"arealight\" 8", ""},
    {"shading", "Interior \"a\"", ""},
    {"shading", "Exterior \"b\"", ""},
    {"shading", "Atmosphere \"fog\"", ""},
    {"shading", "ShadingRate 3", ""},
    {"shading", "ShadingRate 3", "Attribute \"shade\" \"float relativeshadingrate\" 2"},
    {"shading", "Attribute \"shade\" \"float relativeshadingrate\" 2", "ShadingRate 3"},
    {"shading", "ShadingInterpolation \"constant\"", ""},
    {"shading", "ShadingInterpolation \"smooth\"", ""},
    {"shading", "Attribute \"indirect\" \"float gain\" 2", ""},
    {"shading", "Attribute \"trace\" \"float bias\" .5", ""},
    {"shading", "Attribute \"irradiance\" \"float maxerror\" .3", ""},
    {"shading", "Attribute \"irradiance\" \"float maxpixeldist\" 7", ""},
    {"geometrymodification", "Displacement \"dented\"", ""},
    {"geometrymodification", "Attribute \"displacementbound\" \"float sphere\" 2", ""},
    {"geometrymodification", "Attribute \"displacementbound\" \"string coordinatesystem\" \"world\"", ""},
    {"geometrymodification", "Attribute \"dice\" \"int rasterorient\" 0", ""},
    {"geometrymodification", "Attribute \"dice\" \"int binary\" 1", ""},
    {"geometrydefinition", "TextureCoordinates 0 0 2 0 0 2 2 2", ""},
    {"geometrydefinition", "Orientation \"inside\"", ""},
    {"hiding", "Matte 1", ""},
    {"hiding", "Sides 1", ""},
    {"hiding", "Attribute \"visibility\" \"int camera\" 0", ""}};

const char* const kSubsets[] = {"shading", "geometrymodification", "geometrydefinition", "hiding", "transform"};

std::string restoring(const std::string& subset, const std::string& after, const std::string& shape = kSphere) {
  return "AttributeBegin Resource \"r\" \"attributes\" \"string operation\" \"restore\" \"string subset\" \"" + subset +
         "\" " + after + " " + shape + "AttributeEnd\n";
}

TEST(ResourceSubset, RestoresItsAttributesAndNoOthers) {
  for (const Row& row : kRows) {
    std::string text = "AttributeBegin " + row.says +
                       " Resource \"r\" \"attributes\" \"string operation\" \"save\" AttributeEnd\n" +
                       restoring("all", row.after) + "AttributeBegin " + row.after + " " + kSphere + "AttributeEnd\n";
    for (const char* subset : kSubsets) text += restoring(subset, row.after);
    const Reading r(inWorld(text));
    const Attributes &whole = r.attributes(0), &none = r.attributes(1);
    EXPECT_TRUE(row.says.find("Interpolation") != std::string::npos || !(whole == none)) << row.says;
    for (size_t i = 0; i < std::size(kSubsets); ++i)
      EXPECT_TRUE(r.attributes(2 + i) == (kSubsets[i] == std::string_view(row.subset) ? whole : none))
          << row.says << " by " << kSubsets[i];
  }
}

TEST(ResourceSubset, OfDefinitionsHasBothBasesAndRoundCurves) {
  std::string points;
  for (int i = 0; i < 49; ++i) points += std::to_string(i % 7) + " " + std::to_string(i / 7) + " 0 ";
  const std::string mesh = "PatchMesh \"bicubic\" 7 \"nonperiodic\" 7 \"nonperiodic\" \"P\" [" + points + "]\n",
                    line = "Curves \"linear\" [2] \"nonperiodic\" \"P\" [0 0 0 1 0 0]\n";
  const auto patches = [](const std::string& says, const std::string& shape) {
    std::string text =
        "AttributeBegin " + says + " Resource \"r\" \"attributes\" \"string operation\" \"save\" AttributeEnd\n";
    for (const char* subset : {"geometrydefinition", "shading", "geometrymodification", "hiding", "transform"})
      text += restoring(subset, "", shape);
    const Reading r(inWorld(text));
    std::vector<uint32_t> out;
    for (const Object& o : r.scene().objects) out.push_back(o.shape().patchCount());
    return out;
  };
  EXPECT_EQ(patches("Basis \"b-spline\" 1 \"bezier\" 3", mesh), (std::vector<uint32_t>{8, 4, 4, 4, 4}));
  EXPECT_EQ(patches("Basis \"bezier\" 3 \"b-spline\" 1", mesh), (std::vector<uint32_t>{8, 4, 4, 4, 4}));
  EXPECT_EQ(patches("Attribute \"dice\" \"int roundcurve\" 1", line), (std::vector<uint32_t>{3, 1, 1, 1, 1}));
}

TEST(ResourceSubset, OfTransformationsHasTheSpacesOfTheScope) {
  const Reading r(inWorld(
      "TransformBegin Translate 9 0 0 ScopedCoordinateSystem \"s\" TransformEnd AttributeBegin Translate 1 0 0 "
      "ScopedCoordinateSystem \"s\" Resource \"r\" \"attributes\" \"string operation\" \"save\" AttributeEnd\n" +
      restoring("transform", "CoordSysTransform \"s\"") + restoring("shading", "CoordSysTransform \"s\"")));
  EXPECT_EQ(r.object(0).worldFromObject.at(0)[3].x, 1);
  EXPECT_EQ(r.object(1).worldFromObject.at(0)[3].x, 9);
}

TEST(ResourceSubset, OfShadingSaysWhetherLightsCastShadows) {
  for (const char* subset : {"shading", "hiding", "geometrydefinition", "geometrymodification"}) {
    const Reading r(
        inWorld("AttributeBegin Attribute \"light\" \"string shadows\" \"on\" Resource \"r\" \"attributes\" "
                "\"string operation\" \"save\" AttributeEnd\n" +
                restoring(subset, "LightSource \"pointlight\" 1")));
    EXPECT_EQ(r.scene().lights.at(0)->castsShadows, subset == std::string("shading")) << subset;
  }
}

TEST(Resource, OfWrongUseIsToldWithItsLine) {
  const Reading r(
      inWorld("Resource \"r\" \"attributes\" \"string operation\" \"lose\"\n"
              "Resource \"r\" \"shaders\" \"string operation\" \"save\"\n"
              "Resource \"r\" \"attributes\" \"string operation\" \"restore\"\n"
              "Resource \"r\" \"attributes\" \"string operation\" \"save\"\n"
              "Resource \"r\" \"attributes\" \"string operation\" \"restore\" \"string subset\" \"shape\""));
  EXPECT_EQ(r.codes(), "rib-resource@2 rib-resource@3 rib-resource@4 rib-resource@6 ");
}

}  // namespace
}  // namespace resource_subsets
}  // namespace tomales
