// When earlier records answer occlusion() and indirectdiffuse(), and when rays must: whole hemispheres at points that
// the eye sees, as exactly as the call or the scene says.
#include "tests/unit/shade/obedient.h"

namespace tomales {
namespace {

using namespace sl;

constexpr float kOfRecords = 0.75f;

class Hemispheres : public BatchServices {
 protected:
  Hemispheres() {
    services.interpolated = kOfRecords;
    services.met = [](const vec3&, const vec3&) { return 1.0f; };
    services.seen = [](const vec3&) { return vec3(1.0f); };
  }
  bool isOfRecords(const std::function<Float(sl::Surface&)>& call, const ShadeContext& context = {}) {
    const float answer = asked(
                             2, [&](sl::Surface& s) { s.Ci = Color(call(s), 0, 0); }, context)[0]
                             .x;
    EXPECT_TRUE(answer == kOfRecords || answer == 1) << answer;
    return answer == kOfRecords;
  }
};

TEST_F(Hemispheres, RecordsKnowTheOcclusionOfWholeOnesIfAnErrorIsAllowed) {
  const auto covered = [&](const auto&... list) {
    return isOfRecords([&](sl::Surface& s) { return occlusion(s.P, s.N, 4, list...); });
  };
  EXPECT_FALSE(covered()) << "nobody allows an error";
  EXPECT_FALSE(covered("maxvariation", 0));
  EXPECT_TRUE(covered("maxvariation", 0.1));
  EXPECT_TRUE(covered("maxvariation", 0.1, "coneangle", 1.57));
  EXPECT_FALSE(covered("maxvariation", 0.1, "coneangle", 1.56));
  EXPECT_FALSE(covered("maxvariation", 0.1, "samplebase", 0.5));
  EXPECT_FALSE(covered("maxvariation", 0.1, "distribution", "uniform"));
  EXPECT_TRUE(covered("maxvariation", 0.1, "distribution", "cosine"));
  EXPECT_TRUE(covered("maxvariation", 0.1, "label", "mine"));
}

TEST_F(Hemispheres, TheSceneMayAllowTheError) {
  attributes.irradianceMaxError = 0.2f;
  EXPECT_TRUE(isOfRecords([](sl::Surface& s) { return occlusion(s.P, s.N, 4); }));
  EXPECT_FALSE(isOfRecords([](sl::Surface& s) { return occlusion(s.P, s.N, 4, "maxvariation", 0); }));
}

TEST_F(Hemispheres, LightIsInterpolatedUnlessItIsForbidden) {
  const auto light = [&](const auto&... list) {
    return isOfRecords([&](sl::Surface& s) { return xcomp(indirectdiffuse(s.P, s.N, 4, list...)); });
  };
  EXPECT_TRUE(light());
  EXPECT_FALSE(light("maxvariation", 0));
  EXPECT_FALSE(light("label", "mine")) << "what is met may look at the label";
}

TEST_F(Hemispheres, OcclusionThatIsAskedForWithLightIsInterpolatedWithIt) {
  asked(2, [](sl::Surface& s) {
    Float covered;
    s.Ci = indirectdiffuse(s.P, s.N, 4, "occlusion", &covered);
    EXPECT_EQ(covered[0], kOfRecords);
    s.Ci = indirectdiffuse(s.P, s.N, 4, "occlusion", &covered, "maxvariation", 0);
    EXPECT_EQ(covered[0], 1);
  });
}

TEST_F(Hemispheres, RaysFindDirectionsAndEnvironments) {
  EXPECT_FALSE(isOfRecords([](sl::Surface& s) {
    Vector open;
    return occlusion(s.P, s.N, 4, "maxvariation", 0.1, "environmentdir", &open);
  }));
  EXPECT_FALSE(isOfRecords([](sl::Surface& s) {
    Color open;
    return occlusion(s.P, s.N, 4, "maxvariation", 0.1, "environmentcolor", &open);
  }));
}

TEST_F(Hemispheres, OfHitsAreTraced) {
  for (const RayKind kind : {RayKind::Diffuse, RayKind::Specular})
    EXPECT_FALSE(
        isOfRecords([](sl::Surface& s) { return occlusion(s.P, s.N, 4, "maxvariation", 0.1); }, {.kind = kind}));
}

}  // namespace
}  // namespace tomales
