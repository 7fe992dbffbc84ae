// Lights of RSL on the geometry of AreaLightSource. A light brings the mean of what it brings from each of its points
// alone.
#include <fstream>

#include "reyes/rsl_host.h"
#include "reyes/shader.h"
#include "tests/unit/shade/bare_services.h"
#include "tests/unit/shade/stage.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

constexpr float kLampArea = 2, kLampReach = 0.25f, kMeetPdf = 0.5f;

/// Geometry all of whose samples are one point, at z = 3, so that the mean is what comes from there. Directions meet it
/// twice, at z = 3 and z = 2.
class OnePlace : public test::BareServices {
 public:
  struct Shadow {
    vec3 end;
    int through;
  };
  mutable std::vector<Shadow> shadows;

  static void put(const EmitterPoints& out, int i, const vec3& P, float pdf, float meetPdf) {
    set(out.P, i, P);
    set(out.N, i, {0, 0, 1});
    out.pdf[i] = pdf;
    out.meetPdf[i] = meetPdf;
  }
  bool sampleEmitter(int, int count, TmConstVec3 from, const float*, const float*,
                     const EmitterPoints& out) const override {
    for (int i = 0; i < count; ++i) {
      const vec3 place(0, 0, 3), path = place - get(from, i);
      const float distance = glm::length(path);
      put(out, i, place, distance * distance * distance / (-path.z * kLampArea), 0);
    }
    return true;
  }
  bool sampleWholeEmitter(int, int count, TmConstVec3, const float*, const float*,
                          const EmitterPoints& out) const override {
    for (int i = 0; i < count; ++i) put(out, i, {0, 0, 3}, 1 / kPi, 0);
    return true;
  }
  void meetEmitter(int light, int count, TmConstVec3 from, TmConstVec3 direction,
                   const EmitterPoints& out) const override {
    meetWholeEmitter(light, 0, count, from, direction, out);
  }
  void meetWholeEmitter(int, int layer, int count, TmConstVec3, TmConstVec3, const EmitterPoints& out) const override {
    for (int i = 0; i < count; ++i)
      put(out, i, {0, 0, 3 - static_cast<float>(layer)}, layer < 2 ? kMeetPdf : 0, kMeetPdf);
  }
  float emitterReach(int) const override { return kLampReach; }
  float emitterArea(int) const override { return kLampArea; }
  void transmission(const ShadePoints& points, const uint8_t* active, TmConstVec3 toward, const ShadowRays& rays,
                    const ShadeContext&, TmVec3) const override {
    for (int i = 0; i < points.count(); ++i)
      if (active[i]) shadows.push_back({points.position(i) + get(toward, i), rays.through});
  }
};

constexpr float kLobePdf = 0.75f;
void lookAlong(const TmGrid* g) {
  const auto n = static_cast<size_t>(g->padded);
  std::vector<float> zero(n, 0.0f), down(n, -1.0f), pdf(n, kLobePdf);
  g->call->lightAlong(g->host, g, {zero.data(), zero.data(), down.data()}, pdf.data(), 1, 4, g->Ci);
}
const rsl::Shader lookingShader(TM_SURFACE, "looking", "", 0, lookAlong, {});

class RslLamps : public Stage {
 protected:
  RslLamps() {
    const std::string folder = test::temporary("rsl_lamps");
    std::filesystem::create_directories(folder);
    scene.options.searchPaths["shader"] = folder;
    std::ofstream(folder + "/faced.sl")
        << "light faced(float power = 8;) { illuminate (P, N, PI / 2) Cl = power / (L . L); }";
    std::ofstream(folder + "/round.sl") << "light round(float power = 8;) { illuminate (P) Cl = power / (L . L); }";
    static const TmShader* const shaders[] = {lookingShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
    attributes.areaLight = 0;
  }
  /// Begins anew with one lamp.
  void put(const std::string& name) {
    shading.reset();
    scene.objects.clear();
    scene.lights.clear();
    attributes.lights.clear();
    lamp.shadows.clear();
    light(name, {number("__visible", 1)}, true).castsShadows = true;
    system().setServices(&lamp);
  }
  vec3 glow(const vec3& I) {
    ShadePoints p = points({vec3(0, 0, 5)});
    p.set3(kIx, 0, I);
    return emissionOf(system(), p).at(0);
  }
  OnePlace lamp;
};

TEST_F(RslLamps, BringTheMeanOfTheLightOfTheirPoints) {
  surface("matte", {number("Ka", 0), number("Kd", 1)});
  for (const char* name : {"faced", "round"}) {
    put(name);
    const ShadedPoints out = shade(points({vec3(0, 0, 5), vec3(3, 0, 5)}));
    expectColor(out.color(0), vec3(8.0f / 4));
    expectColor(out.color(1), vec3(8.0f / 13 * 2 / std::sqrt(13.0f)));
  }
}

TEST_F(RslLamps, SendShadowRaysToJustBeforeTheirGeometryOrThroughAllOfIt) {
  surface("matte");
  for (const auto& [name, end, through] : {std::tuple("faced", 3 + kLampReach, -1), {"round", 3.0f, 0}}) {
    put(name);
    shadeOne();
    EXPECT_EQ(lamp.shadows.size(), size_t{kDefaultLightSamples});
    for (const OnePlace::Shadow& shadow : lamp.shadows) {
      EXPECT_NEAR(shadow.end.z, end, 1e-6f) << name;
      EXPECT_EQ(shadow.through, through) << name;
    }
  }
}

// The geometry has the radiance pi distance^2 Cl / (cosine area), whose integral over the area is pi Cl.
TEST_F(RslLamps, GlowAsBrightFromEveryDistanceAndBrighterAtAnAngle) {
  const float straight = 8 * kPi / kLampArea;
  for (const char* name : {"faced", "round"}) {
    put(name);
    expectColor(glow({0, 0, 1}), vec3(straight));
    expectColor(glow({0, 0, 3}), vec3(straight));
    expectColor(glow({2, 0, 2}), vec3(std::sqrt(2.0f) * straight), 1e-4f);
    expectColor(glow({0, 0, -1}), vec3(name == std::string("round") ? straight : 0));
  }
}

TEST_F(RslLamps, WithoutAConeShineAllRound) {
  for (const char* name : {"faced", "round"}) {
    put(name);
    EXPECT_EQ(system().light(0).shinesAllRound(), name == std::string("round"));
  }
}

TEST_F(RslLamps, AreDarkIfNobodyKnowsTheirArea) {
  put("faced");
  system().setServices(nullptr);
  expectColor(glow({0, 0, 1}), vec3(0), 0);
}

// With a = all samples of the lamp times its density and b = 4 directions times theirs, a direction that meets the lamp
// counts b / (a^2 + b^2).
TEST_F(RslLamps, AreSeenInAHighlightWhereverADirectionMeetsThem) {
  surface("looking");
  const float a = kDefaultLightSamples * kMeetPdf, b = 4 * kLobePdf, once = 8 / kLampArea * b / (a * a + b * b);
  for (const auto& [name, times, through] : {std::tuple("faced", 1.0f, -1), {"round", 2.0f, 0}}) {
    put(name);
    expectColor(shadeOne(), vec3(times * once));
    ASSERT_EQ(lamp.shadows.size(), static_cast<size_t>(times));
    for (const OnePlace::Shadow& shadow : lamp.shadows) EXPECT_EQ(shadow.through, through) << name;
    EXPECT_NEAR(lamp.shadows[0].end.z, through < 0 ? 3 + kLampReach : 3, 1e-6f);
  }
}

}  // namespace
}  // namespace tomales
