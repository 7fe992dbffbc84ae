#include <OpenImageIO/imagebuf.h>

#include <filesystem>

#include "reyes/shader.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

using Binding = Stage;

TEST_F(Binding, AVaryingPrimitiveVariableOverridesTheParameterAndColour) {
  surface("matte", {number("Kd", 0.5f)});
  light("distantlight");
  primvar("Cs", ValueType::Color), primvar("Kd", ValueType::Float);
  ShadePoints p = points({vec3(0, 0, 5), vec3(1, 0, 5)});
  p.primvar(0)[0] = 1, p.primvar(1)[1] = 3;
  p.primvar(3)[0] = 0.25f, p.primvar(3)[1] = 2;
  const ShadedPoints out = shade(p);
  expectColor(out.color(0), {0.25f, 0, 0});
  expectColor(out.color(1), {0, 6, 0});
}

// The dicer has already brought primitive variables to current space; moving them again would be wrong.
TEST_F(Binding, APointAmongThePrimitiveVariablesArrivesAsThePointsHoldIt) {
  static rsl::PointParam where("where", {0, 0, 0}, "a point");
  static const rsl::Shader pointing(TM_SURFACE, "pointing", "", 0,
                                    [](const TmGrid* g) {
                                      for (int i : rsl::Batch(g))
                                        rsl::Batch(g).output(i, where(g, i), {1, 1, 1});
                                    },
                                    {&where});
  static const TmShader* const shaders[] = {pointing};
  const TmShaderLibrary library = {TM_SHADER_ABI, sizeof(TmShaderLibrary), shaders, 1};
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
  EXPECT_TRUE(system().opaque(0));
  shading.reset(), scene.objects.clear();
  attributes.opacity = {1, 1, 0.9f};
  EXPECT_FALSE(system().opaque(0));
  shading.reset(), scene.objects.clear();
  attributes.opacity = vec3(1), primvar("Os", ValueType::Color);
  EXPECT_FALSE(system().opaque(0));
}

TEST_F(Binding, WithoutASurfaceTheHeadlightShaderIsUsed) {
  const vec3 N = glm::normalize(vec3(1, 0, -1));
  expectColor(shade(points({vec3(0, 0, 5)}, N)).color(0), vec3(0.2f + 0.8f * std::sqrt(0.5f)));
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Binding, UnknownShadersAreReportedWithPlaceAndObjectAndReplacedLoudly) {
  surface("nosuch"), displacement("nobump"), light("nolight");
  const vec3 c = shadeOne();
  EXPECT_EQ(c.y, 0) << "magenta";
  EXPECT_GT(c.x, 0);
  const auto entries = log.entries();
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_EQ(log.worst(), Severity::Missing);
  EXPECT_EQ(entries[0].where.line, 5);
  EXPECT_EQ(entries[1].where.line, 7);
  EXPECT_NE(entries[1].message.find("\"thing\""), std::string::npos) << entries[1].message;
  EXPECT_NE(entries[1].message.find("nosuch"), std::string::npos);
  EXPECT_EQ(entries[2].where.line, 8);
}

TEST_F(Binding, UnknownAndMistypedParametersAreWarnedAboutAndDefaulted) {
  surface("matte", {number("Kx", 3), color("Kd", {2, 2, 2})});
  light("distantlight");
  expectColor(shadeOne(), vec3(1));
  EXPECT_EQ(log.entries().size(), 2u);
  EXPECT_EQ(log.worst(), Severity::Warning);
  EXPECT_EQ(log.count("shader-parameter-unknown-matte"), 1);
  EXPECT_EQ(log.count("shader-parameter-type-matte"), 1);
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
  const std::string path = ::testing::TempDir() + "/tomales_shade_texture.tif";
  OIIO::ImageBuf picture(OIIO::ImageSpec(8, 8, 3, OIIO::TypeDesc::FLOAT));
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const float top[3] = {1, 0.5f, 0.25f}, bottom[3] = {0, 0, 1};
      picture.setpixel(x, y, y < 4 ? top : bottom);
    }
  ASSERT_TRUE(picture.write(path));
  surface("paintedplastic", {number("Ks", 0), number("Kd", 1), text("texturename", path)});
  light("distantlight");
  ShadePoints p = points({vec3(0, 0, 5), vec3(0, 0, 5)});
  p.channel(kS)[0] = p.channel(kS)[1] = 0.5f;
  p.channel(kT)[0] = 0.25f, p.channel(kT)[1] = 0.75f;
  const ShadedPoints out = shade(p);
  expectColor(out.color(0), {1, 0.5f, 0.25f});  // t runs down the picture
  expectColor(out.color(1), {0, 0, 1});
  EXPECT_EQ(stats.textures.lookups, 2);

  shading.reset(), scene.objects.clear();
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
  ASSERT_TRUE(system().indirectQuery(0));
  EXPECT_EQ(system().indirectQuery(0)->samples, 65536);
  EXPECT_EQ(system().indirectQuery(0)->bounces, 0);
  EXPECT_EQ(log.count("light-samples"), 1);
  EXPECT_EQ(log.count("light-bounces"), 1);
}

TEST_F(Binding, WhatAnIndirectLightCannotDoIsSaidOnce) {
  light("indirectlight", {text("errorfunction", "guess"), text("radiance", "points"), text("atlas", "maps"),
                          text("subset", "set")});
  system();
  for (const char* name : {"errorfunction", "radiance", "atlas", "subset"})
    EXPECT_EQ(log.count(std::string("light-") + name), 1) << name;
  EXPECT_EQ(log.entries().size(), 4u);
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
