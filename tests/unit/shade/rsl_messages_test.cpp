// What shaders as texts ask of each other, and what geometry and scenes give them.
#include <fstream>

#include "reyes/shader.h"
#include "tests/unit/shade/stage.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

class RslMessages : public Stage {
 protected:
  RslMessages() {
    static int count = 0;
    folder = test::temporary("rsl_messages" + std::to_string(count++));
    std::filesystem::create_directories(folder);
    scene.options.searchPaths["shader"] = folder;
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder + "/" + name + ".sl") << text;
  }
  /// The colours at u = 0 and u = 1/2.
  std::vector<vec3> colors() {
    scene.objects.clear();
    shading.reset();
    const ShadedPoints out = shade(points({vec3(0, 0, 5), vec3(0, 0, 5)}));
    return {out.color(0), out.color(1)};
  }
  std::string messageOf(const std::string& code) const {
    for (const LogEntry& e : log.entries())
      if (e.code == code) return e.message;
    return "";
  }
  std::string folder;
};

TEST_F(RslMessages, ALightLearnsTheDefaultsThatASurfaceComputes) {
  write("teller",
        "surface teller(float a = 2 * u; color c = color (u, 1, 2 * u); float list[2] = {u, 3};\n"
        "  string text = concat(\"a\", \"b\"); uniform float k = 1 + 2; matrix m = matrix (u, 0, 0, 0, 0, 1, 0, 0,\n"
        "  0, 0, 1, 0, 0, 0, 0, 1);)\n"
        "{ Oi = 1; Ci = 0; illuminance (P, N, PI / 2) Ci += Cl; }");
  write("asker",
        "light asker(float which = 0;) { float a = -1, k = -1, list[2] = {-1, -1}; color c = -1; string text = \"\";\n"
        "  matrix m = 7; surface(\"a\", a); surface(\"c\", c); surface(\"list\", list); surface(\"text\", text);\n"
        "  surface(\"k\", k); surface(\"m\", m); float none = surface(\"nothing\", a);\n"
        "  solar(vector \"current\" (0, 0, 1), 0) {\n"
        "    if (which == 0) Cl = color (a, k, list[0]); else if (which == 1) Cl = c;\n"
        "    else Cl = color (list[1], text == \"ab\" ? 1 : 0, comp(m, 0, 0) + none); } }");
  surface("teller");
  const auto asked = [&](float which) {
    scene.lights.clear();
    attributes.lights.clear();
    light("asker", {number("which", which)});
    return colors();
  };
  const std::vector<vec3> numbers = asked(0), colors = asked(1), others = asked(2);
  expectColor(numbers[0], {0, 3, 0});
  expectColor(numbers[1], {1, 3, 0.5f});
  expectColor(colors[0], {0, 1, 0});
  expectColor(colors[1], {0.5f, 1, 1});
  expectColor(others[0], {3, 1, 0});
  expectColor(others[1], {3, 1, 0.5f});
}

TEST_F(RslMessages, TheAirLearnsTheOutputsOfTheSurfaceBehindIt) {
  write("lit",
        "surface lit(output varying float o = 0; output varying color c = 0;) { o = 3 * u; c = color (u, 2, 4);\n"
        "  Oi = 1; Ci = 0; }");
  write("air",
        "volume air() { float o = -1; color c = -1; surface(\"o\", o); surface(\"c\", c);\n"
        "  Ci = color (o, comp(c, 0), comp(c, 1)) + Ci; }");
  surface("lit");
  attributes.atmosphere = std::make_shared<const ShaderCall>(call("air", {}));
  const ShadePoints p = points({vec3(0, 0, 5), vec3(0, 0, 5)});
  ShadeContext context;
  context.variables = true;
  ShadedPoints out = shade(p, context);
  system().atmosphere(p, out);
  expectColor(out.color(0), {0, 0, 2});
  expectColor(out.color(1), {1.5f, 0.5f, 2});
}

TEST_F(RslMessages, ARayGetsTheOutputsOfTheSurfaceThatItAsksForInTheirSize) {
  write("lit",
        "surface lit(output varying float o = 0; output varying color c = 0; output varying vector w = 0;)\n"
        "{ o = 3 * u; c = color (u, 2, 4); w = vector \"current\" (u, 5, 6); Oi = 1; Ci = 0; }");
  surface("lit");
  const std::vector<RayOutput> wanted = {{"surface:c", 3},       {"surface:o", 1}, {"surface:o", 3},
                                         {"surface:nothing", 1}, {"o", 1},         {"surface:w", 3}};
  ShadeContext context;
  context.outputs = &wanted;
  const ShadedPoints out = shade(points({vec3(0, 0, 5), vec3(0, 0, 5)}), context);
  ASSERT_EQ(out.variables.size(), 3u + 1 + 3 + 1 + 1 + 3);
  const auto at = [&](size_t k) { return out.variables[k][1]; };
  EXPECT_EQ(vec3(at(0), at(1), at(2)), vec3(0.5f, 2, 4));
  EXPECT_EQ(at(3), 1.5f);
  for (size_t k = 4; k < 9; ++k) EXPECT_TRUE(std::isnan(at(k))) << k << " is unknown or of another size";
  EXPECT_EQ(vec3(at(9), at(10), at(11)), vec3(0.5f, 5, 6));
}

class RslVolumes : public RslMessages {
 protected:
  static std::shared_ptr<const ShaderCall> fog(float distance, const vec3& background) {
    return std::make_shared<const ShaderCall>(
        call("fog", {number("distance", distance), color("background", background)}));
  }
  /// Two points at u = 0 and u = 1/2, of which the eye sees the first from outside and the second from inside.
  std::vector<vec3> bothSides() {
    shading.reset();
    scene.objects.clear();
    ShadePoints p = points({vec3(0, 0, 5), vec3(0, 0, 5)});
    p.set3(kNgx, 1, {0, 0, 1});
    const ShadedPoints out = shade(p);
    return {out.color(0), out.color(1)};
  }
};

TEST_F(RslVolumes, OnTheSideOfEachPointAnswer) {
  write("asker",
        "surface asker() { float near = -1, far = -1; color c = -1; incident(\"distance\", near);\n"
        "  opposite(\"distance\", far); incident(\"background\", c); Oi = 1; Ci = color (near, far, comp(c, 1)); }");
  surface("asker");
  attributes.exterior = fog(11, {1, 2, 3});
  attributes.interior = fog(13, {4, 5, 6});
  const std::vector<vec3> told = bothSides();
  expectColor(told[0], {11, 13, 2});
  expectColor(told[1], {13, 11, 5});
}

TEST_F(RslVolumes, OnTheSideOfTheFirstPointThatAsksAnswerIfTheOtherSideHasNone) {
  write("asker",
        "surface asker() { float near = -1, found = -1; if (u > 0.3) found = incident(\"distance\", near);\n"
        "  Oi = 1; Ci = color (near, found, 0); }");
  surface("asker");
  attributes.interior = fog(13, vec3(0));
  expectColor(bothSides()[1], {13, 1, 0});
  attributes.interior = nullptr;
  attributes.exterior = fog(11, vec3(0));
  expectColor(bothSides()[1], {-1, 0, 0});
}

TEST_F(RslMessages, TheSurfaceLearnsWhatTheDisplacementLeftInTheGeometry) {
  write("bump", "displacement bump(output varying color stain = 0;) { stain = 1; }");
  write("stained", "surface stained() { color c = -1; displacement(\"stain\", c); Oi = 1; Ci = c; }");
  surface("stained");
  displacement("bump");
  primvar("displacement:stain", ValueType::Color);
  ShadePoints p = points({vec3(0, 0, 5)});
  for (int k = 0; k < 3; ++k) p.primvar(k)[0] = static_cast<float>(k + 1);
  expectColor(shade(p).color(0), {1, 2, 3});
}

TEST_F(RslMessages, AnArrayOfTheGeometryIsAnArrayOfTheShader) {
  write("arrays",
        "surface arrays(varying float a[2] = {7, 7}; varying color c[2] = {0, 0};) {\n"
        "  Oi = 1; Ci = color (a[0], a[1], comp(c[1], 2)); }");
  surface("arrays");
  primvars.push_back({"a", Storage::Varying, ValueType::Float, 2, {}});
  primvars.push_back({"c", Storage::Varying, ValueType::Color, 6, {}});
  ShadePoints p = points({vec3(0, 0, 5), vec3(0, 0, 5)});
  for (int k = 0; k < 8; ++k)
    for (int i = 0; i < 2; ++i) p.primvar(k)[i] = static_cast<float>(10 * i + k);
  const ShadedPoints out = shade(p);
  expectColor(out.color(0), {0, 1, 7});
  expectColor(out.color(1), {10, 11, 17});
}

TEST_F(RslMessages, AVariableOfAnotherTypeIsToldAndAnOutputBeginsWithWhatTheSceneGives) {
  write("plain",
        "surface plain(varying float a = 0.25; output varying float o = 0.5;) { Oi = 1; Ci = color (a, o, 0); }");
  surface("plain", {number("o", 3)});
  primvar("a", ValueType::Color);
  expectColor(shade(points({vec3(0, 0, 5)})).color(0), {0.25f, 3, 0});
  EXPECT_NE(messageOf("shader-parameter-type").find("parameter \"a\" is of another type"), std::string::npos);
}

TEST_F(RslMessages, ARoleOfALightIsKnownIfItsTextComputesTheSameEverywhere) {
  const std::string body = "{ solar(vector \"current\" (0, 0, 1), 0) Cl = 1; }";
  write("fixed", "light fixed(float __nondiffuse = 2 - 1;) " + body);
  write("moving", "light moving(varying float __nondiffuse = zcomp(Ps);) " + body);
  surface("matte", {number("Ka", 0), number("Kd", 1)});
  attributes.color = vec3(1);
  light("fixed");
  expectColor(colors()[0], vec3(0));
  EXPECT_EQ(messageOf("light-value"), "");
  light("moving");
  expectColor(colors()[0], vec3(1));
  EXPECT_NE(messageOf("light-value").find("the shader computes the default of \"__nondiffuse\" when it runs"),
            std::string::npos);
}

TEST_F(RslMessages, TheRendererTellsItsVersionInNumbersAndAsText) {
  write(
      "versions",
      "surface versions() { string text = \"\"; float v[4] = {-1, -1, -1, -1}; rendererinfo(\"versionstring\", text);\n"
      "  rendererinfo(\"version\", v); string name = \"\"; rendererinfo(\"renderer\", name); Oi = 1;\n"
      "  Ci = color (text == format(\"%d.%d.%d\", v[0], v[1], v[2]) ? 1 : 0, v[3], name == \"Tomales\" ? 1 : 0); }");
  surface("versions");
  expectColor(colors()[0], {1, 0, 1});
}

/// A plane of four vertices at z = 5 that faces the eye.
Grid square(int primvarFloats = 0) {
  Grid g;
  g.object = 0;
  g.allocate(1, 1, 1, primvarFloats);
  for (int k = 0; k < 4; ++k) {
    g.u()[k] = g.P(0, 0)[k] = static_cast<float>(k % 2);
    g.v()[k] = g.P(0, 1)[k] = static_cast<float>(k / 2);
    g.P(0, 2)[k] = 5;
    g.N(2)[k] = -1;
  }
  return g;
}

TEST_F(RslMessages, ADisplacementLearnsItsOwnParameters) {
  write("push",
        "displacement push(float far = 0.5;) { float x = 0; displacement(\"far\", x); P += x * normalize(N); }");
  displacement("push", {number("far", 0.25f)});
  attributes.displacementBound = 10;
  Grid g = square();
  system().displace(g);
  for (int k = 0; k < 4; ++k) EXPECT_FLOAT_EQ(g.P(0, 2)[k], 4.75f);
}

TEST_F(RslMessages, TheGeometryKeepsWhatADisplacementTellsTheSurface) {
  write("bump",
        "displacement bump(output varying float height = 0; output varying color stain = 0;)\n"
        "{ height = 2 * u; stain = color (1, v, 3); }");
  displacement("bump");
  primvar("other", ValueType::Float);
  primvar("displacement:height", ValueType::Float);
  primvar("displacement:stain", ValueType::Color);
  Grid g = square(5);
  std::fill_n(g.primvar(0), 4, 9.0f);
  system().displace(g);
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(g.primvar(0)[k], 9);
    EXPECT_EQ(g.primvar(1)[k], 2 * g.u()[k]);
    EXPECT_EQ(vec3(g.primvar(2)[k], g.primvar(3)[k], g.primvar(4)[k]), vec3(1, g.v()[k], 3));
  }
}

TEST_F(RslMessages, DisplacementsKnowTheDirectionOfTheEyeAndTheirTextureCoordinates) {
  write("along", "displacement along() { P = P + I; N = normal \"current\" (s, t, -1); }");
  displacement("along");
  attributes.displacementBound = 100;
  attributes.textureCoordinates = {vec2{0.1f, 0.2f}, {0.3f, 0.5f}, {0.7f, 0.1f}, {0.9f, 0.8f}};
  for (const bool perspective : {false, true}) {
    scene.options.projection = perspective ? ProjectionKind::Perspective : ProjectionKind::Orthographic;
    shading.reset();
    scene.objects.clear();
    Grid g = square();
    const Grid before = square();
    system().displace(g);
    for (int k = 0; k < 4; ++k) {
      const vec3 P = before.position(0, k);
      EXPECT_EQ(g.position(0, k), P + (perspective ? P : vec3(0, 0, 1)));
      const vec2 st = attributes.textureCoordinates[static_cast<size_t>(k)];
      EXPECT_EQ(g.normal(k), vec3(st, -1));
    }
  }
}

// --- Displacements that are not finite

void tearing(const TmGrid* g) {
  for (int i : rsl::Batch(g)) {
    g->P.z[i] += 1;
    if (g->u[i] > 0.9f) g->P.x[i] = std::nanf("");
    if (g->v[i] > 0.9f) g->N.y[i] = kInfinity;
  }
}
const rsl::Shader tearingShader(TM_DISPLACEMENT, "tearing", "", 0, tearing, {});

TEST_F(RslMessages, PointsMovedToNoPlaceStayWhereTheyWere) {
  static const TmShader* const shaders[] = {tearingShader};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  displacement("tearing");
  attributes.displacementBound = 10;
  Grid g;
  g.object = 0;
  g.allocate(2, 2, 1, 0);
  for (int k = 0; k < 9; ++k) {
    g.u()[k] = g.P(0, 0)[k] = static_cast<float>(k % 3) / 2;
    g.v()[k] = g.P(0, 1)[k] = static_cast<float>(k / 3) / 2;
    g.P(0, 2)[k] = 5;
    g.N(2)[k] = -1;
  }
  system().displace(g);
  for (int k = 0; k < 9; ++k) {
    const bool stays = k % 3 == 2 || k / 3 == 2;
    EXPECT_EQ(g.position(0, k), vec3(g.u()[k], g.v()[k], stays ? 5 : 6)) << k;
    EXPECT_EQ(g.normal(k), vec3(0, 0, -1)) << k;
  }
  EXPECT_NE(messageOf("shader-not-finite").find("moved points to NaN or infinity"), std::string::npos);
}

}  // namespace
}  // namespace tomales
