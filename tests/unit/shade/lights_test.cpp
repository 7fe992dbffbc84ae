#include "reyes/shade/light_services.h"
#include "reyes/shader.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

using Lights = Stage;

TEST_F(Lights, MatteUnderADistantLightIsCsKdCosine) {
  attributes.color = {0.5f, 0.25f, 1};
  surface("matte", {number("Kd", 0.8f)});
  const float angle = 1.0f;
  light("distantlight",
        {point("from", {0, 0, 0}), point("to", {std::sin(angle), 0, std::cos(angle)}), number("intensity", 2)});
  expectColor(shadeOne(), attributes.color * 0.8f * 2.0f * std::cos(angle));
  expectColor(shade(points({vec3(0, 0, 5)})).opacity(0), vec3(1));
}

TEST_F(Lights, AmbientLightReachesAmbientAloneAndOpacityPremultiplies) {
  attributes.opacity = {0.5f, 0.25f, 1};
  surface("matte", {number("Ka", 0.5f)});
  light("ambientlight", {color("lightcolor", {1, 2, 3})});
  expectColor(shadeOne(), attributes.opacity * 0.5f * vec3(1, 2, 3));
}

TEST_F(Lights, PointLightFallsOffWithTheSquareOfDistance) {
  surface("matte");
  light("pointlight", {number("intensity", 12)});
  const ShadedPoints out = shade(points({vec3(0, 0, 1), vec3(0, 0, 2), vec3(0, 0, 4)}));
  expectColor(out.color(0), vec3(12.0f));
  expectColor(out.color(1), vec3(3.0f));
  expectColor(out.color(2), vec3(0.75f));
}

TEST_F(Lights, PointsAmongTheParametersOfALightAreInShaderSpace) {
  surface("matte");
  scene.cameraFromWorld = Motion::still(mat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 3, 1));
  light("pointlight", {number("intensity", 1)});
  expectColor(shade(points({vec3(0, 0, 5)})).color(0), vec3(0.25f));  // the world origin lies at z = 3
}

TEST_F(Lights, SpotlightIsFullInsideItsConeAndDarkOutside) {
  surface("matte");
  light("spotlight", {number("coneangle", 0.5f), number("conedeltaangle", 0.1f), number("beamdistribution", 3)});
  const auto under = [](float angle) { return vec3(10 * std::tan(angle), 0, 10); };
  const ShadedPoints out = shade(points({under(0), under(0.39f), under(0.45f), under(0.501f)}));
  const auto full = [](float angle) { return std::pow(std::cos(angle), 3.0f + 1 + 2) / 100; };
  EXPECT_NEAR(out.color(0).x, full(0), 1e-6f);
  EXPECT_NEAR(out.color(1).x, full(0.39f), 1e-6f);
  const float t = (std::cos(0.45f) - std::cos(0.5f)) / (std::cos(0.4f) - std::cos(0.5f));
  EXPECT_NEAR(out.color(2).x, full(0.45f) * t * t * (3 - 2 * t), 1e-6f);
  EXPECT_EQ(out.color(3).x, 0);
}

TEST_F(Lights, HighlightsHaveThePrmanExponent) {
  surface("metal", {number("roughness", 0.2f)});
  const float angle = 0.6f;
  light("distantlight", {point("to", {std::sin(angle), 0, std::cos(angle)})});
  EXPECT_NEAR(shadeOne().x, std::pow(std::cos(angle / 2), 8 / 0.2f), 1e-5f);
}

TEST_F(Lights, DiffuseRaysSeeTheHighlightsThatTheyAskFor) {
  surface("plastic", {number("Kd", 0.5f), number("Ks", 1)});
  light("distantlight");
  expectColor(shadeOne(), vec3(1.5f));
  ShadeContext gather;
  gather.kind = RayKind::Diffuse;
  expectColor(shadeOne(gather), vec3(0.5f));
  gather.highlights = HitHighlights::OfSpecular;
  expectColor(shadeOne(gather), vec3(1.5f));
}

TEST_F(Lights, LightingChoosesBetweenDirectAndIndirect) {
  surface("matte");
  light("distantlight", {text("lighting", "indirect"), number("intensity", 2)});
  light("distantlight", {text("lighting", "direct"), number("intensity", 3)});
  light("distantlight", {text("lighting", "both"), number("intensity", 5)});
  ShadeContext gather;
  gather.kind = RayKind::Diffuse;
  expectColor(shadeOne(), vec3(8));
  expectColor(shadeOne(gather), vec3(7));
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Lights, ShadowsOfAPointLightNeedTheAttribute) {
  surface("matte");
  services.visible = [](const vec3&, const vec3&) { return 0.25f; };
  light("distantlight");
  light("distantlight").castsShadows = true;
  expectColor(shadeOne(), vec3(1.25f));
  EXPECT_TRUE(services.lastSolar);
  EXPECT_EQ(services.shadowRays, 1);
}

TEST_F(Lights, WithoutServicesLightIsUnshadowedAndAreaLightsAreDark) {
  surface("matte");
  light("distantlight").castsShadows = true;
  light("arealight", {}, true);
  light("indirectlight");
  system().setServices(nullptr);
  expectColor(shadeOne(), vec3(1));
}

TEST_F(Lights, ShadowsOfMapsThatCannotBeReadAreTraced) {
  surface("matte");
  services.visible = [](const vec3&, const vec3&) { return 0.25f; };
  const auto to = point("to", {0, 0, 9});
  light("shadowdistant", {to, text("shadowname", "sun.shd")});
  light("shadowpoint", {number("intensity", 25), text("sfpx", "a.shd")});
  light("shadowspot", {number("intensity", 25), to, text("shadowname", "raytrace")});
  light("shadowspot", {number("intensity", 25), to});
  expectColor(shadeOne(), vec3(3 * 0.25f + 1));
  EXPECT_EQ(services.shadowRays, 3);
  EXPECT_EQ(log.count("shadow-map"), 2);
  EXPECT_TRUE(system().needsRays());
}

TEST_F(Lights, IndirectLightGivesItsIrradianceBackToDiffuse) {
  attributes.color = {0.5f, 0.25f, 1};
  services.E = {1, 2, 3};
  for (int k = 0; k < 3; ++k) services.dominant[k] = glm::normalize(vec3(static_cast<float>(k), 1, -1));
  surface("matte", {number("Kd", 0.5f)});
  light("indirectlight");
  expectColor(shadeOne(), attributes.color * 0.5f * services.E, 2e-6f);
  EXPECT_EQ(services.gathers, 1);  // one gather serves three colours
  shading.reset();
  scene.objects.clear();
  surface("plastic", {number("Kd", 0.5f), number("Ks", 0)});
  expectColor(shadeOne(), attributes.color * 0.5f * services.E, 2e-6f);
}

TEST_F(Lights, IndirectLightFromBelowTheHorizonStillGivesItsIrradianceBack) {
  services.E = {1, 2, 3};
  services.dominant[0] = {1, 0, 0};
  services.dominant[1] = glm::normalize(vec3(1, 0, 1));
  services.dominant[2] = {0, 0, 1};
  surface("matte");
  light("indirectlight");
  expectColor(shadeOne(), services.E, 1e-5f);
}

TEST_F(Lights, NondiffuseAndNonspecularLightsAreLeftOut) {
  surface("plastic", {number("Kd", 1), number("Ks", 1)});
  light("distantlight", {number("intensity", 3), number("__nondiffuse", 1)});
  light("distantlight", {number("intensity", 5), number("__nonspecular", 1)});
  expectColor(shadeOne(), vec3(8));
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Lights, MistakenLightsAreWarnedAbout) {
  light("arealight");
  light("pointlight", {}, true);
  light("distantlight", {text("lighting", "sideways"), text("shadowname", "map.shd")});
  system();
  EXPECT_EQ(log.count("light-area"), 2);
  const std::vector<LogEntry> said = log.entries();
  EXPECT_EQ(std::count_if(said.begin(), said.end(), [](const LogEntry& e) { return e.severity == Severity::Missing; }),
            1)
      << "the area light without geometry lights nothing";
  EXPECT_EQ(log.count("light-lighting"), 1);
  EXPECT_EQ(log.count("light-shadow-map"), 1);
}

TEST_F(Lights, IndirectLightObeysReceiveGainContextAndItsOwnTint) {
  services.E = {1, 1, 1};
  surface("matte");
  attributes.indirect.gain = 2;
  light("indirectlight",
        {number("intensity", 3), color("lightcolor", {1, 2, 4}), number("samples", 77), number("maxerror", 0.5f)});
  expectColor(shadeOne(), 6.0f * vec3(1, 2, 4));
  EXPECT_EQ(services.queries.back().samples, 77);
  ASSERT_NE(system().group(0).indirectQuery(), nullptr);
  EXPECT_EQ(system().group(0).indirectQuery()->maxError, 0.5f);
  ShadeContext direct;
  direct.indirect = false;
  expectColor(shadeOne(direct), vec3(0.0f));
  shading.reset();
  scene.objects.clear();
  attributes.indirect.receive = false;
  expectColor(shadeOne(), vec3(0.0f));
  EXPECT_EQ(system().group(0).indirectQuery(), nullptr);
}

// A point beside a lamp draws little else, and one that is far from all of them draws many.
TEST_F(Lights, OfWhichAPointDrawsAFewBringTheSameWhateverThePointsBesideIt) {
  scene.options.user["trace:lightcut"] = number("lightcut", 16);
  surface("matte", {number("Ka", 0), number("Kd", 1)});
  for (int k = 0; k < 100; ++k)
    light("pointlight", {point("from", {static_cast<float>(k % 10), static_cast<float>(k / 10), 2})}).castsShadows =
        true;
  const vec3 near(3, 4, 2.001f), far(5, 5, 40);
  ShadePoints both = points({near, far});
  const ShadedPoints together = shade(both);
  for (int i = 0; i < 2; ++i) {
    ShadePoints alone(0, 0);
    alone.add(both.name(i));
    for (int c = 0; c < both.channelCount(); ++c) alone.channel(c)[0] = both.channel(c)[i];
    EXPECT_EQ(shade(alone).color(0), together.color(i)) << i;
  }
  EXPECT_NEAR(together.color(0).x, 1e6f, 2e3f);
  EXPECT_NEAR(together.color(1).x, 100 / (38.0f * 38), 0.01f);
}

vec3 askedDirectly;
void askDirectly(const TmGrid* g) {
  rsl::Vec3Array E(g);
  g->call->indirectDiffuse(g->host, g, rsl::view(g->N), E, nullptr);
  askedDirectly = {E[0].x, E[0].y, E[0].z};
}
const rsl::Shader directlyShader(TM_SURFACE, "directly", "", TM_TRACES, askDirectly, {});

TEST_F(Lights, IndirectLightThatASurfaceAsksForItselfObeysReceiveGainAndContext) {
  static const TmShader* const shaders[] = {directlyShader};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  surface("directly");
  services.E = {1, 2, 3};
  attributes.indirect.gain = 2;
  attributes.irradianceMaxError = 0.125f;
  light("indirectlight", {number("samples", 77)});
  const auto ask = [&](const ShadeContext& context = {}) {  // at points of a full batch, which has no padding
    shade(points(std::vector<vec3>(64, vec3(0, 0, 5)), glm::normalize(vec3(0.5f, 0, -1))), context);
  };
  ask();
  expectColor(askedDirectly, {2, 4, 6});
  EXPECT_EQ(services.queries.back().samples, 77);
  EXPECT_EQ(services.queries.back().maxError, 0.125f);
  ShadeContext direct;
  direct.indirect = false;
  ask(direct);
  expectColor(askedDirectly, vec3(0));
  shading.reset();
  scene.objects.clear();
  attributes.indirect.receive = false;
  ask();
  expectColor(askedDirectly, vec3(0));
}

// Arrays of such a batch have no padding behind them, so what goes one too far meets the next array.
TEST_F(Lights, GiveThePointsOfAFullBatchWhatTheyGiveEachAlone) {
  services.E = {1, 2, 3};
  services.visible = [](const vec3& P, const vec3&) { return 0.5f + 0.005f * P.x; };
  services.seen = [](const vec3& d) { return 0.5f + 0.5f * d; };
  services.emitter = [](float a, float b, vec3& P, vec3& N, float& area) {
    P = {a, b, 3};
    N = {0, 0, 1};
    area = 1;
  };
  light("ambientlight");
  light("pointlight", {point("from", {3, 2, 0}), number("intensity", 20)}).castsShadows = true;
  light("arealight", {number("samples", 2)}, true).castsShadows = true;
  light("environmentlight", {number("samples", 2)});
  light("indirectlight");
  std::vector<vec3> places;
  for (int i = 0; i < 64; ++i) places.push_back({0.1f * static_cast<float>(i), 0, 5});
  const ShadePoints all = points(places, glm::normalize(vec3(0.2f, 0.1f, -1)));
  for (const char* name : {"matte", "plastic", "metal", "glass"}) {
    shading.reset();
    scene.objects.clear();
    surface(name);
    services.gathers = 0;
    const ShadedPoints together = shade(all);
    EXPECT_LE(services.gathers, 64) << name << ": one gather serves three colours";
    for (const int i : {0, 1, 63}) {
      ShadePoints alone(0, 0);
      alone.add(all.name(i));
      for (int c = 0; c < all.channelCount(); ++c) alone.channel(c)[0] = all.channel(c)[i];
      EXPECT_EQ(shade(alone).color(0), together.color(i)) << name << ' ' << i;
    }
  }
}

TEST(LightCategories, AreAlternativesOfTermsThatAllMustHold) {
  const auto in = [](const char* expression) { return inCategory("key,warm,left", expression); };
  for (const char* yes : {"", "key", "left", "-fill", "fill|key", "fill,cold,left", "fill|warm|cold", "key&warm&left",
                          "key&-fill&left", "fill&key|warm"})
    EXPECT_TRUE(in(yes)) << yes;
  for (const char* no :
       {"fill", "ke", "keys", "-warm", "fill|cold", "key&fill&left", "key&warm&-left", "fill|cold|-key"})
    EXPECT_FALSE(in(no)) << no;
  EXPECT_FALSE(inCategory("", "key"));
  EXPECT_TRUE(inCategory("", "-key"));
}

TEST_F(Lights, OfOneGroupShineAloneButForIndirectLight) {
  services.E = vec3(8);
  surface("matte", {number("Ka", 1), number("Kd", 1)});
  light("ambientlight", {number("intensity", 1), text("__group", "a")});
  light("distantlight", {number("intensity", 2), text("__group", "a")});
  light("distantlight", {number("intensity", 4), text("__group", "b")});
  light("indirectlight");
  for (const auto& [group, brightness] : {std::pair("a", 3.0f), {"b", 4.0f}, {"", 0.0f}}) {
    const std::string name = group;
    ShadeContext context;
    context.onlyLightGroup = &name;
    expectColor(shadeOne(context), vec3(8 + brightness));
  }
  expectColor(shadeOne(), vec3(8 + 7));
}

TEST_F(Lights, AreLeftOutWhereTheEyeLooksOrWhereShadowRaysPass) {
  surface("matte");
  light("distantlight", {number("intensity", 2)});
  ShadeContext context;
  context.direct = false;
  expectColor(shadeOne(context), vec3(0));
  for (const RayKind kind : {RayKind::Diffuse, RayKind::Specular, RayKind::Transmission}) {
    context.kind = kind;
    expectColor(shadeOne(context), vec3(kind == RayKind::Transmission ? 0 : 2));
  }
}

TEST_F(Lights, AreReplacedByLightThatIsStoredOrEvenOrByNone) {
  services.stored = {3, 4, 5};
  attributes.color = vec3(0.5f);
  surface("matte", {number("Ka", 0), number("Kd", 1)});
  light("distantlight", {number("intensity", 2)});
  const std::pair<Illumination, vec3> expected[] = {{Illumination::Lights, vec3(2)},
                                                    {Illumination::Stored, {3, 4, 5}},
                                                    {Illumination::Unit, vec3(1)},
                                                    {Illumination::None, vec3(0)},
                                                    {Illumination::LightsAndStored, {5, 6, 7}}};
  for (const auto& [illumination, light] : expected) {
    ShadeContext context;
    context.illumination = illumination;
    expectColor(shadeOne(context), 0.5f * light);
  }
}

TEST_F(Lights, RaysAreNeededForShadowsLampsWithGeometryIndirectLightAndWhatTracesItself) {
  const auto needs = [&](const char* ofSurface, const char* lamp, bool area = false, bool shadows = false) {
    shading.reset();
    scene.objects.clear();
    scene.lights.clear();
    surface(ofSurface);
    light(lamp, {}, area).castsShadows = shadows;
    return system().needsRays();
  };
  EXPECT_FALSE(needs("matte", "distantlight"));
  EXPECT_TRUE(needs("matte", "distantlight", false, true));
  EXPECT_TRUE(needs("matte", "arealight", true));
  EXPECT_TRUE(needs("matte", "indirectlight"));
  EXPECT_TRUE(needs("glass", "distantlight"));
  attributes.volume = true;
  EXPECT_TRUE(needs("matte", "distantlight"));
}

// Each point draws some of many lamps; in the mean that is the light of all.
TEST_F(Lights, FewOfManyLightsBringTheLightOfAllInTheMean) {
  vec3 sums[2];
  for (const bool all : {true, false}) {
    shading.reset();
    scene.objects.clear();
    scene.lights.clear();
    attributes.lights.clear();
    scene.options.user["trace:lightcut"] = number("lightcut", all ? 0.0f : 2.0f);
    surface("matte", {number("Kd", 1)});
    for (int k = 0; k < 200; ++k) {
      const auto x = static_cast<float>(k % 20), y = static_cast<float>(k / 20);
      light("pointlight",
            {number("intensity", 0.1f + 0.01f * static_cast<float>(k % 7)),
             color("lightcolor", {1, 0.1f * static_cast<float>(k % 5), 0.5f}), point("from", {x - 9.5f, y - 4.5f, 2})});
    }
    const ShadedPoints out = shade(points(std::vector<vec3>(2000, vec3(1, 0.5f, 5))));
    vec3 sum(0);
    for (int i = 0; i < 2000; ++i) sum += out.color(i) / 2000.0f;
    sums[all] = sum;
  }
  EXPECT_NE(sums[0], sums[1]) << "lamps are drawn";
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sums[0][c] / sums[1][c], 1, 0.02) << c;
}

}  // namespace
}  // namespace tomales
