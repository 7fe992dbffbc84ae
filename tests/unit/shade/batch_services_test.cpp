// What shaders in RSL's manner ask of the renderer (reyes/sl_services.h), under masks: random numbers, derivatives, light, messages, rays.
#include <OpenImageIO/imagebuf.h>

#include <cstdlib>
#include <filesystem>
#include <set>

#include "reyes/sl.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

using namespace sl;

/// What the one shader does; set by the test, on whose thread it runs.
std::function<void(sl::Surface&)> body;
struct obedient : sl::Surface {
  void main() {
    Ci = Color(-1.0), Oi = Color(1.0);
    body(*this);
  }
};
rsl::FloatParam lift("lift", 3, "");
const rsl::Shader obedientShader(TM_SURFACE, "obedient", "", TM_TRACES | TM_DERIVATIVES, sl::shade<obedient>, {&lift});

struct coned : sl::Light {
  void main() {
    illuminate(Point(0, 0, 0), Vector(0, 0, 1), 0.3, [&] { Cl = Color(2 / dot(L, L)); });
  }
};
struct sunny : sl::Light {
  void main() {
    solar(Vector(0, 3, 4), [&] { Cl = Color(1, 0.5, 0.25); });
  }
};
const rsl::Shader conedShader(TM_LIGHT, "coned", "", 0, sl::shade<coned>, {});
const rsl::Shader sunnyShader(TM_LIGHT, "sunny", "", TM_LIGHT_SOLAR, sl::shade<sunny>, {});

class BatchServices : public Stage {
 protected:
  BatchServices() {
    static const TmShader* const shaders[] = {obedientShader, conedShader, sunnyShader};
    static const TmShaderLibrary library = {TM_SHADER_ABI, sizeof(TmShaderLibrary), shaders, 3};
    registry.addLibrary(&library, "test");
    surface("obedient");
  }
  /// Ci of `n` points at z = 5, of which those with u < 1/2 are asked.
  std::vector<vec3> asked(int n, const std::function<void(sl::Surface&)>& what, const ShadeContext& context = {}) {
    body = [&](sl::Surface& s) { If(s.u < 0.5, [&] { what(s); }); };
    const ShadedPoints out = shade(points(std::vector<vec3>(static_cast<size_t>(n), vec3(0, 0, 5))), context);
    std::vector<vec3> colors;
    for (int i = 0; i < n; ++i) colors.push_back(out.color(i));
    for (int i = (n + 1) / 2; i < n; ++i) EXPECT_EQ(colors[static_cast<size_t>(i)], vec3(-1)) << "nobody asked at " << i;
    return colors;
  }
};

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
  scene.options.nearClip = 1, scene.options.farClip = 21;
  body = [](sl::Surface& s) { s.Ci = Color(filterstep(0.5, s.u), depth(s.P), filterstep(0.5, s.v)); };  // filterstepOfU
  ShadePoints p = points(std::vector<vec3>(10, vec3(0, 0, 5)));
  for (int i = 0; i < 10; ++i) p.channel(kDu)[i] = 0.4f, p.channel(kDv)[i] = 0.1f;
  const ShadedPoints out = shade(p);
  for (int i = 0; i < 10; ++i) {
    const double u = 0.1 * i;
    EXPECT_NEAR(out.color(i).x, std::clamp((u + 0.2 - 0.5) / 0.4, 0.0, 1.0), 1e-5);
    EXPECT_NEAR(out.color(i).y, 4.0 / 20, 1e-6);
    EXPECT_NEAR(out.color(i).z, 0.5, 1e-5);
  }
}

TEST_F(BatchServices, PhongAndTheLobeOfSpecularAreTheirFormulas) {
  light("distantlight", {point("to", {0, 3, 4})});  // from the light: (0, 0.6, 0.8)
  const std::vector<vec3> c = asked(4, [](sl::Surface& s) {
    const Normal N = s.N;
    s.Ci = Color(xcomp(phong(N, Vector(0, 0, -2), 5)), specularbrdf(Vector(0, -3, -4), N, -s.I, 0.5), xcomp(specular(N, -s.I, 0.5)));
  });
  const double H = (0.8 + 1) / std::hypot(0.6, 1.8);
  expectColor(c[0], vec3(static_cast<float>(std::pow(0.8, 5)), static_cast<float>(std::pow(H, 16)), static_cast<float>(std::pow(H, 16))), 1e-5f);
}

TEST_F(BatchServices, TheLobeHasTheExponentThatTheSceneChoosesAsSpecularHas) {
  scene.options.user["shade:specular"] = text("shade:specular", "rispec");
  light("distantlight", {point("to", {0, 3, 4})});
  const std::vector<vec3> c = asked(4, [](sl::Surface& s) {
    s.Ci = Color(specularbrdf(Vector(0, -3, -4), s.N, -s.I, 0.5), xcomp(specular(s.N, -s.I, 0.5)), 0);
  });
  const auto highlight = static_cast<float>(std::pow((0.8 + 1) / std::hypot(0.6, 1.8), 2));
  expectColor(c[0], {highlight, highlight, 0}, 1e-5f);
}

TEST_F(BatchServices, ParameterListsSetWhatTheyName) {
  services.seen = [](const vec3&) { return vec3(1); };
  asked(2, [](sl::Surface& s) {
    s.Ci = trace(s.P, Vector(0, 0, 1), "bias", 0.25, "maxdist", 9, "label", "mirror", "subset", "a", "excludesubset", "b", "hitsides", "front", "hitmode",
                 "shader", "othreshold", 0.5);
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
  const TmRayOptions rays = listed(rsl::defaultRays(), "samples", 7, "samplecone", 0.1, "distribution", "uniform", "samplebase", 0.5, "falloff", 2, "falloffmode", 1);
  EXPECT_EQ(std::tie(rays.samples, rays.coneAngle, rays.uniform, rays.sampleBase, rays.falloff, rays.falloffMode), std::tuple(7, 0.1f, 1, 0.5f, 2.0f, 1));
  const TmTextureLookup l = listed(lookup(), "blur", 0.1, "twidth", 3, "fill", 0.5, "filter", "gaussian", "samples", 4);
  EXPECT_EQ(std::tuple(l.sblur, l.tblur, l.swidth, l.twidth, l.fill, l.samples), std::tuple(0.1f, 0.1f, 1.0f, 3.0f, 0.5f, 4));
  EXPECT_STREQ(l.filter, "gaussian");
  const TmShadowLookup w = listed(kShadowDefaults, "bias", 0.01, "blur", 0.2, "width", 2, "samples", 64);
  EXPECT_EQ(std::tuple(w.bias, w.blur, w.width, w.samples), std::tuple(0.01f, 0.2f, 2.0f, 64));
}

TEST_F(BatchServices, ANameThatAParameterListDoesNotKnowIsReportedOnce) {
  body = [](sl::Surface& s) { s.Ci = trace(s.P, s.I, "smaples", 2); };
  shadeOne(), shadeOne();
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_NE(log.entries()[0].message.find("\"smaples\""), std::string::npos) << log.entries()[0].message;
}

TEST_F(BatchServices, NamesThatChangeNothingAreReportedOnceEach) {
  body = [](sl::Surface& s) {
    occlusion(s.P, s.N, 1, "minsamples", 8, "samples", 4);
    bake3d("unused.ptc", s.P, s.N, {}, "interpolate", 1);
  };
  shadeOne(), shadeOne();
  int minsamples = 0, interpolate = 0;
  for (const auto& e : log.entries()) {
    minsamples += e.message.find("\"minsamples\" has no effect") != std::string::npos;
    interpolate += e.message.find("\"interpolate\" has no effect") != std::string::npos;
  }
  EXPECT_EQ(minsamples, 1);
  EXPECT_EQ(interpolate, 1);
}

TEST_F(BatchServices, LightsInRslsMannerShineIntoTheirConeAndFromTheirDirection) {
  surface("matte");
  light("coned"), light("sunny");
  const ShadedPoints out = shade(points({vec3(0, 0, 4), vec3(3, 0, 4)}));
  const vec3 sun = 0.8f * vec3(1, 0.5f, 0.25f);
  expectColor(out.color(0), vec3(2 / 16.0f) + sun);
  expectColor(out.color(1), sun);
}

TEST_F(BatchServices, MessagesHaveRslsNames) {
  attributes.shadingRate = 2.5f;
  Param shot = number("user:shot", 42);
  scene.options.user["user:shot"] = shot;
  displacement("noisybump", {number("Km", 0.25f)});
  const auto fog = [&](float distance) { return std::make_shared<const ShaderCall>(call("fog", {number("distance", distance)})); };
  attributes.atmosphere = fog(7), attributes.exterior = fog(11), attributes.interior = fog(13);
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

TEST_F(BatchServices, ATextureOfFourCornersIsTheMeanBetweenThem) {
  const std::string path = ::testing::TempDir() + "/tomales_corners.tif";
  OIIO::ImageBuf picture(OIIO::ImageSpec(256, 256, 1, OIIO::TypeDesc::FLOAT));
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      const float value = x < 128 ? 0.0f : 1.0f;
      picture.setpixel(x, y, &value);
    }
  ASSERT_TRUE(picture.write(path));
  const std::vector<vec3> c = asked(4, [&](sl::Surface& s) {
    TmTextureLookup one = lookup();
    one.channels = 1;
    const auto over = [&](double from, double to) {
      const Float ss[4] = {from, to, from, to}, tt[4] = {0.4, 0.4, 0.6, 0.6};
      return xcomp(texture(path.c_str(), ss, tt, one));
    };
    s.Ci = Color(over(0.4, 0.6), over(0.45, 0.65), over(0.7, 0.8));
  });
  expectColor(c[0], vec3(0.5f, 0.75f, 1), 0.05f);
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(BatchServices, PicturesAreLookedUpOverRegionsCornersAndChannels) {
  const std::string path = ::testing::TempDir() + "/tomales_ramp.exr";
  OIIO::ImageBuf picture(OIIO::ImageSpec(256, 128, 3, OIIO::TypeDesc::FLOAT));
  for (int k = 0; k < 256 * 128; ++k) {
    const float s = (static_cast<float>(k % 256) + 0.5f) / 256, value[] = {s < 0.5f ? 0.0f : 1.0f, s, 2};
    picture.setpixel(k % 256, k / 256, value);
  }
  ASSERT_TRUE(picture.write(path));
  const std::vector<vec3> c = asked(4, [&](sl::Surface& s) {
    FilterRegion wide;
    for (Float& side : wide.sides) side = 0.1;
    wide.s = 0.5, wide.t = 0.5;
    const Float step = xcomp(texture(path.c_str(), wide));
    wide.s = 0.53, wide.scale(2);
    const Float wider = xcomp(texture(path.c_str(), wide));
    s.Ci = Color(step, wider, ftexture(path.c_str(), 1, 0.25, 0.5, "blur", 0.02));
  });
  EXPECT_NEAR(c[0].x, 0.5f, 0.02f);
  EXPECT_TRUE(c[0].y > 0.5f && c[0].y < 0.75f) << c[0].y;
  EXPECT_NEAR(c[0].z, 0.25f, 0.01f);
  const std::vector<vec3> around = asked(4, [&](sl::Surface& s) {
    // From the equator: +y is a quarter round the picture, where its green is 1/4.
    const Vector corners[4] = {Vector(0.1, 1, 0.1), Vector(-0.1, 1, 0.1), Vector(0.1, 1, -0.1), Vector(-0.1, 1, -0.1)};
    s.Ci = Color(ycomp(environment(path.c_str(), corners)), fenvironment(path.c_str(), 1, Vector(0, 1, 0)), fenvironment(path.c_str(), 2, Vector(0, 1, 0), "blur", 0.01));
  });
  expectColor(around[0], {0.25f, 0.25f, 2}, 0.01f);
  EXPECT_TRUE(log.entries().empty());
}

// Every other column of texels is 1, and one in four so large that an average over it says nothing.
TEST_F(BatchServices, PicturesAreLookedUpOnOtherLevelsAndWithoutWhatIsTooLarge) {
  const std::string path = ::testing::TempDir() + "/tomales_columns.exr";
  OIIO::ImageBuf picture(OIIO::ImageSpec(256, 256, 3, OIIO::TypeDesc::FLOAT));
  for (int k = 0; k < 256 * 256; ++k) {
    const int column = k % 256;
    const float value[] = {static_cast<float>(column % 2), column % 4 == 0 ? 1e9f : 2, 1e9f};
    picture.setpixel(column, k / 256, value);
  }
  ASSERT_TRUE(picture.write(path));
  const std::vector<vec3> c = asked(4, [&](sl::Surface& s) {
    FilterRegion region;
    region.s = 128.5 / 256, region.t = 0.5;
    const auto look = [&](double texels, const auto&... list) {
      for (Float& side : region.sides) side = 0;
      region.sides[0] = texels / 256, region.sides[3] = texels / 256;
      return texture(path.c_str(), region, list...);
    };
    s.Ci = Color(xcomp(look(16)), xcomp(look(16, "mipbias", 10)), xcomp(look(1, "mipbias", -4)));
    const Color some = look(16, "ignoreabove", 1000, "fill", 7);
    s.Oi = Color(ycomp(some), zcomp(some), xcomp(some));
    If(s.u < 0.2, [&] { s.Ci = s.Oi; });
  });
  expectColor(c[0], {2, 7, 0.5f}, 0.01f);
  expectColor(c[1], {0.5f, 0, 0.5f}, 0.02f);
}

// An orthographic map of -1..1: something at depth 1 hides its left half.
TEST_F(BatchServices, AShadowOfFourCornersIsTheMeanBetweenThem) {
  const std::string path = ::testing::TempDir() + "/tomales_half.exr";
  OIIO::ImageSpec spec(64, 64, 1, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"Z"};
  const mat4 same(1.0f);
  spec.attribute("worldtocamera", OIIO::TypeMatrix, &same), spec.attribute("worldtoscreen", OIIO::TypeMatrix, &same);
  OIIO::ImageBuf map(spec);
  for (int k = 0; k < 64 * 64; ++k) {
    const float depth = k % 64 < 32 ? 1.0f : 100.0f;
    map.setpixel(k % 64, k / 64, &depth);
  }
  ASSERT_TRUE(map.write(path));
  const std::vector<vec3> c = asked(2, [&](sl::Surface& s) {
    const auto over = [&](double from, double to) {
      const Point corners[4] = {Point(from, -0.5, 5), Point(to, -0.5, 5), Point(from, 0.5, 5), Point(to, 0.5, 5)};
      return xcomp(shadow(path.c_str(), corners, "samples", 4, "bias", 0.1));
    };
    s.Ci = Color(over(-0.5, 0.5), over(-0.5, -0.25), xcomp(shadow(path.c_str(), Point(0.5, 0, 5))));
  });
  expectColor(c[0], {0.5f, 1, 0});
  EXPECT_TRUE(log.entries().empty());
}

/// Black, and white from its middle on.
std::string stepPicture(const std::string& name) {
  std::string path = ::testing::TempDir() + name;
  OIIO::ImageBuf picture(OIIO::ImageSpec(256, 256, 1, OIIO::TypeDesc::FLOAT));
  for (int k = 0; k < 256 * 256; ++k) {
    const float value = k % 256 < 128 ? 0.0f : 1.0f;
    picture.setpixel(k % 256, k / 256, &value);
  }
  EXPECT_TRUE(picture.write(path));
  return path;
}

TEST_F(BatchServices, AnOptionScalesAllTextureFilters) {
  const std::string path = stepPicture("/tomales_step.tif");
  scene.options.user["texture:width"] = number("width", 2);
  const std::vector<vec3> c = asked(4, [&](sl::Surface& s) {
    TmTextureLookup one = lookup();
    one.channels = 1;
    const auto over = [&](double from, double to) {
      const Float ss[4] = {from, to, from, to}, tt[4] = {0.4, 0.4, 0.6, 0.6};
      return xcomp(texture(path.c_str(), ss, tt, one));
    };
    s.Ci = Color(over(0.475, 0.575), over(0.55, 0.6), 0);  // twice as wide: from 0.425 to 0.625, and beyond the step
  });
  expectColor(c[0], {0.625f, 1, 0}, 0.06f);
}

// Three quarters of the way from a texel of 0 to one of 1: linear, and by the cubic B-spline of filters that are not boxes.
TEST_F(BatchServices, AnOptionNamesTheFilterOfLookupsThatNameNone) {
  const std::string path = stepPicture("/tomales_edge.tif");
  scene.options.user["texture:filter"] = text("filter", "gaussian");
  const std::vector<vec3> c = asked(4, [&](sl::Surface& s) {
    FilterRegion spot;
    spot.s = 0.5 + 0.25 / 256, spot.t = 0.5;
    for (int k = 0; k < 4; ++k) spot.sides[k] = k == 0 || k == 3 ? 1e-4 : 0.0;
    s.Ci = Color(xcomp(texture(path.c_str(), spot)), xcomp(texture(path.c_str(), spot, "filter", "box")), 0);
  });
  const float f = 0.75f, cubic = 1 - ((1 - f) * (1 - f) * (1 - f) + 4 - 6 * f * f + 3 * f * f * f) / 6;
  expectColor(c[0], {cubic, 0.75f, 0}, 5e-3f);
}

TEST_F(BatchServices, PicturesAndLightsTellWhatTheyHold) {
  const std::string path = ::testing::TempDir() + "/tomales_constant.exr";
  OIIO::ImageBuf picture(OIIO::ImageSpec(64, 32, 3, OIIO::TypeDesc::FLOAT));
  for (int k = 0; k < 64 * 32; ++k) {
    const float value[] = {0.25f, 0.5f, 2};
    picture.setpixel(k % 64, k / 64, value);
  }
  ASSERT_TRUE(picture.write(path));
  light("distantlight", {number("intensity", 0.625f)});
  const std::vector<vec3> c = asked(4, [&](sl::Surface& s) {
    std::vector<float> size;
    std::string kind;
    EXPECT_TRUE(textureinfo(path.c_str(), "resolution", size));
    EXPECT_EQ(size, (std::vector<float>{64, 32}));
    EXPECT_FALSE(textureinfo(path.c_str(), "resolution", kind)) << "numbers are no text";
    EXPECT_TRUE(textureinfo(path.c_str(), "type", kind));
    EXPECT_EQ(kind, "texture");
    Float intensity = 0;
    s.illuminance(s.P, s.N, 1.5f, [&] { EXPECT_TRUE(lightsource(s.lightNumber, "intensity", intensity)); });
    s.Ci = Color(ftexture(path.c_str(), 1, 0.5 + 0.1 * s.u, s.v), zcomp(environment(path.c_str(), Vector(s.u, 1, 0))), intensity);
  });
  for (const size_t i : {0u, 1u}) expectColor(c[i], {0.5f, 2, 0.625f});
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(BatchServices, IndirectdiffuseIsTheMeanOfWhatRaysSee) {
  services.seen = [](const vec3& d) { return vec3(2, d.z * d.z, 1); };
  const std::vector<vec3> c = asked(2, [](sl::Surface& s) { s.Ci = indirectdiffuse(s.P, s.N, 4096); });
  expectColor(c[0], vec3(2, 0.5f, 1), 0.01f);  // the mean of cos^2 by the cosine is 1/2
  EXPECT_EQ(asked(2, [](sl::Surface& s) { s.Ci = indirect(s.P, s.N, 4096); })[0], c[0]) << "its old name";
}

TEST_F(BatchServices, PointsThatAShaderHasMovedAreTracedAndTheOthersInterpolated) {
  services.interpolated = 0.75f;
  services.met = [](const vec3&, const vec3&) { return 1.0f; };
  const std::vector<vec3> c = asked(8, [](sl::Surface& s) {
    Point from = s.P;
    sl::If(s.u > 0.3, [&] { from += Vector(0, 0.5, 0); });
    s.Ci = Color(occlusion(from, s.N, 4, "maxvariation", 0.1), occlusion(from, s.N, 4), 0);
  });
  for (const size_t i : {0u, 1u, 2u}) expectColor(c[i], {0.75f, 1, 0});
  expectColor(c[3], {1, 1, 0});
}

// Half of the sphere of directions leaves the scene, towards +x; the map is 1 + its own direction.
TEST_F(BatchServices, OcclusionTellsOfTheEnvironmentWhereRaysLeave) {
  const std::string path = ::testing::TempDir() + "/tomales_open.exr";
  OIIO::ImageBuf picture(OIIO::ImageSpec(256, 128, 3, OIIO::TypeDesc::FLOAT));
  for (int k = 0; k < 256 * 128; ++k) {
    const float theta = kPi * (static_cast<float>(k / 256) + 0.5f) / 128, phi = 2 * kPi * (static_cast<float>(k % 256) + 0.5f) / 256;
    const float value[] = {1 + std::sin(theta) * std::cos(phi), 1 + std::sin(theta) * std::sin(phi), 1 + std::cos(theta)};
    picture.setpixel(k % 256, k / 256, value);
  }
  ASSERT_TRUE(picture.write(path));
  services.met = [](const vec3&, const vec3& d) { return d.x > 0 ? kInfinity : 1.0f; };
  services.seen = [](const vec3& d) { return d.x > 0 ? vec3(0) : vec3(0, 0, 2); };
  const std::vector<vec3> c = asked(2, [&](sl::Surface& s) {
    Color environmentColor, environmentDirection;
    Float covers;
    Color radiance = indirectdiffuse(s.P, Normal(0, 0, 1), 4096, "environmentmap", path.c_str(), "environmentcolor", &environmentColor, "environmentdir",
                                     &environmentDirection, "occlusion", &covers);
    s.Ci = radiance;
    EXPECT_NEAR(covers[0], 0.5f, 2e-3f);
    // By the cosine, the mean of x over the half of the hemisphere where it is positive is 2/(3 pi), of z 1/3, of y 0; each over all.
    const float x = 2.0f / (3 * kPi), z = 1.0f / 3;
    EXPECT_NEAR(environmentColor[0].x, 0.5f + x, 0.01f);
    EXPECT_NEAR(environmentColor[0].y, 0.5f, 0.01f);
    EXPECT_NEAR(environmentColor[0].z, 0.5f + z, 0.01f);
    const vec3 mean = glm::normalize(vec3(x, 0, z));
    expectColor({environmentDirection[0].x, environmentDirection[0].y, environmentDirection[0].z}, mean, 0.01f);
  });
  EXPECT_NEAR(c[0].z, 1 + 0.5f + 1.0f / 3, 0.01f);
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(BatchServices, GatherHasCategoriesListsAndTheEffectiveDistance) {
  services.met = [](const vec3&, const vec3&) { return 3.0f; };
  const std::vector<vec3> c = asked(2, [](sl::Surface& s) {
    Float hits = 0, misses = 0, effective, length;
    Vector direction, sum;
    gather("illuminance", s.P, s.N, 0.5f, 4, rays("label", "probe", "distribution", "cosine"), {{"effectivedistance", &effective}, {"ray:length", &length}},
           [&] { hits += effective + 10 * length; }, [&] { misses += 1; });
    s.Ci = Color(hits, misses, 0);
    gather("samplepattern", s.P, s.N, 0.5f, 8, rays(), {{"ray:direction", &direction}}, [&] { hits += 1000; }, [&] { sum += direction; });
    setzcomp(s.Ci, zcomp(normalize(sum)));
  });
  expectColor(c[0], {4 * 36, 0, -1}, 0.05f);
  EXPECT_EQ(services.asked.front().label, "probe");
  EXPECT_EQ(services.asked.size(), 4u) << "a pattern of samples is not traced";
  body = [](sl::Surface& s) { gather("pathtrace", s.P, s.N, 0.5f, 4, rays(), {}, [] {}, [] {}); };
  shadeOne();
  EXPECT_EQ(log.entries().size(), 1u);
}

// A picture of 1 + its own direction holds 4 pi of light, and adds up to a direction of 4 pi / 3 along the axis of each channel. It stands in a space
// whose x is the world's y.
TEST_F(BatchServices, GatherDrawsTheLightOfAnEnvironment) {
  const std::string path = ::testing::TempDir() + "/tomales_gathered.exr";
  OIIO::ImageBuf picture(OIIO::ImageSpec(256, 128, 3, OIIO::TypeDesc::FLOAT));
  for (int k = 0; k < 256 * 128; ++k) {
    const float theta = kPi * (static_cast<float>(k / 256) + 0.5f) / 128, phi = 2 * kPi * (static_cast<float>(k % 256) + 0.5f) / 256;
    const float value[] = {1 + std::sin(theta) * std::cos(phi), 1 + std::sin(theta) * std::sin(phi), 1 + std::cos(theta)};
    picture.setpixel(k % 256, k / 256, value);
  }
  ASSERT_TRUE(picture.write(path));
  worldFromObject = Motion::still(mat4(vec4(0, 1, 0, 0), vec4(-1, 0, 0, 0), vec4(0, 0, 1, 0), vec4(0, 0, 0, 1)));
  const std::vector<vec3> c = asked(2, [&](sl::Surface& s) {
    Color color, sum;
    Vector direction, redDirection;
    Float solidAngle, hits = 0, length;
    gather(("environment:" + path).c_str(), s.P, Vector(), 0, 4096, rays("environmentspace", "object"),
           {{"environment:color", &color}, {"environment:solidangle", &solidAngle}, {"ray:direction", &direction}, {"ray:length", &length}}, [&] { hits += 1; },
           [&] { sum += color * solidAngle, redDirection += xcomp(color) * solidAngle * direction; });
    EXPECT_EQ(hits[0], 0);
    EXPECT_EQ(length[0], 1e30f);
    EXPECT_NEAR(redDirection[0].x, 0, 0.05f);
    EXPECT_NEAR(redDirection[0].y, 4 * kPi / 3, 0.05f);
    s.Ci = sum;
  });
  expectColor(c[0], vec3(4 * kPi), 0.1f);
  EXPECT_TRUE(services.asked.empty()) << "nothing is traced";
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(BatchServices, ImportanceIsTheProductOfWeights) {
  ShadeContext context;
  context.importance = 0.25f;
  const std::vector<vec3> c = asked(2, [](sl::Surface& s) {
    Float importance, shadow;
    std::string type, label;
    EXPECT_TRUE(rayinfo("importance", importance) && rayinfo("shadowdepth", shadow) && rayinfo("type", type) && rayinfo("label", label));
    EXPECT_FALSE(rayinfo("depth", type)) << "a number is no text";
    EXPECT_EQ(type, "camera");
    trace(s.P, s.I, "weight", 0.5);
    s.Ci = Color(importance, shadow, traceDistance(s.P, s.I, "maxdist", 2));
  }, context);
  expectColor(c[0], {0.25f, 0, 1e30f});
  EXPECT_EQ(services.asked[0].importance, 0.5f);
  EXPECT_EQ(services.asked[1].maxDistance, 2);
}

TEST_F(BatchServices, RandomgridIsOneNumberOfACallAndOfTheObjectsName) {
  attributes.name = "left";
  float first = 0;
  const std::vector<vec3> c = asked(64, [&](sl::Surface& s) { s.Ci = Color(s.randomgrid(), s.randomgrid(), 0) + Triple(0, 0, 1) * random3(); });
  first = c[0].x;
  for (size_t i = 0; i < 32; ++i) {
    EXPECT_EQ(c[i].x, first);
    EXPECT_NE(c[i].y, first);
    if (i > 0) { EXPECT_NE(c[i].z, c[i - 1].z) << "random() differs from point to point"; }
  }
  EXPECT_TRUE(first >= 0 && first < 1);
}

TEST_F(BatchServices, PointsKnowTheRayThatCame) {
  ShadeContext context;
  context.kind = RayKind::Diffuse, context.depth = 2, context.specularDepth = 1, context.label = "here";
  const std::vector<vec3> c = asked(2, [](sl::Surface& s) {
    Triple depth;
    EXPECT_TRUE(rayinfo("diffusedepth", depth));
    EXPECT_FALSE(rayinfo("colour", depth));
    EXPECT_TRUE(isindirectray());
    EXPECT_FALSE(isshadowray());
    EXPECT_EQ(raylabel(), "here");
    EXPECT_EQ(raydepth(), 3);
    s.Ci = depth;
  }, context);
  EXPECT_EQ(c[0].x, 2);
}

TEST_F(BatchServices, DiffuseRaysAreThatWhetherTheyWantHighlightsOrNot) {
  light("distantlight");
  ShadeContext context;
  context.kind = RayKind::Diffuse;
  for (const bool wanted : {false, true}) {
    context.highlights = wanted;
    const std::vector<vec3> c = asked(1, [](sl::Surface& s) {
      Triple wants;
      EXPECT_TRUE(isindirectray());
      EXPECT_TRUE(rayinfo("highlights", wants));
      s.Ci = Color(xcomp(wants), xcomp(phong(s.N, -s.I, 1)), xcomp(specular(s.N, -s.I, 8)));
    }, context);
    EXPECT_EQ(c[0].x, wanted);
    EXPECT_NEAR(c[0].y, wanted, 1e-5f);
    EXPECT_NEAR(c[0].z, wanted, 1e-5f);
  }
}

TEST_F(BatchServices, ASpaceThatThereIsNotIsToldAndChangesNothing) {
  const std::vector<vec3> c = asked(2, [](sl::Surface& s) { s.Ci = transform("nowhere", s.P); });
  expectColor(c[0], {0, 0, 5});
  ASSERT_EQ(log.count("shader-space-obedient"), 1);
  EXPECT_NE(log.entries()[0].message.find("\"nowhere\""), std::string::npos);
}

TEST_F(BatchServices, PrintingIsForThePointsOfTheMask) {
  ::testing::internal::CaptureStderr();
  asked(4, [](sl::Surface& s) { s.printf("%f at %p in %s", s.u, s.P, "here"); });
  EXPECT_EQ(::testing::internal::GetCapturedStderr(),
            "0.000000 at 0.000000 0.000000 5.000000 in here\n0.250000 at 0.000000 0.000000 5.000000 in here\n");
}

/// Notes the widths of rays and answers nothing.
class Widths : public ShadeServices {
 public:
  mutable std::vector<vec2> noted;
  void trace(const ShadePoints&, const uint8_t*, TmConstVec3, TmConstVec3, const RayQuery& query, const ShadeContext&, const RayResult& result) const override {
    noted.emplace_back(query.radius[0], query.spread[0]);
    result.distance[0] = kInfinity;
  }
  void transmission(const ShadePoints&, const uint8_t*, TmConstVec3, const ShadowRays&, const ShadeContext&, TmVec3) const override {}
  bool sampleEmitter(int, int, TmConstVec3, const float*, const float*, const EmitterPoints&) const override { return false; }
  void meetEmitter(int, int, TmConstVec3, TmConstVec3, const EmitterPoints&) const override {}
  float emitterReach(int) const override { return 0; }
  void indirectDiffuse(const ShadePoints&, const uint8_t*, TmConstVec3, const IndirectQuery&, const ShadeContext&, IndirectResult) const override {}
};

// Differentials: rays start as wide as the micropolygon and widen with it and with the cone.
TEST_F(BatchServices, RaysAreAsWideAsWhatTheyLeave) {
  const Widths wide;
  body = [](sl::Surface& s) {
    TmRayOptions cone = rsl::defaultRays();
    cone.coneAngle = 0.1f, cone.samples = 4;
    s.Ci = trace(s.P, -s.I);
    s.Ci += trace(s.P, -s.I, cone);
  };
  ShadePoints p = points({vec3(0, 0, 5)});
  p.set3(kDpduX, 0, {3, 0, 0}), p.set3(kDpdvX, 0, {0, 4, 0}), p.set3(kIx, 0, {0, 0, 5});
  p.channel(kDu)[0] = p.channel(kDv)[0] = 0.01f;
  system().setServices(&wide);
  shade(p);
  ASSERT_EQ(wide.noted.size(), 5u);
  EXPECT_NEAR(wide.noted[0].x, 0.025f, 1e-6f);
  EXPECT_NEAR(wide.noted[0].y, 0.04f / 5, 1e-6f) << "as a mirror spreads what the eye sees";
  EXPECT_NEAR(wide.noted[1].y, 0.04f / 5 + 0.05f, 1e-6f);
}

}  // namespace
}  // namespace tomales
