// What shaders in RSL's manner ask of the renderer (reyes/shader/sl_services.h), under masks: random numbers,
// derivatives, spaces, parameter lists, messages.
#include <cstdlib>
#include <map>
#include <set>

#include "tests/unit/shade/obedient.h"

namespace tomales {
namespace {

using namespace sl;

using Numbers = std::map<std::string, std::vector<float>>;

void expectNumbers(TmWhom whom, const Numbers& numbers) {
  for (const auto& [name, is] : numbers) {
    TmValue v;
    ASSERT_TRUE(askFor(whom, -1, name.c_str(), TM_FLOAT, TM_FLOAT, v)) << name;
    EXPECT_EQ(std::vector<float>(v.c[0], v.c[0] + v.length), is) << name;
  }
}

TEST_F(BatchServices, RandomNumbersAreEvenDifferAndBelongToThePoint) {
  const auto draw = [](sl::Surface& s) { s.Ci = Color(s.random(), s.random(), s.random()); };
  const std::vector<vec3> all = asked(2000, draw);
  vec3 mean(0);
  for (size_t i = 0; i < 1000; ++i) {
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(all[i][k] >= 0 && all[i][k] < 1);
    mean += all[i] / 1000.0f;
  }
  expectColor(mean, vec3(0.5f), 0.041f);  // four and a half standard errors of independent numbers
  EXPECT_NE(all[0].x, all[0].y);
  EXPECT_NE(all[0].x, all[1].x);
  EXPECT_EQ(asked(20, draw)[3], all[3]) << "whatever the batch";
}

TEST_F(BatchServices, RandomNumbersDoNotRepeatAndKnowNothingOfTheDirectionsOfLobes) {
  constexpr int kCalls = 1000;
  std::set<float> drawn;
  double together = 0;
  body = [&](sl::Surface& s) {
    for (int k = 0; k < kCalls; ++k) {
      const Float x = s.random();
      Float a, b;
      grid()->call->stratified(grid()->host, grid(), k % 256, 256, a.data(), b.data());
      drawn.insert(x[0]);
      together += 12.0 * (x[0] - 0.5) * (a[0] - 0.5) / kCalls;
    }
    s.Ci = Color(0.0);
  };
  shade(points({vec3(0, 0, 5)}));
  EXPECT_GE(drawn.size(), size_t(kCalls - 1)) << "of 2^24 numbers";
  EXPECT_LT(std::abs(together), 0.12) << "correlation; 0.03 is one standard deviation";
}

TEST_F(BatchServices, FilterstepAveragesOverTheMicropolygonAndDepthCountsBetweenTheClippingPlanes) {
  scene.options.nearClip = 1;
  scene.options.farClip = 21;
  body = [](sl::Surface& s) { s.Ci = Color(filterstep(0.5, s.u), depth(s.P), filterstep(0.5, s.v)); };
  ShadePoints p = points(std::vector<vec3>(10, vec3(0, 0, 5)));
  for (int i = 0; i < 10; ++i) {
    p.channel(kDu)[i] = 0.4f;
    p.channel(kDv)[i] = 0.1f;
  }
  const ShadedPoints out = shade(p);
  for (int i = 0; i < 10; ++i) {
    const double u = 0.1 * i;
    EXPECT_NEAR(out.color(i).x, std::clamp((u + 0.2 - 0.5) / 0.4, 0.0, 1.0), 1e-5);
    EXPECT_NEAR(out.color(i).y, 4.0 / 20, 1e-6);
    EXPECT_NEAR(out.color(i).z, 0.5, 1e-5);
  }
}

TEST_F(BatchServices, ParameterListsSetWhatTheyName) {
  services.seen = [](const vec3&) { return vec3(1); };
  asked(2, [](sl::Surface& s) {
    s.Ci = trace(s.P, Vector(0, 0, 1), "bias", 0.25, "maxdist", 9, "label", "mirror", "subset", "a", "excludesubset",
                 "b", "hitsides", "front", "hitmode", "shader", "othreshold", 0.5);
    occlusion(s.P, s.N, 3, "coneangle", 0.5, "distribution", "uniform");
  });
  ASSERT_EQ(services.asked.size(), 4u);
  const RayQuery& q = services.asked[0];
  EXPECT_EQ(q.bias, 0.25f);
  EXPECT_EQ(q.maxDistance, 9);
  EXPECT_EQ(q.label, "mirror");
  EXPECT_EQ(q.subset, "a");
  EXPECT_EQ(q.excludeSubset, "b");
  EXPECT_EQ(q.sides, HitSides::Front);
  EXPECT_EQ(q.mode, HitMode::Shader);
  EXPECT_EQ(q.opacityThreshold, 0.5f);
  const auto [rays, options, pointBased, file] =
      listed(HemisphereList(), "samples", 7, "samplecone", 0.1, "distribution", "uniform", "samplebase", 0.5, "falloff",
             2, "falloffmode", 1);
  EXPECT_EQ(
      std::tuple(rays.samples, rays.coneAngle, rays.uniform, rays.sampleBase, options.falloff, options.falloffMode),
      std::tuple(7, 0.1f, 1, 0.5f, 2.0f, 1));
  const TmTextureOptions l =
      listed(tmTextureDefaults(), "blur", 0.1, "twidth", 3, "fill", 0.5, "filter", "gaussian", "samples", 4);
  EXPECT_EQ(std::tuple(l.sblur, l.tblur, l.swidth, l.twidth, l.fill, l.samples),
            std::tuple(0.1f, 0.1f, 1.0f, 3.0f, 0.5f, 4));
  EXPECT_STREQ(l.filter, "gaussian");
  const TmShadowOptions w = listed(tmShadowDefaults(), "bias", 0.01, "blur", 0.2, "width", 2, "samples", 64);
  EXPECT_EQ(std::tuple(w.bias, w.blur, w.width, w.samples), std::tuple(0.01f, 0.2f, 2.0f, 64));
}

TEST_F(BatchServices, WhatRaysMeetAsksForFewerRaysThanWhatTheEyeSees) {
  const auto rays = [&](const ShadeContext& context, const std::function<void(sl::Surface&)>& what) {
    services.asked.clear();
    asked(2, what, context);
    return services.asked.size();
  };
  const auto hemisphere = [&](int samples, const ShadeContext& context) {
    return rays(context, [&](sl::Surface& s) { s.Ci = Color(occlusion(s.P, s.N, samples)); });
  };
  const ShadeContext gathered{.kind = RayKind::Diffuse, .diffuseDepth = 1, .branches = 1000};
  EXPECT_EQ(hemisphere(128, {}), 128u);
  EXPECT_EQ(hemisphere(128, {.branches = 4}), 32u) << "one of four rays of a point";
  EXPECT_EQ(hemisphere(128, {.branches = 1000}), 16u) << "shaders may square what they get";
  EXPECT_EQ(hemisphere(128, gathered), 16u) << "one of the rays of a record";
  EXPECT_EQ(hemisphere(9, gathered), 9u) << "never more than it asks for";
  const auto cone = [&](int samples, const ShadeContext& context) {
    return rays(context, [&](sl::Surface& s) { s.Ci = trace(s.P, s.N, "samples", samples, "samplecone", 0.1); });
  };
  EXPECT_EQ(cone(24, {}), 24u);
  EXPECT_EQ(cone(24, {.branches = 4}), 6u);
  EXPECT_EQ(cone(24, {.branches = 1000}), 1u);
  EXPECT_EQ(cone(24, {.kind = RayKind::Diffuse, .diffuseDepth = 1}), 1u);
  const auto nearest = [&](sl::Surface& s) { s.Ci = Color(traceDistance(s.P, s.N, "samples", 24)); };
  EXPECT_EQ(rays({.branches = 4}, nearest), 24u) << "fewer rays would find it farther away";
}

TEST_F(BatchServices, ANameThatAParameterListDoesNotKnowIsReportedOnce) {
  body = [](sl::Surface& s) { s.Ci = trace(s.P, s.I, "smaples", 2); };
  shadeOne();
  shadeOne();
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_NE(log.entries()[0].message.find("\"smaples\""), std::string::npos) << log.entries()[0].message;
}

TEST_F(BatchServices, NamesThatChangeNothingAreReportedOnceEach) {
  body = [](sl::Surface& s) {
    occlusion(s.P, s.N, 1, "minsamples", 8, "samples", 4);
    s.Ci = transmission(s.P, s.P + s.I, "minsamples", 2, "raydepth", 1);
    bake3d("unused.ptc", s.P, s.N, {}, "interpolate", 1);
  };
  shadeOne();
  shadeOne();
  int minsamples = 0, interpolate = 0;
  for (const auto& e : log.entries()) {
    minsamples += e.message.find("\"minsamples\" has no effect") != std::string::npos;
    interpolate += e.message.find("\"interpolate\" has no effect") != std::string::npos;
  }
  EXPECT_EQ(minsamples, 1);
  EXPECT_EQ(log.count("shader-exception-obedient"), 0) << "the shader has run to its end";
  EXPECT_EQ(interpolate, 1);
}

TEST_F(BatchServices, MessagesHaveRslsNames) {
  attributes.shadingRate = 2.5f;
  Param shot = number("user:shot", 42);
  scene.options.user["user:shot"] = shot;
  displacement("noisybump", {number("Km", 0.25f)});
  const auto fog = [&](float distance) {
    return std::make_shared<const ShaderCall>(call("fog", {number("distance", distance)}));
  };
  attributes.atmosphere = fog(7);
  attributes.exterior = fog(11);
  attributes.interior = fog(13);
  asked(4, [](sl::Surface& s) {
    Float x;
    const auto is = [&](double value) { return std::abs(double(x[0]) - value) < 1e-6; };
    std::string text;
    EXPECT_TRUE(s.surface("lift", x) && is(3));
    EXPECT_TRUE(s.displacement("Km", x) && is(0.25));
    EXPECT_TRUE(s.atmosphere("distance", x) && is(7));
    EXPECT_TRUE(s.incident("distance", x) && is(11));
    EXPECT_TRUE(s.opposite("distance", x) && is(13));
    EXPECT_TRUE(s.attribute("Ri:ShadingRate", x) && is(2.5));
    EXPECT_TRUE(s.option("user:shot", x) && is(42));
    EXPECT_TRUE(s.rendererinfo("renderer", text) && text == "Tomales");
    EXPECT_FALSE(s.surface("absent", x));
    EXPECT_FALSE(s.surface("lift", text)) << "a number is no text";
    EXPECT_EQ(shadername(), "obedient");
    EXPECT_EQ(shadername(TM_OF_ATMOSPHERE), "fog");
  });
}

TEST_F(BatchServices, AttributesAreToldAsTheSceneHasThem) {
  attributes.matte = true;
  attributes.sides = 1;
  attributes.detail = {0.25f, 0.75f};
  attributes.textureCoordinates = {vec2{1, 2}, {3, 4}, {5, 6}, {7, 8}};
  attributes.displacementBound = 0.5f;
  attributes.trace.maxDiffuseDepth = 3;
  attributes.trace.maxSpecularDepth = 5;
  attributes.trace.bias = 0.125f;
  attributes.visibility.diffuse = false;
  const Numbers numbers = {{"Matte", {1}},
                           {"Ri:Sides", {1}},
                           {"DetailRange", {0.25f, 0.75f}},
                           {"TextureCoordinates", {1, 2, 3, 4, 5, 6, 7, 8}},
                           {"displacementbound:sphere", {0.5f}},
                           {"trace:maxdiffusedepth", {3}},
                           {"trace:maxspeculardepth", {5}},
                           {"trace:bias", {0.125f}},
                           {"visibility:camera", {1}},
                           {"visibility:diffuse", {0}}};
  asked(2, [&](sl::Surface&) {
    expectNumbers(TM_OF_ATTRIBUTES, numbers);
    TmValue v;
    EXPECT_TRUE(askFor(TM_OF_ATTRIBUTES, -1, "Ri:Color", TM_COLOR, TM_COLOR, v));
    EXPECT_EQ(v.length, 1) << "three numbers are one colour";
  });
}

TEST_F(BatchServices, OptionsAreToldAsTheSceneHasThem) {
  scene.options.xResolution = 40;
  scene.options.yResolution = 30;
  scene.options.pixelAspect = 1.5f;
  scene.options.shutterOpen = 0.25f;
  scene.options.shutterClose = 0.75f;
  scene.options.nearClip = 2;
  scene.options.farClip = 900;
  scene.options.cropWindow = {0.1f, 0.9f, 0.2f, 0.8f};
  scene.options.xSamples = 3;
  scene.options.ySamples = 5;
  scene.options.frame = 17;
  scene.options.fStop = 4;
  scene.options.focalLength = 0.5f;
  scene.options.focalDistance = 6;
  const Numbers numbers = {{"Ri:Format", {40, 30, 1.5f}},
                           {"DeviceResolution", {40, 30, 1.5f}},
                           {"FrameAspectRatio", {2}},
                           {"DepthOfField", {4, 0.5f, 6}},
                           {"Shutter", {0.25f, 0.75f}},
                           {"Clipping", {2, 900}},
                           {"CropWindow", {0.1f, 0.9f, 0.2f, 0.8f}},
                           {"PixelSamples", {3, 5}},
                           {"Frame", {17}}};
  asked(2, [&](sl::Surface&) { expectNumbers(TM_OF_OPTIONS, numbers); });
}

TEST_F(BatchServices, RandomgridIsOneNumberOfACallAndOfTheObjectsName) {
  attributes.name = "left";
  float first = 0;
  const std::vector<vec3> c =
      asked(64, [&](sl::Surface& s) { s.Ci = Color(s.randomgrid(), s.randomgrid(), 0) + Triple(0, 0, 1) * random3(); });
  first = c[0].x;
  for (size_t i = 0; i < 32; ++i) {
    EXPECT_EQ(c[i].x, first);
    EXPECT_NE(c[i].y, first);
    if (i > 0) {
      EXPECT_NE(c[i].z, c[i - 1].z) << "random() differs from point to point";
    }
  }
  EXPECT_TRUE(first >= 0 && first < 1);
}

TEST_F(BatchServices, ASpaceThatThereIsNotIsToldAndChangesNothing) {
  const std::vector<vec3> c = asked(2, [](sl::Surface& s) { s.Ci = transform("nowhere", s.P); });
  expectColor(c[0], {0, 0, 5});
  ASSERT_EQ(log.count("shader-space"), 1);
  EXPECT_NE(log.entries()[0].message.find("\"nowhere\""), std::string::npos);
}

TEST_F(BatchServices, PrintingIsForThePointsOfTheMask) {
  ::testing::internal::CaptureStderr();
  asked(4, [](sl::Surface& s) { s.printf("%f at %p in %s", s.u, s.P, "here"); });
  EXPECT_EQ(::testing::internal::GetCapturedStderr(),
            "0.000000 at 0.000000 0.000000 5.000000 in here\n0.250000 at 0.000000 0.000000 5.000000 in here\n");
}

TEST_F(BatchServices, NothingIsPrintedForASketchNorByASilentFrame) {
  ::testing::internal::CaptureStderr();
  const auto print = [](sl::Surface& s) { s.printf("%f\n", s.u); };
  asked(1, print, {.purpose = Purpose::Sketch});
  system().silence();
  asked(1, print);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_F(BatchServices, ATextThatEndsItsLineIsPrintedWithoutAnEmptyOne) {
  ::testing::internal::CaptureStderr();
  asked(1, [](sl::Surface& s) { s.printf("%f\n", s.u); });
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "0.000000\n");
}

}  // namespace
}  // namespace tomales
