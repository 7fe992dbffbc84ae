// Whole-batch values, masks, derivatives and message passing, asked for as a shader asks.
#include "reyes/sl.h"

#include <cstdlib>
#include <filesystem>

#include "tests/unit/shade/installed_headers.h"
#include "tests/unit/shade/stage.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;
using namespace sl;

// --- Shaders of this test

rsl::FloatParam lift("lift", 3, "");

/// Assignments, += and services within nested conditionals reach the points of all of them and no others.
struct conditional : sl::Surface {
  void main() {
    Float x = 0;
    If(
        u < 0.5,
        [&] {
          x = 1;
          If(
              u > 0.2, [&] { x += Float(lift); }, [&] { x += 10; });
        },
        [&] { x = 2 * u; });
    Ci = Color(x);
    Oi = Color(1);
  }
};

/// Each point goes round as often as its number says, 0 to 9; those that If leaves out do not.
rsl::FloatOutput rounds("rounds", "");
rsl::ColorOutput quotient("quotient", "");
struct loopingRounds : sl::Surface {
  void main() {
    Float n = 0, sum = 0;
    If(u >= 0.25, [&] {
      While([&] { return n < 10 * u - 0.5; },
            [&] {
              n += 1;
              While([&] { return sum < 2 * n; }, [&] { sum += 1; });
            });
    });
    output(rounds, n);
    Color q = Color(n, sum, 6) / Color(1, 2, 3);
    If(
        q == Color(3, 3, 2), [&] { q /= 2; }, [&] { q /= Color(1, 1, 2); });
    If(u > 0.65, [&] { output(quotient, q); });
    Ci = Color(n, sum, zcomp(q));
    Oi = Color(1);
  }
};

/// A masked service of every kind that has a batch: what is not asked keeps its value.
struct asking : sl::Surface {
  void main() {
    Color touched;
    If(u < 0.5, [&] {
      touched += diffuse(Normal(rsl::Vec3{0, 0, -1}));
      touched += ambient() + texture("absent.tif", s, t) + transmission(P, P + I);
      touched += Color(occlusion(P, N, 2)) + trace(P, I);
    });
    Ci = touched;
    Oi = Color(1);
  }
};

struct differing : sl::Surface {
  void main() {
    Float f = 3 * u * u + 2 * v;
    Normal bumped = calculatenormal(P + Vector(0, 0, 0.5) * u);
    Ci = Color(Du(f), Dv(f), Deriv(f, u + v));
    If(u > 0.5, [&] { Ci = Color(bumped); });
    FilterRegion region;
    region.calculate2d(f, v);
    Oi = Color(area(P), region.sides[0], 0);
  }
};

rsl::StringParam category("category", "", "");
struct choosing : sl::Surface {
  void main() {
    Color sum;
    Float samples = 0, heard = 0, dim;
    illuminance(category(grid()), P, N, rsl::kPi / 2, [&] {
      sum += Cl * dot(normalize(L), N);
      samples += 1;
      if (ask(TM_OF_LIGHT, "dimmed", dim, lightNumber)) heard += dim;
    });
    Ci = Color(xcomp(sum), samples, heard);
    Oi = Color(1);
  }
};

rsl::FloatOutput dimmed("dimmed", ""), nondiffuse("__nondiffuse", "");
void shadeTalkative(const TmGrid* g) {
  const rsl::Batch b(g);
  for (int i : b) {
    dimmed.set(g, i, 0.25f);
    nondiffuse.set(g, i, g->u[i] < 0.5f ? 1.0f : 0.0f);
    b.illuminate(i, {0, 0, -2}, {1, 1, 1});
  }
}
void shadeNanLight(const TmGrid* g) {
  const rsl::Batch b(g);
  for (int i : b) b.illuminate(i, {0, 0, -1}, {std::nanf(""), 1, 1});
}

struct curious : sl::Surface {
  void main() {
    Float rate = -1, mine = -1, frame = -1, no = -1;
    ask(TM_OF_ATTRIBUTES, "Ri:ShadingRate", rate);
    ask(TM_OF_SURFACE, "lift", mine);
    ask(TM_OF_OPTIONS, "user:shot", frame);
    EXPECT_FALSE(ask(TM_OF_ATTRIBUTES, "user:absent", no));
    EXPECT_FALSE(ask(TM_OF_LIGHT, "lift", no, 99));
    EXPECT_EQ(askText(TM_OF_RENDERER, "renderer"), "Tomales");
    EXPECT_EQ(askText(TM_OF_SURFACE, "__shadername"), "curious");
    EXPECT_EQ(askText(TM_OF_INCIDENT, "__shadername"), "fog");
    Color tint;
    EXPECT_TRUE(ask(TM_OF_ATTRIBUTES, "Ri:Color", tint));
    Ci = Color(rate, mine, frame);
    Oi = tint;
  }
};

const rsl::Shader conditionalShader(TM_SURFACE, "conditional", "", 0, sl::shade<conditional>, {&lift});
const rsl::Shader roundsShader(TM_SURFACE, "looping", "", 0, sl::shade<loopingRounds>, {&rounds, &quotient});
const rsl::Shader askingShader(TM_SURFACE, "asking", "", TM_TRACES | TM_DERIVATIVES, sl::shade<asking>, {});
const rsl::Shader differingShader(TM_SURFACE, "differing", "", TM_NEIGHBOURS, sl::shade<differing>, {});
const rsl::Shader choosingShader(TM_SURFACE, "choosing", "", 0, sl::shade<choosing>, {&category});
const rsl::Shader talkativeShader(TM_LIGHT, "talkative", "", 0, shadeTalkative, {&dimmed, &nondiffuse});
const rsl::Shader nanShader(TM_LIGHT, "nanlight", "", 0, shadeNanLight, {});
rsl::FloatParam lift2("lift", 3, "");
const rsl::Shader curiousShader(TM_SURFACE, "curious", "", 0, sl::shade<curious>, {&lift2});

class Sl : public Stage {
 protected:
  Sl() {
    static const TmShader* const shaders[] = {conditionalShader, askingShader, differingShader, choosingShader,
                                              talkativeShader,   nanShader,    curiousShader,   roundsShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
  }
};

TEST_F(Sl, ConditionalsAssignWhereTheyHold) {
  surface("conditional");
  const ShadedPoints out = shade(points(std::vector<vec3>(10, vec3(0, 0, 5))));
  for (int i = 0; i < 10; ++i) {
    const float at = static_cast<float>(i) / 10;
    EXPECT_FLOAT_EQ(out.color(i).x, at < 0.5f ? (at > 0.2f ? 4 : 11) : 2 * at) << i;
  }
}

TEST_F(Sl, LoopsGoOnForThePointsForWhichTheirConditionHolds) {
  surface("looping");
  const ShadedPoints out = shade(points(std::vector<vec3>(10, vec3(0, 0, 5))));
  for (int i = 0; i < 10; ++i) {
    const float n = i < 3 ? 0.0f : static_cast<float>(i);
    expectColor(out.color(i), {n, 2 * n, 1});
  }
}

TEST_F(Sl, OutputsAreStoredWhereTheyAreWanted) {
  surface("looping");
  for (const char* name : {"rounds", "quotient"})
    scene.options.channels[name] = {name, *name == 'r' ? ValueType::Float : ValueType::Color, {}, at(3)};
  scene.options.displays.push_back({"a.exr", "openexr", "rounds,quotient", {}, {}});
  ShadeContext context;
  context.variables = true;
  const ShadedPoints out = shade(points(std::vector<vec3>(10, vec3(0, 0, 5))), context);
  ASSERT_EQ(out.variables.size(), 4u);
  EXPECT_EQ(out.variables[0][8], 8);
  EXPECT_EQ(out.variables[1][8], 8) << "where the mask lets it";
  EXPECT_EQ(out.variables[1][6], 0);
  EXPECT_EQ(out.variables[3][8], 1);
}

TEST_F(Sl, AVaryingParameterIsReadPointByPoint) {
  primvar("lift", ValueType::Float);
  surface("conditional");
  ShadePoints p = points(std::vector<vec3>(10, vec3(0, 0, 5)));
  for (int i = 0; i < 10; ++i) p.primvar(0)[i] = static_cast<float>(100 * i);
  EXPECT_FLOAT_EQ(shade(p).color(4).x, 401);
}

TEST_F(Sl, ServicesAreNotAskedForPointsOutsideOfTheMask) {
  surface("asking");
  light("distantlight").castsShadows = true;
  services.met = [](const vec3&, const vec3&) { return 1.0f; };
  const ShadedPoints out = shade(points(std::vector<vec3>(8, vec3(0, 0, 5))));
  for (int i = 4; i < 8; ++i) expectColor(out.color(i), vec3(0));
  for (int i = 0; i < 4; ++i) EXPECT_GT(out.color(i).x, 0);
  EXPECT_EQ(services.shadowRays, 4 + 4) << "of diffuse and of transmission";
  EXPECT_EQ(stats.textures.lookups, 0);
}

TEST_F(Sl, DerivativesAreCentredDifferencesOverTheMicropolygon) {
  surface("differing");
  system();
  ASSERT_TRUE(system().group(0).wantsSteps());
  ShadePoints p(0, 0, true);
  const float du = 0.02f, dv = 0.05f;
  for (int k = 0; k < 20; ++k) {
    const int i = p.add(static_cast<uint32_t>(k));
    const float u = static_cast<float>(k) / 20, v = 0.3f;
    p.channel(kU)[i] = u;
    p.channel(kV)[i] = v;
    p.channel(kDu)[i] = du;
    p.channel(kDv)[i] = dv;
    p.step(kStepU, false)[i] = du;
    p.step(kStepV, true)[i] = dv;
    p.set3(kPx, i, {2 * u, 4 * v, 5});
    p.set3(kDpduX, i, {2, 0, 0});
    p.set3(kDpdvX, i, {0, 4, 0});
    p.set3(kNx, i, {0, 0, -1});
    p.set3(kNgx, i, {0, 0, -1});
    p.set3(kIx, i, p.position(i));
  }
  const ShadedPoints out = shade(p);
  for (int i = 0; i < 20; ++i) {
    const float u = static_cast<float>(i) / 20;
    // z = u / 2 over x = 2u: the normal leans by 1 in 4 (unit length, on the side of Ng).
    expectColor(out.color(i), u > 0.5f ? glm::normalize(vec3(0.25f, 0, -1)) : vec3(6 * u, 2, 6 * u + 2), 2e-3f);
    EXPECT_NEAR(out.opacity(i).x, 2 * du * 4 * dv, 1e-5f);
    EXPECT_NEAR(out.opacity(i).y, 6 * u * du, 1e-4f);
  }
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Sl, CategoriesChooseLightsAndLightsAreAsked) {
  light("distantlight", {text("__category", "key,warm")});
  light("talkative", {text("__category", "fill")});
  const auto chosen = [&](const std::string& expression) {
    shading.reset();
    scene.objects.clear();
    surface("choosing", {text("category", expression)});
    return shade(points(std::vector<vec3>(1, vec3(0, 0, 5)))).color(0);
  };
  expectColor(chosen(""), {2, 2, 0.25f});
  expectColor(chosen("key"), {1, 1, 0});
  expectColor(chosen("-key"), {1, 1, 0.25f});
  expectColor(chosen("warm&-fill"), {1, 1, 0});
  expectColor(chosen("warm&fill"), {0, 0, 0});
  expectColor(chosen("fill|warm"), {2, 2, 0.25f});
}

TEST_F(Sl, AnOutputOfALightTakesItOutOfDiffusePointByPoint) {
  surface("matte");
  light("talkative");
  const ShadedPoints out = shade(points(std::vector<vec3>(4, vec3(0, 0, 5))));
  expectColor(out.color(0), vec3(0));
  expectColor(out.color(3), vec3(1));
}

TEST_F(Sl, ALightThatReturnsNanIsDarkAndNamed) {
  surface("matte");
  light("nanlight");
  light("distantlight");
  expectColor(shadeOne(), vec3(1));
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_EQ(log.entries()[0].code, "shader-not-finite");
}

TEST_F(Sl, ShadersLearnOfAttributesOptionsAndEachOther) {
  attributes.shadingRate = 7;
  attributes.color = {0.5f, 0.25f, 1};
  attributes.exterior = std::make_shared<const ShaderCall>(call("fog", {}));
  scene.options.user["user:shot"] = number("shot", 12);
  surface("curious", {number("lift", 5)});
  const ShadedPoints out = shade(points({vec3(0, 0, 5)}));
  expectColor(out.color(0), {7, 5, 12});
  expectColor(out.opacity(0), attributes.color);
}

TEST_F(Sl, TheRispecExponentIsAnOption) {
  const auto shine = [&] {
    shading.reset();
    scene.objects.clear();
    surface("metal", {number("roughness", 0.5f), number("Ka", 0)});
    return shade(points({vec3(0, 0, 5)}, glm::normalize(vec3(0.5f, 0, -1)))).color(0).x;
  };
  light("distantlight");
  const float cosine = glm::normalize(vec3(0.5f, 0, -1)).z;
  EXPECT_NEAR(shine(), std::pow(-cosine, 16.0f), 1e-4f);
  scene.options.user["shade:specular"] = text("specular", "rispec");
  EXPECT_NEAR(shine(), std::pow(-cosine, 2.0f), 1e-4f);
}

TEST_F(Sl, WhatRaysBringCrossesTheVolumeOfItsSide) {
  surface("mirror");
  attributes.exterior =
      std::make_shared<const ShaderCall>(call("fog", {number("distance", 2), color("background", {0, 1, 0})}));
  attributes.interior =
      std::make_shared<const ShaderCall>(call("fog", {number("distance", 2), color("background", {1, 0, 0})}));
  services.met = [](const vec3&, const vec3&) { return 3.0f; };
  expectColor(shadeOne(), {0, 1 - std::exp(-1.5f), 0}, 1e-5f);
}

// What is met at a distance of 3 is seen through fog; what is behind everything is not told.
void gathering(const TmGrid* g) {
  rsl::Vec3Array through(g), opacity(g), bare(g);
  rsl::Array worn(g), effective(g);
  std::vector<uint8_t> hit(static_cast<size_t>(g->padded), uint8_t{7});
  const TmChannel outputs[] = {{"volume:Ci", through},
                               {"volume:Oi", opacity},
                               {"surface:Ci", bare},
                               {"surface:worn", {worn.data(), nullptr, nullptr}},
                               {"effectivedistance", {effective.data(), nullptr, nullptr}}};
  for (const int i : {0, 1}) through.set(i, {9, 9, 9});
  EXPECT_TRUE(g->call->gather(g->host, g, nullptr, rsl::view(g->P), rsl::view(g->N), 0, hit.data(), outputs, 5));
  EXPECT_EQ(hit[0], 1);
  EXPECT_EQ(hit[1], 0);
  EXPECT_EQ(through[1].x, 9);
  EXPECT_EQ(opacity[0].x, 1);
  EXPECT_EQ(bare[0].x, 0.5f);
  EXPECT_EQ(worn[0], 1);
  EXPECT_EQ(effective[0], 6);
  EXPECT_GE(effective[1], 1e30f);
  rsl::set(g->Ci, 0, through[0]);
}
const rsl::Shader gatheringShader(TM_SURFACE, "gathering", "", TM_TRACES, gathering, {});

TEST_F(Sl, GatherTellsWhatIsMetBeforeAndBehindTheVolumeOfItsSide) {
  static const TmShader* const shaders[] = {gatheringShader};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  surface("gathering");
  attributes.exterior =
      std::make_shared<const ShaderCall>(call("fog", {number("distance", 2), color("background", {0, 1, 0})}));
  services.met = [](const vec3& P, const vec3&) { return P.x > 0 ? kInfinity : 3.0f; };
  services.seen = [](const vec3&) { return vec3(0.5f); };
  const float passes = std::exp(-1.5f);
  expectColor(shade(points({vec3(0, 0, 5), vec3(1, 0, 5)})).color(0),
              passes * vec3(0.5f) + (1 - passes) * vec3(0, 1, 0));
}

// Every example of the documentation, compiled as a user would: against the installed headers and nothing else.
TEST_F(Sl, TheExamplesCompileOutOfTree) {
  const fs::path folder = test::temporary("tomales_examples"), source = TOMALES_SOURCE_DIR;
  fs::remove_all(folder);
  installHeaders(folder / "include");
  std::vector<fs::path> examples = {source / "docs/example_plugin/kinds.cpp",
                                    source / "docs/example_plugin/lacquer.cpp"};
  for (const auto& entry : fs::directory_iterator(source / "docs/rsl_plugins"))
    if (entry.path().extension() == ".cpp") examples.push_back(entry.path());
  EXPECT_EQ(examples.size(), 9u);
  for (const fs::path& example : examples) {
    const fs::path plugin = folder / example.filename().replace_extension(".so");
    const std::string command = std::string(TOMALES_CXX) +
                                " -std=c++17 -Wall -Wextra -Wshadow -Werror -shared -fPIC -I" +
                                (folder / "include").string() + " -o " + plugin.string() + " " + example.string();
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    EXPECT_TRUE(registry.loadPlugin(plugin.string()));
  }
  surface("wood");
  displacement("ripple");
  light("flame", {point("from", {0, 0, -1})});
  attributes.atmosphere = std::make_shared<const ShaderCall>(call("murk", {}));
  const ShadedPoints out = shade(points({vec3(0.2f, 0, 5), vec3(0.4f, 0, 5)}));
  EXPECT_GT(out.color(0).x, 0);
  EXPECT_NE(out.color(0), out.color(1));
  EXPECT_EQ(log.entries().size(), 0u);
}

}  // namespace
}  // namespace tomales
