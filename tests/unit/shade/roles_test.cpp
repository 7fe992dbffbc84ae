// What the host knows of shaders by the roles of their parameters, whatever these are called.
#include <fstream>
#include <regex>

#include "places.h"
#include "reyes/shader.h"
#include "reyes/shader_registry.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace roles_tests {
namespace {

/// An area light: its radiance is `power`, times x on its surface, times how straight it is looked at.
rsl::FloatParam power("power", 1, "");
rsl::FloatParam points("n", 3, "", TM_ROLE_SAMPLES), seen("seen", 1, "", TM_ROLE_VISIBLE);
void shadeLamp(const TmGrid* g) {
  for (int i : rsl::Batch(g)) {
    const rsl::Vec3 toViewer = rsl::normalize(-1 * rsl::get(g->L, i));
    rsl::set(g->Cl, i, power(g, i) * g->Pl.x[i] * rsl::dot(toViewer, rsl::get(g->Nl, i)) * rsl::Color{1, 0, 0});
  }
}
const rsl::Shader lamp(TM_LIGHT, "lamp", "", TM_LIGHT_AREA, shadeLamp, {&power, &points, &seen});

/// An indirect light and a filter of it, with names of their own.
rsl::FloatParam rays("r", 600, "", TM_ROLE_SAMPLES), gain("gain", 1, "", TM_ROLE_SCALE),
    bounces("deep", 2, "", TM_ROLE_BOUNCES);
rsl::ColorParam tint("tone", {1, 1, 1}, "", TM_ROLE_TINT);
rsl::StringParam method("how", "shader", "", TM_ROLE_HIT_RADIANCE), maps("where", "", "", TM_ROLE_ATLAS);
rsl::StringParam of("of", "", "", TM_ROLE_INDIRECT_SOURCE);
void shadeNothing(const TmGrid*) {}
const rsl::Shader bounce(TM_LIGHT, "bounce", "", TM_LIGHT_INDIRECT, shadeNothing,
                         {&rays, &gain, &tint, &method, &maps, &bounces});
void shadeFilter(const TmGrid* g) {
  const rsl::Batch b(g);
  const rsl::Vec3Array N = b.facingNormals();
  rsl::Vec3Array E(g), red(g), green(g), blue(g);
  TmVec3 dominant[3] = {red, green, blue};
  g->call->indirectDiffuse(g->host, g, N, E, dominant);
  for (int i : b) b.illuminate(i, N[i], g->sample == 0 ? E[i] : rsl::Color{});
}
const rsl::Shader filter(TM_LIGHT, "filter", "", TM_LIGHT_INDIRECT, shadeFilter, {&of});

rsl::StringParam picture("picture", "", "", TM_ROLE_SHADOW_MAP);
rsl::FloatOutput unseen("unseen", "", TM_ROLE_NONDIFFUSE);
void shadeBeam(const TmGrid* g) {
  const rsl::Batch b(g);
  for (int i : b) {
    b.illuminate(i, {0, 0, -1}, {1, 1, 1});
    if (unseen.wanted(g)) unseen.set(g, i, 0.75f);
  }
}
const rsl::Shader beam(TM_LIGHT, "beam", "", TM_LIGHT_SOLAR, shadeBeam, {&picture, &unseen});

rsl::ColorParam drops("drops", {1, 2, 3}, "", TM_ROLE_SCATTERING);
const rsl::Shader mist(TM_VOLUME, "mist", "", 0, shadeNothing, {&drops});

/// Names that built-in lights have, without roles.
rsl::FloatParam samples("samples", 5, ""), visible("visible", 0, "");
const rsl::Shader plain(TM_LIGHT, "plain", "", TM_LIGHT_AREA, shadeNothing, {&samples, &visible});

class Roles : public Stage {
 protected:
  Roles() {
    static const TmShader* const shaders[] = {lamp, bounce, filter, beam, mist, plain};
    static const TmShaderLibrary library = {TM_SHADER_ABI, sizeof(TmShaderLibrary), shaders, nullptr, 6};
    registry.addLibrary(&library, "test");
    surface("matte");
  }
};

TEST_F(Roles, ALampIsSeenAsItsShaderSaysWhereAndFromWhereItIsSeen) {
  light("lamp", {number("power", 4)}, true);
  attributes.areaLight = 0;
  ShadePoints p = points({vec3(1, 0, 5), vec3(2, 0, 5), vec3(2, 0, 5), vec3(2, 0, 5)});
  p.set3(kIx, 2, 3.0f * vec3(0.6f, 0, 0.8f));
  p.set3(kIx, 3, {0, 0, -1});  // from behind
  const std::vector<vec3> out = emissionOf(system(), p);
  ASSERT_EQ(out.size(), 4u);
  expectColor(out[0], {4, 0, 0});
  expectColor(out[1], {8, 0, 0});
  expectColor(out[2], {8 * 0.8f, 0, 0});
  expectColor(out[3], vec3(0), 0);
}

TEST_F(Roles, ALampThatIsNotFiniteIsDarkAndItIsSaid) {
  light("lamp", {number("power", kInfinity)}, true);
  attributes.areaLight = 0;
  const std::vector<vec3> out = emissionOf(system(), points({vec3(1, 0, 5)}));
  ASSERT_EQ(out.size(), 1u);
  expectColor(out[0], vec3(0), 0);
  EXPECT_EQ(log.count("light-not-finite"), 1);
}

TEST_F(Roles, ALampIsHiddenByItsRole) {
  light("lamp", {number("seen", 0)}, true);
  attributes.areaLight = 0;
  EXPECT_TRUE(emissionOf(system(), points({vec3(1, 0, 5)})).empty());
}

TEST_F(Roles, AnIndirectLightOfAnyNameIsKnownForOne) {
  scene.options.wantsIndirect = true;
  light("bounce", {number("r", 77), number("deep", 3), text("how", "points"), text("where", "clouds")}).handle = "gi";
  ASSERT_TRUE(system().group(0).indirectQuery());
  EXPECT_EQ(system().group(0).indirectQuery()->samples, 77);
  EXPECT_EQ(system().group(0).indirectQuery()->bounces, 3);
  ASSERT_TRUE(system().indirectRequest());
  EXPECT_EQ(system().indirectRequest()->method, giMethodNamed("points"));
  EXPECT_EQ(system().indirectRequest()->atlas, "clouds");
  EXPECT_EQ(system().indirectRequest()->bounces, 3);
  services.E = vec3(1);
  expectColor(shadeOne(), vec3(0), 0);  // it brings nothing, and no other has been added
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Roles, AFilterBringsItsSourceWithScaleAndTint) {
  light("bounce", {number("gain", 2), color("tone", {1, 2, 3})}).handle = "gi";
  attributes.lights.clear();
  light("filter", {text("of", "gi")});
  services.E = vec3(1);
  expectColor(shadeOne(), {2, 4, 6});
}

TEST_F(Roles, AShadowMapIsKnownByItsRole) {
  light("beam", {text("picture", "raytrace")});
  shadeOne();
  EXPECT_EQ(services.shadowRays, 1) << "the host traces the shadows of a map called raytrace";
  ASSERT_EQ(log.entries().size(), 0u);
}

TEST_F(Roles, AnOutputMaySayHowMuchDiffuseLeavesOut) {
  light("beam");
  expectColor(shadeOne(), vec3(0.25f));
}

TEST_F(Roles, PhotonsMeetTheMediumThatAVolumeDeclares) {
  auto inside = std::make_shared<ShaderCall>(call("mist", {color("absorption", {4, 5, 6})}));
  attributes.interior = inside;
  attributes.exterior = std::make_shared<ShaderCall>(call("fog", {color("scattering", {0.5f, -1, 0})}));
  const MediumColors in = system().group(0).medium(true), out = system().group(0).medium(false);
  EXPECT_EQ(in.scattering, vec3(1, 2, 3));
  EXPECT_EQ(in.absorption, vec3(4, 5, 6));
  EXPECT_EQ(out.scattering, vec3(0.5f, 0, 0));
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Roles, ANameAloneIsNoRole) {
  light("plain", {}, true);
  attributes.areaLight = 0;
  EXPECT_EQ(emissionOf(system(), points({vec3(0, 0, 5)})).size(), 1u);
  EXPECT_EQ(system().mostAreaSamples(), 16);
}

std::string contentOf(const std::string& file) {
  std::ifstream in(std::string(TOMALES_SOURCE_DIR) + "/" + file);
  std::stringstream out;
  out << in.rdbuf();
  return out.str();
}

TEST_F(Roles, EachIsExplainedAndSoAreTheStandardParameters) {
  const std::string page = contentOf("docs/shader_writing.md"), header = contentOf("reyes/shader/types.h");
  const std::regex role("(TM_ROLE_[A-Z_]+) = (\\d+)");
  int count = 0;
  for (std::sregex_iterator it(header.begin(), header.end(), role), end; it != end; ++it) {
    if ((*it)[2] == "0") continue;
    EXPECT_NE(page.find("`" + (*it)[1].str() + "`"), std::string::npos) << (*it)[1];
    EXPECT_NE(roleName(std::stoi((*it)[2])), nullptr) << (*it)[1];
    ++count;
  }
  EXPECT_GT(count, 20);
  for (const TmKind kind : {TM_LIGHT, TM_VOLUME})
    for (const TmParamDecl& p : standardParams(kind))
      EXPECT_TRUE(page.find(p.name) != std::string::npos || std::string(p.name).starts_with("sf")) << p.name;
}

TEST_F(Roles, AShaderWithARoleThatDoesNotFitIsRefused) {
  static rsl::StringParam word("word", "", "", TM_ROLE_SAMPLES);
  static rsl::FloatParam future("future", 0, "", static_cast<TmRole>(1000)), stray("stray", 0, "", TM_ROLE_SAMPLES);
  static const rsl::Shader ofType(TM_LIGHT, "of type", "", 0, shadeNothing, {&word}),
      ofFuture(TM_LIGHT, "of future", "", 0, shadeNothing, {&future}),
      ofKind(TM_SURFACE, "of kind", "", 0, shadeNothing, {&stray});
  const TmShader* const shaders[] = {ofType, ofFuture, ofKind};
  const TmShaderLibrary library = {TM_SHADER_ABI, sizeof(TmShaderLibrary), shaders, nullptr, 3};
  registry.addLibrary(&library, "roles.so");
  EXPECT_EQ(registry.find("of type", TM_LIGHT, ""), nullptr);
  EXPECT_EQ(registry.find("of future", TM_LIGHT, ""), nullptr);
  EXPECT_EQ(registry.find("of kind", TM_SURFACE, ""), nullptr);
}

}  // namespace
}  // namespace roles_tests
}  // namespace tomales
