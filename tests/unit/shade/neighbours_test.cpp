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

rsl::FloatOutput height("height", "");
void writeHeight(const TmGrid* g) {
  for (int i = 0; i < g->count; ++i) {
    if (height.wanted(g)) height.set(g, i, g->P.x[i] + 1);
    rsl::set(g->Ci, i, {g->P.x[i], 2, 3});
    rsl::set(g->Oi, i, {1, 0.5f, g->P.x[i]});
  }
}
const rsl::Shader writingShader(TM_SURFACE, "writing", "", TM_NEIGHBOURS, writeHeight, {&height});

TEST_F(Neighbours, LeaveColoursAndOutputsToTheirPoint) {
  static const TmShader* const shaders[] = {writingShader};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  surface("writing");
  const std::vector<RayOutput> wanted = {{"surface:height", 1}, {"surface:absent", 1}};
  ShadeContext context;
  context.outputs = &wanted;
  std::vector<vec3> places;
  for (int i = 0; i < 300; ++i) places.push_back({static_cast<float>(i), 0, 5});  // two parts of a batch
  const ShadedPoints out = shade(withSteps(points(places)), context);
  for (size_t i = 0; i < 300; ++i) {
    const auto x = static_cast<float>(i);
    EXPECT_EQ(out.color(static_cast<int>(i)), vec3(x, 2, 3));
    EXPECT_EQ(out.opacity(static_cast<int>(i)), vec3(1, 0.5f, x));
    EXPECT_EQ(out.variables[0][i], x + 1);
    EXPECT_TRUE(std::isnan(out.variables[1][i]));
  }
}

rsl::FloatParam heat("heat", 0, ""), dust("dust", 0, "");
void differHeat(const TmGrid* g) {
  rsl::Array along(g), across(g);
  g->call->derivative(g->host, g, 0, g->params[1].c[0], along.data());
  g->call->derivative(g->host, g, 1, g->params[1].c[0], across.data());
  for (int i = 0; i < g->count; ++i) rsl::set(g->Ci, i, {along[i], across[i], 0});
}
const rsl::Shader differingHeat(TM_SURFACE, "differing heat", "", TM_DERIVATIVES, differHeat, {&heat, &dust});

TEST_F(Neighbours, AreNotNeededToKnowHowAVariableOfTheGeometryChanges) {
  static const TmShader* const shaders[] = {differingHeat};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  surface("differing heat");
  primvar("heat", ValueType::Float);
  primvar("dust", ValueType::Float);
  ShadePoints p = withSteps(points({vec3(0, 0, 5), vec3(1, 0, 5)}));
  for (int i = 0; i < 2; ++i) {
    p.primvar(0)[i] = 7;
    p.primvar(1)[i] = 10 + static_cast<float>(i);
    p.channel(kDu)[i] = 0.5f;
    p.channel(kDv)[i] = 0.25f;
    p.step(kStepPrimvars + 1, false)[i] = 2;
    p.step(kStepPrimvars + 1, true)[i] = 3 + static_cast<float>(i);
  }
  const ShadedPoints out = shade(p);
  expectColor(out.color(0), {4, 12, 0});
  expectColor(out.color(1), {4, 16, 0});
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
