// What is said of shaders that ask for what they have not declared or what there is not, and what they get instead.
#include <array>
#include <functional>

#include "reyes/shader.h"
#include "tests/unit/shade/neighbours.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace complaints {
namespace {

std::function<void(const TmGrid*)> act;
void acting(const TmGrid* g) { act(g); }
const rsl::Shader bareShader(TM_SURFACE, "bare", "", 0, acting, {});
const rsl::Shader deriveShader(TM_SURFACE, "derive", "", TM_DERIVATIVES, acting, {});
const rsl::Shader wideShader(TM_SURFACE, "wide", "", TM_NEIGHBOURS, acting, {});

class Complaints : public Stage {
 protected:
  Complaints() {
    static const TmShader* const shaders[] = {bareShader, deriveShader, wideShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
  }
  /// Runs `what` in place of a shader over one point.
  void run(const char* shader, const std::function<void(const TmGrid*)>& what, bool steps = false) {
    shading.reset();
    scene.objects.clear();
    surface(shader);
    act = what;
    const ShadePoints p = points({vec3(0, 0, 5)});
    shade(steps ? withSteps(p) : p);
  }
};

TEST_F(Complaints, ADerivativeOfWhatAShaderHasComputedNeedsNeighbours) {
  run("derive", [](const TmGrid* g) {
    rsl::Array value(g), out(g);
    value[0] = 7;
    g->call->derivative(g->host, g, 0, value.data(), out.data());
    EXPECT_EQ(out[0], 0);
  });
  EXPECT_EQ(log.count("shader-derivative"), 1);
}

TEST_F(Complaints, ADerivativeOfWhatAPointKnowsNeedsNone) {
  surface("derive");
  float expected = 0;
  ShadePoints p = withSteps(points({vec3(1, 2, 5)}));
  p.channel(kDu)[0] = 0.5f;
  p.channel(kDv)[0] = 0.25f;
  p.set3(kDpduX, 0, {2, 3, 4});
  p.set3(kDpdvX, 0, {5, 6, 7});
  p.channel(kU)[0] = 0.1f;  // all of them differ
  p.channel(kV)[0] = 0.2f;
  p.channel(kS)[0] = 0.3f;
  p.channel(kT)[0] = 0.4f;
  p.set3(kNx, 0, {0.5f, 0.6f, 0.7f});
  for (const bool v : {false, true})
    for (const int step : std::array<int, 7>{kStepS, kStepT, kStepU, kStepV, kStepN, kStepN + 1, kStepN + 2})
      p.step(step, v)[0] = expected += 1;
  act = [&](const TmGrid* g) {
    const auto derivative = [&](int direction, const float* value) {
      rsl::Array out(g);
      g->call->derivative(g->host, g, direction, value, out.data());
      return out[0];
    };
    for (int direction = 0; direction < 2; ++direction) {
      const float* const P[] = {g->P.x, g->P.y, g->P.z};
      for (int k = 0; k < 3; ++k)
        EXPECT_FLOAT_EQ(derivative(direction, P[k]), static_cast<float>(3 * direction + 2 + k)) << k;
      const float size = direction ? 0.25f : 0.5f;
      int step = 7 * direction;
      for (const float* value : {g->s, g->t, g->u, g->v, static_cast<const float*>(g->N.x),
                                 static_cast<const float*>(g->N.y), static_cast<const float*>(g->N.z)})
        EXPECT_FLOAT_EQ(derivative(direction, value), static_cast<float>(++step) / size) << step;
    }
  };
  shade(p);
  ShadePoints stepless = points({vec3(1, 2, 5)});
  for (const int c : {kU, kV, kDu, kDv}) stepless.channel(c)[0] = p.channel(c)[0];
  act = [&](const TmGrid* g) {
    rsl::Array out(g);
    for (const auto& [direction, value, is] :
         {std::tuple(0, g->u, 1.0f), {1, g->u, 0.0f}, {0, g->v, 0.0f}, {1, g->v, 1.0f}}) {
      g->call->derivative(g->host, g, direction, value, out.data());
      EXPECT_EQ(out[0], is) << direction;
    }
  };
  shade(stepless);
  EXPECT_EQ(log.entries().size(), 0u);
}

TEST_F(Complaints, APictureAtComputedPlacesIsNotFilteredWithoutNeighbours) {
  const auto lookUp = [](const TmGrid* g) {
    rsl::Array s(g);
    rsl::Vec3Array out(g);
    s[0] = 0.7f;
    g->call->texture(g->host, g, "", nullptr, s.data(), s.data(), out);
  };
  run("wide", lookUp, true);
  run("derive", lookUp);
  EXPECT_EQ(log.count("shader-footprint"), 0) << "neighbours serve, or points have no steps to be of use";
  run("derive", lookUp, true);
  EXPECT_EQ(log.count("shader-footprint"), 1);
  run("bare", lookUp);
  EXPECT_EQ(log.entries().size(), 2u) << "the other shader";
}

TEST_F(Complaints, APictureWithoutANameHasItsFillAtActivePoints) {
  run("bare", [](const TmGrid* g) {
    TmGrid some = *g;
    std::vector<uint8_t> active(static_cast<size_t>(g->padded), 0);
    some.active = active.data();
    rsl::Vec3Array out(g);
    out.set(0, {9, 9, 9});
    TmTextureOptions options = tmTextureDefaults();
    options.fill = 0.25f;
    g->call->texture(g->host, &some, "", &options, g->s, g->t, out);
    EXPECT_EQ(out[0].x, 9);
    active[0] = 1;
    TmVec3 red = out;
    red.y = red.z = nullptr;
    g->call->texture(g->host, &some, "", &options, g->s, g->t, red);
    EXPECT_EQ(out[0].x, 0.25f);
    EXPECT_EQ(out[0].y, 9);
    g->call->texture(g->host, &some, "", &options, g->s, g->t, out);
    EXPECT_EQ(out[0].z, 0.25f);
  });
}

TEST_F(Complaints, AnEnvironmentStandsInTheWorldIfItsSpaceIsUnknown) {
  run("bare", [](const TmGrid* g) {
    TmRayOptions options = tmRayDefaults();
    options.environment = "";
    options.environmentSpace = "nowhere";
    std::vector<uint8_t> hit(static_cast<size_t>(g->padded), uint8_t{7});
    g->call->gather(g->host, g, &options, rsl::view(g->P), rsl::view(g->N), 0, hit.data(), nullptr, 0);
    EXPECT_EQ(hit[0], 0);
  });
  EXPECT_EQ(log.count("shader-space"), 1);
}

TEST_F(Complaints, RaysThatAreNotDeclaredMeetNothing) {
  surface("bare");
  act = [](const TmGrid* g) {
    rsl::Vec3Array color(g);
    rsl::Array distance(g);
    color.set(0, {9, 9, 9});
    g->call->trace(g->host, g, nullptr, rsl::view(g->P), rsl::view(g->N), color, distance.data());
    EXPECT_EQ(color[0].x, 0);
    EXPECT_GE(distance[0], 1e30f);
  };
  system().setServices(nullptr);
  shadeOne();
  EXPECT_EQ(log.count("shader-traces"), 1);
}

TEST_F(Complaints, BouncedLightThatIsAskedForBesideAnAddedLightMayCountTwice) {
  for (const bool added : {false, true}) {
    scene.options.wantsIndirect = added;
    run("bare", [](const TmGrid* g) {
      rsl::Vec3Array radiance(g);
      TmOcclusion wanted = tmOcclusionDefaults();
      wanted.radiance = radiance;
      g->call->occlusion(g->host, g, nullptr, rsl::view(g->P), rsl::view(g->N), &wanted);
    });
    EXPECT_EQ(log.count("light-twice"), added);
  }
}

TEST_F(Complaints, AConventionOfHighlightsThatNobodyKnowsIsTold) {
  for (const char* known : {"prman", "rispec"}) {
    scene.options.user["shade:specular"] = text("specular", known);
    system();
    shading.reset();
  }
  EXPECT_EQ(log.count("option-specular"), 0);
  scene.options.user["shade:specular"] = text("specular", "phong");
  system();
  EXPECT_EQ(log.count("option-specular"), 1);
}

TEST_F(Complaints, AnOutputThatASceneGivesIsTold) {
  surface("plastic", {color("ambient", vec3(1))});
  system();
  EXPECT_EQ(log.count("shader-parameter-output"), 1);
}

TEST_F(Complaints, AShaderOfAnotherKindIsNamedAsThat) {
  EXPECT_EQ(registry.hintOfMissing("fog", TM_SURFACE, "/nowhere", ""), "; the shader of that name is a volume");
  EXPECT_EQ(registry.hintOfMissing("plastik", TM_SURFACE, "/nowhere", ""), "; did you mean \"plastic\"?");
}

TEST_F(Complaints, APluginWhoseParametersLackANameALengthOrATypeIsRefused) {
  TmParamDecl good{"a", TM_FLOAT, 1, nullptr, nullptr, "", TM_ROLE_NONE}, nameless = good, empty = good, odd = good;
  nameless.name = nullptr;
  empty.arrayLength = 0;
  odd.type = TM_MATRIX + 1;
  for (const TmParamDecl& second : {nameless, empty, odd, good}) {
    const TmParamDecl params[] = {good, second};
    TmShader shader = *bareShader;
    shader.name = "fresh";
    shader.params = params;
    shader.paramCount = 2;
    shader.paramBytes = sizeof(TmParamDecl);
    const TmShader* const list[] = {&shader};
    const TmShaderLibrary library = rsl::libraryOf(list);
    ShaderRegistry fresh(log);
    fresh.addLibrary(&library, "test.so");
    const bool whole = second.name && second.type == TM_FLOAT && second.arrayLength == 1;
    EXPECT_EQ(fresh.find("fresh", TM_SURFACE, "") != nullptr, whole);
  }
  const std::vector<LogEntry> said = log.entries();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].count, 3);
  EXPECT_NE(said[0].message.find("lacks a name, length or type of parameter 2"), std::string::npos);
}

TEST_F(Complaints, ALibraryWithAFaultIsRefusedAndSaysWhy) {
  const TmShader* const list[] = {bareShader};
  TmShaderLibrary library = rsl::libraryOf(list);
  library.fault = "two parameters have one name";
  ShaderRegistry fresh(log);
  EXPECT_FALSE(fresh.addLibrary(&library, "test.so"));
  EXPECT_EQ(fresh.find("bare", TM_SURFACE, ""), nullptr);
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_NE(log.entries()[0].message.find("two parameters have one name"), std::string::npos);
}

}  // namespace
}  // namespace complaints
}  // namespace tomales
