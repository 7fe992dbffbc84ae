// Light and rays are found at points alone. The neighbours that shaders with TM_NEIGHBOURS have get copies.
#include <functional>

#include "reyes/shader.h"
#include "tests/unit/shade/neighbours.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

std::function<void(const TmGrid*)> ask;
void asking(const TmGrid* g) { ask(g); }
const rsl::Shader askingShader(TM_SURFACE, "asking", "", TM_TRACES | TM_NEIGHBOURS, asking, {});

constexpr int kPoints = 3;

class Neighbours : public Stage {
 protected:
  Neighbours() {
    static const TmShader* const shaders[] = {askingShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
    surface("asking");
    light("pointlight", {point("from", {0.5f, 0, 1})}).castsShadows = true;
    light("environmentlight");
    light("ambientlight");
    services.visible = [](const vec3& P, const vec3&) { return 0.5f + 0.1f * P.x; };
    services.met = [](const vec3& P, const vec3&) { return 1 + P.x; };
    services.seen = [](const vec3&) { return vec3(0.2f, 0.3f, 0.4f); };
    services.E = vec3(0.3f);
  }
  /// Runs `what` over three points and their neighbours.
  void shadeWide(const std::function<void(const TmGrid*)>& what) {
    int calls = 0;
    ask = [&](const TmGrid* g) {
      ++calls;
      what(g);
    };
    shade(withSteps(points({vec3(0, 0, 5), vec3(1, 0, 5), vec3(2, 0, 5)})));
    EXPECT_EQ(calls, 1);
  }
};

TEST_F(Neighbours, GetTheSumsOfLightOfTheirPoint) {
  shadeWide([](const TmGrid* g) {
    Answer all(g), matte(g), shiny(g), bounced(g), red(g), green(g), blue(g);
    const std::vector<float> roughness(all.x.size(), 0.2f);
    TmVec3 dominant[3] = {red.array(), green.array(), blue.array()};
    g->call->ambient(g->host, g, all.array());
    g->call->diffuse(g->host, g, TM_ALL_LIGHT, rsl::view(g->N), matte.array());
    g->call->specular(g->host, g, rsl::view(g->N), rsl::view(g->N), roughness.data(), shiny.array());
    g->call->indirectDiffuse(g->host, g, rsl::view(g->N), bounced.array(), dominant);
    expectCopies(g, all, "ambient");
    expectCopies(g, matte, "diffuse");
    expectCopies(g, shiny, "specular");
    expectCopies(g, bounced, "indirect light");
    for (const Answer* direction : {&red, &green, &blue}) expectCopies(g, *direction, "its direction");
    EXPECT_NE(matte.x[0], matte.x[1]) << "points differ, so that a copy of another one is noticed";
  });
}

TEST_F(Neighbours, AreNoReasonToGatherAgainButEveryNormalOfAPointIs) {
  shadeWide([this](const TmGrid* g) {
    Answer E(g);
    const auto gathersFor = [&](const Answer& N) {
      const int before = services.gathers;
      g->call->indirectDiffuse(g->host, g, {N.x.data(), N.y.data(), N.z.data()}, E.array(), nullptr);
      return services.gathers - before;
    };
    Answer N(g);
    EXPECT_EQ(gathersFor(N), kPoints);
    EXPECT_EQ(gathersFor(N), 0);
    for (std::vector<float>* component : {&N.x, &N.y, &N.z})
      for (size_t i = 0; i < kPoints; ++i) {
        (*component)[i] = 1;
        EXPECT_EQ(gathersFor(N), kPoints) << i;
      }
    for (size_t i = kPoints; i < N.x.size(); ++i) N.x[i] = 1;
    EXPECT_EQ(gathersFor(N), 0);
  });
}

TEST_F(Neighbours, GetTheSamplesOfLightOfTheirPoint) {
  shadeWide([](const TmGrid* g) {
    TmIlluminance query = tmIlluminanceDefaults();
    int samples = 0;
    for (; g->call->illuminance(g->host, g, &query); ++samples) {
      expectCopies(g, query.L, "L");
      expectCopies(g, query.direction, "direction");
      expectCopies(g, query.Cl, "Cl");
      expectCopies(g, query.lit, "lit");
      Answer density(g);
      g->call->lightDensity(g->host, g, query.light, density.x.data());
      expectCopies(g, density.x.data(), "density");
    }
    EXPECT_GT(samples, 1);
    Answer along(g);
    const std::vector<float> density(along.x.size(), 1.0f);
    g->call->lightAlong(g->host, g, rsl::view(g->N), density.data(), 0, 1, along.array());
    expectCopies(g, along, "along a direction");
  });
}

TEST_F(Neighbours, GetWhatTheRaysOfTheirPointMeet) {
  shadeWide([](const TmGrid* g) {
    const TmConstVec3 P = rsl::view(g->P), N = rsl::view(g->N);
    Answer color(g), distance(g), passed(g), covered(g), radiance(g), origin(g), length(g);
    g->call->trace(g->host, g, nullptr, P, N, color.array(), distance.x.data());
    g->call->transmission(g->host, g, nullptr, P, N, passed.array());
    TmOcclusion wanted = tmOcclusionDefaults();
    wanted.covered = covered.x.data();
    wanted.radiance = radiance.array();
    g->call->occlusion(g->host, g, nullptr, P, N, &wanted);
    std::vector<uint8_t> hit(color.x.size(), uint8_t{214});
    const TmChannel outputs[] = {{"ray:origin", origin.array()}, {"ray:length", {length.x.data(), nullptr, nullptr}}};
    EXPECT_TRUE(g->call->gather(g->host, g, nullptr, P, N, 0, hit.data(), outputs, 2));
    expectCopies(g, color, "colour");
    expectCopies(g, distance.x.data(), "distance");
    expectCopies(g, passed, "transmission");
    expectCopies(g, covered.x.data(), "occlusion");
    expectCopies(g, radiance, "radiance");
    expectCopies(g, hit.data(), "hit");
    expectCopies(g, origin, "origin");
    expectCopies(g, length.x.data(), "length");
    EXPECT_NE(distance.x[0], distance.x[1]);
  });
}

}  // namespace
}  // namespace tomales
