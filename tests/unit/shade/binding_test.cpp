#include <filesystem>

#include "reyes/shade/parameter_values.h"
#include "reyes/shade/substitute.h"
#include "reyes/shader.h"
#include "tests/unit/shade/stage.h"
#include "tests/unit/shade/written_picture.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

using Binding = Stage;

TEST_F(Binding, AVaryingPrimitiveVariableOverridesTheParameterAndColour) {
  surface("matte", {number("Kd", 0.5f)});
  light("distantlight");
  primvar("Cs", ValueType::Color);
  primvar("Kd", ValueType::Float);
  ShadePoints p = points({vec3(0, 0, 5), vec3(1, 0, 5)});
  p.primvar(0)[0] = 1;
  p.primvar(1)[1] = 3;
  p.primvar(3)[0] = 0.25f;
  p.primvar(3)[1] = 2;
  const ShadedPoints out = shade(p);
  expectColor(out.color(0), {0.25f, 0, 0});
  expectColor(out.color(1), {0, 6, 0});
}

// The dicer has already brought primitive variables to current space; moving them again would be wrong.
TEST_F(Binding, APointAmongThePrimitiveVariablesArrivesAsThePointsHoldIt) {
  static rsl::PointParam where("where", {0, 0, 0}, "a point");
  static const rsl::Shader pointing(TM_SURFACE, "pointing", "", 0,
                                    [](const TmGrid* g) {
                                      for (int i : rsl::Batch(g)) rsl::Batch(g).output(i, where(g, i), {1, 1, 1});
                                    },
                                    {&where});
  static const TmShader* const shaders[] = {pointing};
  const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  surface("pointing");
  primvar("where", ValueType::Point);
  worldFromObject.keys[0][3] = vec4(9, 9, 9, 1);
  ShadePoints p = points({vec3(0, 0, 5)});
  for (int k = 0; k < 3; ++k) p.primvar(k)[0] = static_cast<float>(k + 1);
  expectColor(shade(p).color(0), {1, 2, 3});
}

TEST_F(Binding, OpaqueNeedsOpacityOneEverywhereAndAShaderThatKeepsIt) {
  surface("matte");
  EXPECT_TRUE(system().group(0).opaque());
  shading.reset();
  scene.objects.clear();
  attributes.opacity = {1, 1, 0.9f};
  EXPECT_FALSE(system().group(0).opaque());
  shading.reset();
  scene.objects.clear();
  attributes.opacity = vec3(1);
  primvar("Os", ValueType::Color);
  EXPECT_FALSE(system().group(0).opaque());
}

TEST_F(Binding, EveryGroupHasItsOwnShader) {
  for (const vec3& color : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)}) {
    Attributes own;
    own.color = color;
    own.surface = std::make_shared<const ShaderCall>(call("constant", {}));
    Object o;
    o.shapes = {std::make_shared<BlankPrim>(std::vector<Primvar>{})};
    o.attributes = std::make_shared<const Attributes>(own);
    o.where = at(9);
    scene.objects.push_back(o);
  }
  surface("matte");
  light("distantlight", {number("intensity", 0.5f)});
  system();
  ASSERT_EQ(scene.groups.size(), 4u);
  for (size_t k = 0; k < 4; ++k) {
    ShadePoints p(scene.objects[k].group, 0);
    const int i = p.add(1);
    p.set3(kPx, i, {0, 0, 5});
    for (const int normal : {kNx, kNgx}) p.set3(normal, i, {0, 0, -1});
    p.set3(kIx, i, {0, 0, 1});
    vec3 expected(0);
    if (k < 3)
      expected[static_cast<int>(k)] = 1;
    else
      expected = vec3(0.5f);
    expectColor(shade(p).color(0), expected);
  }
}

TEST_F(Binding, WithoutASurfaceTheHeadlightShaderIsUsed) {
  const vec3 N = glm::normalize(vec3(1, 0, -1));
  expectColor(shade(points({vec3(0, 0, 5)}, N)).color(0), vec3(0.2f + 0.8f * std::sqrt(0.5f)));
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Binding, UnknownShadersAreReportedWithPlaceAndObjectAndReplacedLoudly) {
  surface("nosuch");
  displacement("nobump");
  light("nolight");
  const vec3 c = shadeOne();
  EXPECT_EQ(c.y, 0) << "magenta";
  EXPECT_GT(c.x, 0);
  auto entries = log.entries();
  EXPECT_EQ(std::erase_if(entries, [](const LogEntry& e) { return e.code == "shader-folders"; }), 1u) << "once";
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_EQ(log.worst(), Severity::Missing);
  EXPECT_EQ(entries[0].where.line, 5);
  EXPECT_EQ(entries[1].where.line, 7);
  EXPECT_NE(entries[1].message.find("\"thing\""), std::string::npos) << entries[1].message;
  EXPECT_NE(entries[1].message.find("nosuch"), std::string::npos);
  EXPECT_EQ(entries[2].where.line, 8);
}

TEST_F(Binding, AStandardLightWithItsParametersStandsInForOneThatIsMissing) {
  const auto lit = [&](const std::string& name, const ParamList& params, bool placed = false) {
    shading.reset();
    scene.objects.clear();
    scene.lights.clear();
    attributes.lights = {};
    LightCall& call = light(name, params);
    if (placed) call.shader.worldFromShader.keys[0][3] = vec4(0, 0, 3, 1);
    surface("matte");
    return shadeOne().x;  // P = (0, 0, 5) faces the camera
  };
  const Param from = point("from", {0, 0, 3}), to = point("to", {0, 0, 9}), bright = number("intensity", 2);
  EXPECT_FLOAT_EQ(lit("nosuch", {bright, number("fuzz", 1)}), 2) << "ambient";
  EXPECT_FLOAT_EQ(lit("nosuch", {bright}, true), 0.5f) << "a point where it is placed";
  EXPECT_FLOAT_EQ(lit("nosuch", {bright, from}), 0.5f) << "a point";
  EXPECT_FLOAT_EQ(lit("nosuch", {bright, from, to}), 2) << "parallel";
  EXPECT_FLOAT_EQ(lit("nosuch", {bright, from, to, number("coneangle", 0.3f)}), 0.5f) << "a spot";
  EXPECT_FLOAT_EQ(lit("nosuch", {bright, from, point("to", {0, 0, 1}), number("coneangle", 0.3f)}), 0) << "averted";
  EXPECT_FLOAT_EQ(lit("MySpotLight", {bright, from, to}), 0.5f) << "by its name";
  EXPECT_FLOAT_EQ(lit("softAmbient", {bright}, true), 2) << "by its name";
  EXPECT_FLOAT_EQ(lit("causticlight", {bright}), 0) << "it brings what other lights have sent";
  EXPECT_EQ(log.worst(), Severity::Missing);
  EXPECT_EQ(log.count("shader-parameter-unknown"), 0) << "what only the missing shader has";
}

TEST_F(Binding, AnAreaLightStandsInForAMissingLightWithGeometryUnlessItBringsIndirectLight) {
  ShaderCall call;
  for (const auto& [name, instead] : {std::pair("nosuch", "arealight"), {"spotty", "arealight"}, {"myCaustic", ""}}) {
    call.name = name;
    EXPECT_STREQ(standardLightFor(call, true), instead) << name;
  }
}

TEST_F(Binding, BeginningsAndEndsOfTheWordsOfAMissingLightsNameSayWhichStandardLightItIs) {
  ShaderCall call;
  for (const auto& [name, instead] : {std::pair("spot", "spotlight"),
                                      {"keySpot2", "spotlight"},
                                      {"RTSpotLight", "spotlight"},
                                      {"shadowspot", "spotlight"},
                                      {"my_point_light", "pointlight"},
                                      {"mypointlights", "pointlight"},
                                      {"mydomelight", "ambientlight"},
                                      {"sun1", "distantlight"},
                                      {"environment", "ambientlight"},
                                      {"env2light", "ambientlight"},
                                      {"superspot", "spotlight"},
                                      {"pointnofalloff", "pointlight"},
                                      {"lightspot", "spotlight"},
                                      {"sunshine", "distantlight"},
                                      {"respotted", "ambientlight"},
                                      {"appointments", "ambientlight"},
                                      {"photonmap", ""},
                                      {"mycausticsmap", ""},
                                      {"indirectdiffuse", ""}}) {
    call.name = name;
    EXPECT_STREQ(standardLightFor(call, false), instead) << name;
  }
}

TEST_F(Binding, UnknownAndMistypedParametersAreWarnedAboutAndDefaulted) {
  surface("matte", {number("Kx", 3), number("Ky", 3), color("Kd", {2, 2, 2})});
  light("distantlight");
  expectColor(shadeOne(), vec3(1));
  EXPECT_EQ(log.entries().size(), 3u);
  EXPECT_EQ(log.worst(), Severity::Warning);
  EXPECT_EQ(log.count("shader-parameter-unknown"), 2);
  EXPECT_EQ(log.count("shader-parameter-type"), 1);
}

TEST_F(Binding, ANearNameIsSaidOfAParameterThatNoShaderHas) {
  surface("matte", {number("Kdd", 3), number("fuzziness", 3)});
  shadeOne();
  ASSERT_EQ(log.entries().size(), 2u);
  EXPECT_NE(log.entries()[0].message.find("did you mean \"Kd\"?"), std::string::npos) << log.entries()[0].message;
  EXPECT_EQ(log.entries()[1].message.find("did you mean"), std::string::npos);
}

TEST_F(Binding, WhatAPrimitiveHasAndTheShaderHasNotIsNoMistake) {
  Param ofPrimitive = number("Kx", 3);
  ofPrimitive.storage = Storage::Constant;
  surface("matte", {ofPrimitive});
  shadeOne();
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Binding, WhatPhotonsReadOfAMediumIsKnownToEveryVolumeShader) {
  surface("matte");
  attributes.interior = std::make_shared<ShaderCall>(
      call("fog", {color("scattering", {1, 1, 1}), color("absorption", {0, 0, 0}), number("density", 1)}));
  shadeOne();
  EXPECT_EQ(log.entries().size(), 1u);
  EXPECT_EQ(log.count("shader-parameter-unknown"), 1);
}

Param given(ValueType type, std::vector<float> floats) {
  Param p;
  p.name = "x";
  p.type = type;
  p.floats = std::move(floats);
  return p;
}

TEST(ParameterValues, WhatNothingDeclaresIsWhatTheShaderSays) {
  const auto bare = [](ValueType type, std::vector<float> floats) {
    Param p = given(type, std::move(floats));
    p.arrayLength = 0;
    return p;
  };
  struct Case {
    int32_t type;
    Param from;
    std::vector<float> to;
    bool remarked;
  };
  const std::vector<Case> cases = {
      {TM_COLOR, bare(ValueType::Float, {1, 2, 3}), {1, 2, 3}, false},
      {TM_COLOR, bare(ValueType::Float, {2}), {2, 2, 2}, false},
      {TM_NORMAL, bare(ValueType::Color, {1, 2, 3}), {1, 2, 3}, false},
      {TM_FLOAT, bare(ValueType::Float, {7}), {7}, false},
      {TM_COLOR, bare(ValueType::Float, {1, 2}), {0, 0, 0}, true},
      {TM_FLOAT, bare(ValueType::Float, {1, 2}), {1}, true},
  };
  for (const Case& c : cases) {
    const ParameterValue value = parameterValue({"x", c.type, 1, nullptr, nullptr, "", TM_ROLE_NONE}, &c.from);
    EXPECT_EQ(value.floats, c.to) << c.type;
    EXPECT_EQ(!value.remark.empty(), c.remarked) << value.remark;
  }
  Param number = bare(ValueType::Float, {1});
  EXPECT_FALSE(parameterValue({"x", TM_STRING, 1, nullptr, nullptr, "", TM_ROLE_NONE}, &number).remark.empty());
}

TEST(ParameterValues, NumbersAreConvertedWhereTheSpecificationAllows) {
  const float half[] = {0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f};
  using V = std::vector<float>;
  struct Case {
    int32_t type;
    int length;
    Param from;
    V to;
    bool remarked;
  };
  Param integer;
  integer.type = ValueType::Integer;
  integer.ints = {7};
  Param word;
  word.type = ValueType::String;
  word.strings = {"red"};
  const Case cases[] = {
      {TM_FLOAT, 1, given(ValueType::Float, {3}), {3}, false},
      {TM_FLOAT, 1, integer, {7}, false},
      {TM_COLOR, 1, given(ValueType::Color, {1, 2, 3}), {1, 2, 3}, false},
      {TM_NORMAL, 1, given(ValueType::Point, {1, 2, 3}), {1, 2, 3}, false},
      {TM_COLOR, 1, given(ValueType::Float, {3}), {3, 3, 3}, true},
      {TM_COLOR, 1, given(ValueType::Float, {1, 2, 3}), {1, 2, 3}, true},
      {TM_COLOR, 1, given(ValueType::Point, {1, 2, 3}), {1, 2, 3}, true},
      {TM_POINT, 1, given(ValueType::HPoint, {2, 4, 6, 2}), {1, 2, 3}, true},
      {TM_MATRIX, 1, given(ValueType::Float, {2}), {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2}, true},
      {TM_FLOAT, 3, given(ValueType::Color, {1, 2, 3}), {1, 2, 3}, true},
      {TM_FLOAT, 3, given(ValueType::Float, {1, 2}), {1, 2, 0.5f}, true},
      {TM_FLOAT, 1, given(ValueType::Float, {1, 2}), {1}, true},
      // Nothing says which component a float would take, what a word is worth, or what two numbers are of three.
      {TM_FLOAT, 1, given(ValueType::Color, {1, 2, 3}), {0.5f}, true},
      {TM_FLOAT, 1, word, {0.5f}, true},
      {TM_COLOR, 1, given(ValueType::Float, {1, 2}), {0.5f, 0.5f, 0.5f}, true},
      {TM_COLOR, 1, given(ValueType::Matrix, V(16, 1.0f)), {0.5f, 0.5f, 0.5f}, true},
  };
  for (const Case& c : cases) {
    const ParameterValue value = parameterValue({"x", c.type, c.length, half, nullptr, "", TM_ROLE_NONE}, &c.from);
    const std::string what = std::to_string(c.type) + " from " + std::to_string(static_cast<int>(c.from.type));
    EXPECT_EQ(value.floats, c.to) << what;
    EXPECT_EQ(!value.remark.empty(), c.remarked) << what << ": " << value.remark;
  }
}

// --- Parameters of all shapes, as the C++ face gives them

rsl::FloatArrayParam floats("floats", {1, 2, 3}, "");
rsl::ColorArrayParam colors("colors", {{1, 0, 0}, {0, 1, 0}}, "");
rsl::StringArrayParam words("words", {"one", "two"}, "");
rsl::MatrixParam matrix("matrix", "");
rsl::UniformFloatParam count("count", 5, "");

std::vector<std::string> heard;
void shadeShapes(const TmGrid* g) {
  heard = {words(g, 0), words(g, 1)};
  EXPECT_EQ(floats.length(g) + words.length(g), 5);
  for (int i : rsl::Batch(g)) {
    rsl::set(g->Ci, i, {floats(g, 2), colors(g, 1).y, count(g)});
    rsl::set(g->Oi, i, {matrix(g)[12], matrix(g)[13], matrix(g)[14]});
  }
}
const rsl::Shader shapesShader(TM_SURFACE, "shapes", "", 0, shadeShapes, {&floats, &colors, &words, &matrix, &count});

class Shapes : public Stage {
 protected:
  Shapes() {
    static const TmShader* const shaders[] = {shapesShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
  }
};

TEST_F(Shapes, ArraysAndMatricesHaveDefaultsAndValues) {
  surface("shapes");
  expectColor(shadeOne(), {3, 1, 5});
  EXPECT_EQ(heard, (std::vector<std::string>{"one", "two"}));
  Param array = given(ValueType::Float, {4, 5, 6}), pair = given(ValueType::Color, {0, 0, 0, 0, 7, 0}),
        m = given(ValueType::Matrix, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2, 3, 4, 1});
  array.name = "floats";
  pair.name = "colors";
  m.name = "matrix";
  Param said;
  said.name = "words";
  said.type = ValueType::String;
  said.strings = {"", "three"};
  shading.reset();
  scene.objects.clear();
  surface("shapes", {array, pair, m, said, number("count", 9)});
  const ShadedPoints out = shade(points({vec3(0, 0, 5)}));
  expectColor(out.color(0), {6, 7, 9});
  expectColor(out.opacity(0), {2, 3, 4});
  EXPECT_EQ(heard, (std::vector<std::string>{"", "three"}));
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(Shapes, AUniformParameterIsNotOverriddenByPrimitiveVariablesAndThisIsSaid) {
  surface("shapes");
  primvar("count", ValueType::Float);
  ShadePoints p = points({vec3(0, 0, 5)});
  p.primvar(0)[0] = 100;
  EXPECT_EQ(shade(p).color(0).z, 5);
  EXPECT_EQ(log.count("shader-parameter-uniform"), 1);
}

TEST(ParameterValues, StringsStayStrings) {
  const char* defaults[] = {"a", "b"};
  Param p = given(ValueType::Float, {1});
  EXPECT_EQ(parameterValue({"x", TM_STRING, 2, nullptr, defaults, "", TM_ROLE_NONE}, &p).strings,
            (std::vector<std::string>{"a", "b"}));
  p = Param{};
  p.type = ValueType::String;
  p.strings = {"c"};
  const ParameterValue value = parameterValue({"x", TM_STRING, 2, nullptr, defaults, "", TM_ROLE_NONE}, &p);
  EXPECT_EQ(value.strings, (std::vector<std::string>{"c", "b"}));
  EXPECT_FALSE(value.remark.empty());
}

TEST_F(Binding, ASurfaceForIndirectRaysReplacesTheVisibleOne) {
  surface("matte");
  attributes.indirect.surface = "constant";
  ShadeContext gather;
  gather.kind = RayKind::Diffuse;
  expectColor(shadeOne(), vec3(0.0f));
  expectColor(shadeOne(gather), vec3(1.0f));
}

TEST_F(Binding, PaintedPlasticMultipliesByTheTextureAndAMissingOneIsMagenta) {
  const std::array top{1.0f, 0.5f, 0.25f}, bottom{0.0f, 0.0f, 1.0f};
  const std::string path = writePicture(test::temporary("tomales_shade_texture.exr"), 8, 8, "RGB",
                                        [&](int, int y) { return y < 4 ? top : bottom; });
  surface("paintedplastic", {number("Ks", 0), number("Kd", 1), text("texturename", path)});
  light("distantlight");
  ShadePoints p = points({vec3(0, 0, 5), vec3(0, 0, 5)});
  p.channel(kS)[0] = p.channel(kS)[1] = 0.5f;
  p.channel(kT)[0] = 0.25f;
  p.channel(kT)[1] = 0.75f;
  const ShadedPoints out = shade(p);
  expectColor(out.color(0), {1, 0.5f, 0.25f});  // t runs down the picture
  expectColor(out.color(1), {0, 0, 1});
  EXPECT_EQ(stats.textures.lookups, 2);

  shading.reset();
  scene.objects.clear();
  surface("paintedplastic", {number("Ks", 0), number("Kd", 1), text("texturename", "absent.tif")});
  expectColor(shadeOne(), {1, 0, 1});
  shadeOne();
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_EQ(log.entries()[0].severity, Severity::Missing);
  EXPECT_EQ(log.entries()[0].count, 2);
  std::filesystem::remove(path);
}

TEST_F(Binding, CountsOfLightsAreLimitedAndItIsSaid) {
  light("indirectlight", {number("samples", 1e9f), number("bounces", -1e30f)});
  ASSERT_TRUE(system().group(0).indirectQuery());
  EXPECT_EQ(system().group(0).indirectQuery()->samples, 65536);
  EXPECT_EQ(system().group(0).indirectQuery()->bounces, 0);
  EXPECT_EQ(log.count("light-value"), 2);
}

TEST(ParameterValues, OfATypeMayBeGivenAsThoseThatNeedNoConversion) {
  const ValueType all[] = {ValueType::Float,  ValueType::Integer, ValueType::Color,
                           ValueType::Point,  ValueType::Vector,  ValueType::Normal,
                           ValueType::HPoint, ValueType::String,  ValueType::Matrix};
  const std::pair<int32_t, std::vector<ValueType>> rows[] = {
      {TM_FLOAT, {ValueType::Float, ValueType::Integer}},
      {TM_COLOR, {ValueType::Color}},
      {TM_POINT, {ValueType::Point, ValueType::Vector, ValueType::Normal}},
      {TM_NORMAL, {ValueType::Point, ValueType::Vector, ValueType::Normal}},
      {TM_STRING, {ValueType::String}},
      {TM_MATRIX, {ValueType::Matrix}}};
  for (const auto& [type, taken] : rows)
    for (const ValueType given : all)
      EXPECT_EQ(accepts(type, given), std::find(taken.begin(), taken.end(), given) != taken.end())
          << typeName(type) << " from " << nameOf(given);
  EXPECT_STREQ(typeName(TM_MATRIX + 1), "unknown type");
  EXPECT_EQ(valueTypeOf(-1), ValueType::Float);
  EXPECT_EQ(tmTypeOf(ValueType::Integer), TM_FLOAT);
}

TEST_F(Binding, AnIndirectLightAsksWhatItsParametersSay) {
  light("indirectlight", {number("samples", 77), number("maxerror", 0.25f), number("maxdist", 9),
                          text("subset", "near"), text("errorfunction", "ward"), number("bounces", 3)});
  const IndirectQuery* query = system().group(0).indirectQuery();
  ASSERT_TRUE(query);
  EXPECT_EQ(query->samples, 77);
  EXPECT_EQ(query->maxError, 0.25f);
  EXPECT_EQ(query->maxDistance, 9);
  EXPECT_EQ(query->subset, "near");
  EXPECT_EQ(query->errorFunction, errorFunctionNamed("ward"));
  EXPECT_EQ(query->bounces, 3);
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Binding, ACountOfALightThatIsNoNumberIsItsDefault) {
  light("indirectlight", {number("samples", std::nanf(""))});
  EXPECT_EQ(system().group(0).indirectQuery()->samples, IndirectQuery().samples);
  EXPECT_EQ(log.count("light-value"), 1);
}

TEST_F(Binding, WhatAnIndirectLightCannotDoIsSaidOnce) {
  light("indirectlight", {text("errorfunction", "guess"), text("radiance", "guess")});
  system();
  EXPECT_EQ(log.count("light-value"), 2);
  EXPECT_EQ(log.entries().size(), 2u);
}

TEST_F(Binding, EveryRadianceThatGatherRaysMaySeeIsKnownAndSoIsTheAtlas) {
  for (const char* name : {"shader", "radiosity", "atlas", "points"})
    light("indirectlight", {text("radiance", name), text("atlas", "maps")});
  ASSERT_TRUE(system().indirectRequest());
  EXPECT_EQ(system().indirectRequest()->method, giMethodNamed("radiosity")) << "the first that says so";
  EXPECT_EQ(system().indirectRequest()->atlas, "maps");
  EXPECT_FALSE(system().indirectRequest()->bounces) << "photons have their own number unless the scene says one";
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Binding, AnIndirectLightIsAddedForAllObjectsWhereOneIsWantedAndNoneIsThere) {
  scene.options.wantsIndirect = true;
  light("ambientlight");
  EXPECT_TRUE(system().group(0).indirectQuery());
  EXPECT_TRUE(system().indirectRequest());
}

TEST_F(Binding, NoIndirectLightIsAddedBesideOneThatIsThere) {
  scene.options.wantsIndirect = true;
  light("indirectlight", {number("samples", 77)});
  attributes.lights.clear();
  system();
  EXPECT_FALSE(system().group(0).indirectQuery()) << "it is switched off for this object";
}

TEST_F(Binding, ADraftHasItsOwnNumberOfRays) {
  scene.options.indirectSamples = 50;
  light("indirectlight", {number("samples", 600)});
  ASSERT_TRUE(system().group(0).indirectQuery());
  EXPECT_EQ(system().group(0).indirectQuery()->samples, 50);
}

TEST_F(Binding, EveryErrorFunctionIsKnown) {
  for (const char* name : {"screen", "ward", "hessian", "split", "plain"})
    light("indirectlight", {text("errorfunction", name)});
  system();
  EXPECT_EQ(log.count("light-value"), 0);
}

TEST_F(Binding, AnAreaLightWithoutGeometryIsReported) {
  light("arealight", {}, true);
  system();
  EXPECT_EQ(log.count("light-no-geometry"), 1);
}

TEST_F(Binding, StatisticsCountEveryPointOnceByItsShader) {
  surface("constant");
  shade(points(std::vector<vec3>(300, vec3(0, 0, 5))));
  EXPECT_EQ(stats.shade.verticesShaded, 300);
  EXPECT_EQ(stats.byShader().at("constant").vertices, 300);
}

}  // namespace
}  // namespace tomales
