#include <climits>
#include <set>
#include <sstream>

#include "rib_test_tools.h"

namespace tomales {
namespace {

using rib::Declaration;
using rib::Dictionary;

TEST(Parser, TakesFixedSizeVectorsBareAndInBrackets) {
  const Requests r(
      "Color 1 .5 0 Color [1 .5 0] Rotate 30 [0 1 0] Rotate [30 0 1 0] Sphere [1 -1 1 360]\n"
      "Hyperboloid [1 2 3] [4 5 6] 7");
  ASSERT_EQ(r.list.size(), 6u);
  EXPECT_EQ(r.list[0].args[0].numbers, r.list[1].args[0].numbers);
  EXPECT_EQ(r.list[2].args[0].numbers, r.list[3].args[0].numbers);
  EXPECT_EQ(r.list[5].args[0].numbers, (std::vector<float>{1, 2, 3, 4, 5, 6, 7}));
  EXPECT_TRUE(r.log.entries().empty());
}

TEST(Parser, AWordInSingleQuotesIsAString) {
  const Requests r("Display \"a.tif\" 'file' ['rgba']\nDisplay '' 'file' 'rgba'\nSurface ' '");
  ASSERT_EQ(r.list.size(), 2u) << "a lone quote is none";
  EXPECT_EQ(r.list[0].args[1].strings[0], "file");
  EXPECT_EQ(r.list[0].args[2].strings[0], "rgba");
}

TEST(Parser, SkipsARequestWithTooFewArgumentsAndSaysWhere) {
  const Requests r("Color 1 0 0\n\nTranslate 1 2\nScale 1 1 1");
  ASSERT_EQ(r.list.size(), 2u);
  EXPECT_EQ(r.list[1].name, "Scale");
  ASSERT_EQ(r.log.entries().size(), 1u);
  const LogEntry e = r.log.entries()[0];
  EXPECT_EQ(e.code, "rib-arguments");
  EXPECT_NE(e.message.find("Translate (line 3): number 3 of 3"), std::string::npos) << e.message;
}

TEST(Parser, SkipsARequestWithTooManyOrWrongArguments) {
  const Requests r(
      "Translate 1 2 3 4\nColor \"red\"\nSurface 3\nPolygon 1\nPointsPolygons [3] [\"a\"] \"P\" "
      "[0]\nIdentity");
  ASSERT_EQ(r.list.size(), 1u);
  EXPECT_EQ(r.list[0].name, "Identity");
  EXPECT_EQ(r.log.count("rib-arguments"), 5);
}

TEST(Parser, ResumesAfterUnknownRequests) {
  const Requests r("FooBar 1 [2 3] \"Color\" 4\nColor 1 1 1\nBlaBlub \"x\" WorldBegin");
  ASSERT_EQ(r.list.size(), 2u);
  EXPECT_EQ(r.list[0].name, "Color");
  EXPECT_EQ(r.list[1].name, "WorldBegin");
  EXPECT_EQ(r.log.count("rib-unknown-request"), 2);
  EXPECT_EQ(r.log.entries()[1].where.line, 3);
}

TEST(Parser, KnowsTheStandardDeclarations) {
  const Requests r(
      "Sphere 1 -1 1 360 \"P\" [0 0 0] \"N\" [0 0 1] \"Cs\" [1 1 1] \"st\" [0 0] \"Np\" [0 0 1] \"Pw\" [0 0 "
      "0 1]");
  const ParamList& p = r.list.at(0).params;
  ASSERT_EQ(p.size(), 6u);
  EXPECT_TRUE(p[0].type == ValueType::Point && p[0].storage == Storage::Vertex);
  EXPECT_TRUE(p[1].type == ValueType::Normal && p[1].storage == Storage::Varying);
  EXPECT_TRUE(p[2].type == ValueType::Color && p[2].storage == Storage::Varying);
  EXPECT_TRUE(p[3].type == ValueType::Float && p[3].arrayLength == 2);
  EXPECT_TRUE(p[4].storage == Storage::Uniform);
  EXPECT_TRUE(p[5].type == ValueType::HPoint && p[5].width() == 4);
}

TEST(Parser, KnowsTheNamesOfACategoryOnlyThere) {
  const Requests r("Attribute \"visibility\" \"camera\" 0\nSurface \"matte\" \"camera\" 0");
  ASSERT_EQ(r.list.size(), 2u);
  EXPECT_EQ(r.list[0].params.at(0).ints, std::vector<int>{0});
  EXPECT_EQ(r.list[1].params.at(0).floats, std::vector<float>{0});
}

TEST(Parser, WhatIsDeclaredNowhereHasTheTypeOfItsValues) {
  const Requests r(
      "Surface \"disney\" \"metallic\" 1 \"tint\" [1 0 .5] \"map\" \"a.tex\" \"Kd\" [.1 .2]\n"
      "Attribute \"render\" \"casts_shadows\" \"none\"\n"
      "Attribute \"visibility\" \"transmission\" [\"opaque\"] \"camera\" 0\n"
      "Option \"mine\" \"all\" [\"a\" \"b\"] \"sizes\" [1 2]\n");
  EXPECT_TRUE(r.log.entries().empty());
  ASSERT_EQ(r.list.size(), 4u);
  const ParamList& disney = r.list[0].params;
  ASSERT_EQ(disney.size(), 4u);
  for (const Param& p : disney) EXPECT_EQ(p.arrayLength, 0) << p.name;
  EXPECT_EQ(disney[1].floats, (std::vector<float>{1, 0, .5f}));
  EXPECT_EQ(disney[2].type, ValueType::String);
  EXPECT_EQ(disney[3].floats, (std::vector<float>{.1f, .2f})) << "a shader may have a Kd of its own";
  EXPECT_EQ(r.list[1].params.at(0).strings, std::vector<std::string>{"none"});
  EXPECT_EQ(r.list[2].params.at(0).strings, std::vector<std::string>{"opaque"}) << "it is a number as a rule";
  EXPECT_EQ(r.list[2].params.at(1).ints, std::vector<int>{0});
  EXPECT_EQ(r.list[3].params.at(0).strings.size(), 2u);
}

TEST(Parser, WhatDeclareOrTheRequestSaysIsDeclared) {
  const Requests r("Declare \"glow\" \"uniform color\"\nSurface \"x\" \"float Kd\" 1 \"Ka\" 1");
  ASSERT_EQ(r.list.size(), 2u);
  EXPECT_EQ(r.list[1].params.at(0).arrayLength, 1);
  EXPECT_EQ(r.list[1].params.at(1).arrayLength, 0) << "RISpec's type is that of its own shaders";
}

TEST(Parser, APrimitiveVariableThatIsNotDeclaredIsMissing) {
  const Requests r("Sphere 1 -1 1 360 \"fuzz\" [1 2 3 4] \"__mine\" [1]\nSurface \"x\" \"flaot Kd\" 1");
  EXPECT_EQ(r.list.at(0).params.size(), 1u);
  EXPECT_TRUE(r.list.at(1).params.empty());
  EXPECT_EQ(r.log.count("rib-undeclared"), 2);
  EXPECT_EQ(r.log.worst(), Severity::Missing);
}

TEST(Parser, AnUnknownRequestIsMissingAndANearNameIsSaid) {
  const Requests r("Shpere 1 -1 1 360\nIdentity\ncolor 1 0 0\nIdentity\nWobble 1");
  ASSERT_EQ(r.log.entries().size(), 3u);
  EXPECT_EQ(r.log.worst(), Severity::Missing);
  EXPECT_NE(r.log.entries()[0].message.find("did you mean \"Sphere\"?"), std::string::npos);
  EXPECT_NE(r.log.entries()[1].message.find("did you mean \"Color\"?"), std::string::npos);
  EXPECT_EQ(r.log.entries()[2].message.find("did you mean"), std::string::npos);
}

TEST(Parser, ParametersOfTheStandardShadersNeedNoDeclaration) {
  const Requests r(
      "Surface \"plastic\" \"Ka\" 1 \"Kd\" 1 \"Ks\" 1 \"roughness\" 1 \"specularcolor\" [1 1 1] Surface \"shinymetal\" "
      "\"Kr\" 1 \"texturename\" \"a\"\n"
      "LightSource \"spotlight\" 1 \"intensity\" 1 \"lightcolor\" [1 1 1] \"from\" [0 0 0] \"to\" [0 0 1] "
      "\"coneangle\" 1 \"conedeltaangle\" 1 \"beamdistribution\" 1\n"
      "LightSource \"shadowspot\" 2 \"shadowname\" \"a\" \"width\" 1 \"samples\" 1\n"
      "Atmosphere \"depthcue\" \"mindistance\" 0 \"maxdistance\" 1 \"background\" [0 0 0] Atmosphere \"fog\" "
      "\"distance\" 1\n"
      "Displacement \"bumpy\" \"Km\" 1 \"amplitude\" 1 Imager \"background\" \"bgcolor\" [1 1 1]\n");
  EXPECT_TRUE(r.log.entries().empty());
  EXPECT_EQ(r.list.size(), 8u);
}

TEST(Parser, ReadsInlineDeclarations) {
  const Requests r(
      R"(Surface "x" "float a" 1 "uniform color b" [1 2 3] "varying float[2] c" [1 2] "constant int d" 3.0
    "string e" ["x"] "facevertex float f" [1] "vertex point [2] g" [1 2 3 4 5 6] "vector h" [1 2 3] "matrix[1] i" [1 2])");
  const ParamList& p = r.list.at(0).params;
  ASSERT_EQ(p.size(), 8u);  // i has 2 of 16 numbers
  EXPECT_EQ(p[1].name, "b");
  EXPECT_EQ(p[2].arrayLength, 2);
  EXPECT_EQ(p[3].ints, std::vector<int>{3});
  EXPECT_EQ(p[4].strings, std::vector<std::string>{"x"});
  EXPECT_EQ(p[5].storage, Storage::FaceVarying);
  EXPECT_EQ(p[6].width(), 6);
  EXPECT_EQ(r.log.count("rib-parameter"), 1);
}

TEST(Parser, DropsOnlyTheParameterThatIsWrong) {
  const Requests r("Surface \"x\" \"float Ka\" [\"one\"] \"mixed\" [1 \"one\"] \"Kd\" 0.5 \"color tint\" [1 1]");
  ASSERT_EQ(r.list.size(), 1u);
  ASSERT_EQ(r.list[0].params.size(), 1u);
  EXPECT_EQ(r.list[0].params[0].name, "Kd");
  EXPECT_EQ(r.log.count("rib-parameter"), 3);
}

TEST(Parser, TurnsNumbersIntoHandles) {
  const Requests r("LightSource \"pointlight\" 7 LightSource \"pointlight\" \"key\" ObjectInstance [3]");
  ASSERT_EQ(r.list.size(), 3u);
  EXPECT_EQ(r.list[0].args[1].strings[0], "7");
  EXPECT_EQ(r.list[1].args[1].strings[0], "key");
  EXPECT_EQ(r.list[2].args[0].strings[0], "3");
}

TEST(Parser, TellsOptionalArgumentsFromParameters) {
  const Requests r(
      "SubdivisionMesh \"catmull-clark\" [3] [0 1 2] \"P\" [0 0 0]\n"
      "SubdivisionMesh \"catmull-clark\" [3] [0 1 2] [\"hole\"] [1 0] [0] [] \"P\" [0 0 0]\n"
      "DepthOfField DepthOfField 2 1 5 Identity");
  ASSERT_EQ(r.list.size(), 5u);
  EXPECT_EQ(r.list[0].args.size(), 3u);
  EXPECT_EQ(r.list[1].args.size(), 7u);
  EXPECT_EQ(r.list[1].params.size(), 1u);
  EXPECT_TRUE(r.list[2].args.empty());
  EXPECT_EQ(r.list[3].args[0].numbers, (std::vector<float>{2, 1, 5}));
}

TEST(Dictionary, TakesDeclarationsWithMissingParts) {
  Dictionary d;
  std::string name;
  EXPECT_TRUE(d.declare("a", "float"));
  EXPECT_TRUE(d.declare("b", "varying"));
  EXPECT_TRUE(d.declare("c", "  vertex   color [ 3 ] "));
  EXPECT_FALSE(d.declare("d", "varying flot"));
  EXPECT_FALSE(d.declare("d", "float[0]"));
  EXPECT_FALSE(d.declare("d", "float[9999999999]"));
  EXPECT_FALSE(d.declare("d", ""));
  EXPECT_EQ(d.find("a", "", name)->storage, Storage::Uniform);
  EXPECT_EQ(d.find("b", "", name)->storage, Storage::Varying);
  EXPECT_EQ(d.find("c", "", name)->arrayLength, 3);
  EXPECT_EQ(d.find("facevarying c", "", name)->type, ValueType::Color) << "a class alone keeps the declared type";
  EXPECT_EQ(name, "c");
  EXPECT_FALSE(d.find("d", "", name));
}

TEST(RequestTable, KnowsRequestsThatAreNotSupported) {
  EXPECT_EQ(rib::findSignature("VPInterior")->support, rib::Support::Ignored);
  EXPECT_EQ(rib::findSignature("NoSuchRequest"), nullptr);
  const Requests r(
      "NuPatch 4 3 [0 0 0 1 1 1 2] 0 1 3 3 [0 0 0 1 1 1] 0 1 \"Pw\" [0 0 0 1]\n"
      "Procedural \"RunProgram\" [\"a\" \"b\"] [0 1 0 1 0 1]\nMakeTexture \"a\" \"b\" \"black\" \"black\" "
      "\"box\" 1 1");
  EXPECT_EQ(r.list.size(), 3u);
  EXPECT_TRUE(r.log.entries().empty());
}

TEST(RequestTable, IsListedForProgramsThatWriteRib) {
  std::istringstream lines(ribRequests());
  std::set<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, arguments, parameters, support, more;
    words >> name >> arguments >> parameters >> support;
    EXPECT_FALSE(words >> more) << line;
    EXPECT_TRUE(names.insert(name).second) << line;
    const rib::Signature* s = rib::findSignature(name);
    ASSERT_TRUE(s) << line;
    EXPECT_EQ(arguments, s->arguments.empty() ? "-" : std::string(s->arguments));
    EXPECT_EQ(parameters == "parameters", s->parameterList);
    EXPECT_FALSE(support.empty());
  }
  EXPECT_GT(names.size(), 100u);
  for (const char* name : {"Sphere", "Torus", "Volume", "WorldBegin"}) EXPECT_TRUE(names.contains(name)) << name;
}

TEST(Parser, KeepsIntegersExact) {
  const Requests r("PointsPolygons [3] [16777217 2147483647 -2147483648 2.6 nan] \"P\" [] FrameBegin 16777217 Patch 1");
  ASSERT_EQ(r.list.size(), 2u);
  EXPECT_EQ(r.list[0].args[1].integers, (std::vector<int>{16777217, INT_MAX, INT_MIN, 3, INT_MIN}));
  EXPECT_EQ(r.list[1].args[0].integer(), 16777217);
}

TEST(Parser, ARequestThatDrawsIsMissedAndAnotherOneIsNot) {
  const Requests r("Sphere 1\nShadingRate \"fine\"\nIdentity");
  ASSERT_EQ(r.log.entries().size(), 2u);
  EXPECT_EQ(r.log.entries()[0].severity, Severity::Missing);
  EXPECT_EQ(r.log.entries()[1].severity, Severity::Warning);
}

TEST(Parser, TakesAnIntegerBareAndInBrackets) {
  const Requests r("Blobby 2 [1001 0] [1] [\"a\"] Blobby [2] [1001 0] [1] [\"a\"] Blobby [2 [1001 0] [1] [\"a\"]");
  ASSERT_EQ(r.list.size(), 2u);
  EXPECT_EQ(r.list[1].args[0].integers, std::vector<int>{2});
  EXPECT_EQ(r.list[1].args[1].integers, r.list[0].args[1].integers);
  EXPECT_EQ(r.log.count("rib-arguments"), 1) << "a bracket that does not close";
}

TEST(Parser, CountsTheLinesWithinTexts) {
  const Requests r("Surface \"two\nlines\"\nSurface \"one \\\nline\"\nIdentity");
  ASSERT_EQ(r.list.size(), 3u);
  EXPECT_EQ(r.list[0].args[0].strings, std::vector<std::string>{"two\nlines"});
  EXPECT_EQ(r.list[1].args[0].strings, std::vector<std::string>{"one line"});
  EXPECT_EQ(r.list[1].where.line, 3);
  EXPECT_EQ(r.list[2].where.line, 5);
}

}  // namespace
}  // namespace tomales
