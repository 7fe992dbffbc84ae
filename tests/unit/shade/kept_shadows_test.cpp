// Answers of shadow rays that are kept, so that points can be shaded again without rays.
#include "reyes/ray_answers.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

class KeptShadows : public Stage {
 protected:
  KeptShadows() {
    surface("matte", {number("Ka", 0), number("Kd", 1)});
    services.visible = [](const vec3& P, const vec3&) { return P.x == 0 ? 1.0f : P.x == 1 ? 0.25f : 0.0f; };
    context.answers = &answers;
    answers.recording = true;
  }
  /// The light of points at x = 0, 1, 2 and so on.
  std::vector<float> lit(size_t count = 3, const vec3& N = {0, 0, -1}) {
    services.shadowRays = 0;
    std::vector<vec3> P;
    for (size_t i = 0; i < count; ++i) P.push_back({static_cast<float>(i), 0, 5});
    const ShadedPoints out = shade(points(P, N), context);
    return {out.Ci[0].begin(), out.Ci[0].begin() + static_cast<ptrdiff_t>(count)};
  }
  RayAnswers answers;
  ShadeContext context;
};

TEST_F(KeptShadows, AreThoseThatWereTraced) {
  light("distantlight").castsShadows = true;
  const std::vector<float> first = lit();
  EXPECT_EQ(first, (std::vector<float>{1, 0.25f, 0}));
  EXPECT_EQ(services.shadowRays, 3);
  answers.recording = false;
  services.visible = [](const vec3&, const vec3&) { return 0.5f; };
  EXPECT_EQ(lit(), first);
  EXPECT_EQ(services.shadowRays, 0);
}

TEST_F(KeptShadows, AreTracedAnewForALightThatHasMoved) {
  light("distantlight").castsShadows = true;
  lit();
  answers.recording = false;
  for (const vec3& to : {vec3(0, 0, 1), vec3(0, 1, 1)}) {
    shading.reset();
    scene.objects.clear();
    scene.lights.clear();
    light("distantlight", {point("to", to)}).castsShadows = true;
    lit();
    EXPECT_EQ(services.shadowRays, to.y == 0 ? 0 : 3);
  }
}

TEST_F(KeptShadows, AreThoseOfEveryPointAlsoWhereItsSurfaceIsAvertedNow) {
  light("pointlight", {point("from", {0, 0, 4.5f})}).castsShadows = true;
  lit(3, glm::normalize(vec3(-1, 0, -0.2f)));
  EXPECT_EQ(services.shadowRays, 3);
  answers.recording = false;
  lit();
  EXPECT_EQ(services.shadowRays, 0);
}

TEST_F(KeptShadows, AreTracedWhereNoneWereKept) {
  light("distantlight").castsShadows = true;
  lit(2);
  answers.recording = false;
  EXPECT_EQ(lit(3), (std::vector<float>{1, 0.25f, 0})) << "another batch";
  EXPECT_EQ(services.shadowRays, 3);
}

TEST_F(KeptShadows, AreNamedByTheirSampleTheirLightAndTheirPartOfTheBatch) {
  light("distantlight").castsShadows = true;
  light("arealight", {number("samples", 4)}, true).castsShadows = true;
  services.emitter = [](float a, float b, vec3& P, vec3& N, float& area) {
    P = {a, b, 3};
    N = {0, 0, 1};
    area = 1;
  };
  const std::vector<float> first = lit(300);
  EXPECT_EQ(answers.shadows.size(), 2u * (1 + 4)) << "256 points are a part";
  answers.recording = false;
  services.visible = nullptr;
  EXPECT_EQ(lit(300), first);
  EXPECT_EQ(services.shadowRays, 0);
}

}  // namespace
}  // namespace tomales
