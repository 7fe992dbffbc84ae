// Indirect light that comes by paths along the lobes of specular().
#include "tests/unit/shade/bare_services.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

/// Lets paths along lobes bring a radiance of 1 from everywhere.
class EvenPaths : public test::BareServices {
 public:
  mutable int paths = 0;
  bool followsLobes(const ShadeContext&) const override { return true; }
  void indirectAlong(const ShadePoints& points, const uint8_t* active, const LobeDirection& way, const IndirectQuery&,
                     const ShadeContext&, TmVec3 out) const override {
    EXPECT_LT(way.number, way.count);
    for (int i = 0; i < points.count(); ++i) {
      if (!active[i]) continue;
      ++paths;
      EXPECT_LT(way.L.z[i], 0) << "on the side of the surface";
      set(out, i, vec3(1.0f));
    }
  }
  void indirectDiffuse(const ShadePoints& points, const uint8_t* active, TmConstVec3, const IndirectQuery&,
                       const ShadeContext&, IndirectResult out) const override {
    for (int i = 0; i < points.count(); ++i)
      if (active[i]) set(out.E, i, vec3(0.0f));
  }
};

class LobePaths : public Stage {
 protected:
  LobePaths() { surface("metal", {number("Ka", 0), number("Ks", 1), number("roughness", kRoughness)}); }
  /// The mean of `count` points that face the eye.
  vec3 mean(int count, const ShadeContext& context = {}) {
    system().setServices(&paths);
    const ShadedPoints out = shade(points(std::vector<vec3>(static_cast<size_t>(count), vec3(0, 0, 5))), context);
    vec3 sum(0);
    for (int i = 0; i < count; ++i) sum += out.color(i) / static_cast<float>(count);
    return sum;
  }
  static constexpr float kRoughness = 0.4f;
  /// 1 / pi times the integral of the lobe, (N.H)^e, around the normal.
  static float reflectance() {
    const float e = 8 / kRoughness;
    return 8 / (e + 2) * (1 - std::exp2(-0.5f * (e + 2)));
  }
  EvenPaths paths;
};

TEST_F(LobePaths, BringEvenLightInProportionToTheLobeTheLightAndTheGain) {
  attributes.indirect.gain = 2;
  light("indirectlight", {number("intensity", 3), color("lightcolor", {1, 2, 4})});
  ShadeContext many;
  many.lightSamples = 64;
  expectColor(mean(200, many) / (6 * reflectance()), {1, 2, 4}, 0.02f);
  EXPECT_LE(paths.paths, 200 * 64);
  EXPECT_GT(paths.paths, 190 * 64) << "few are drawn below the surface";
}

TEST_F(LobePaths, AreOneForEachPointUnlessThePictureAsksForMore) {
  light("indirectlight");
  EXPECT_NEAR(mean(4000).x, reflectance(), 0.02f * reflectance());
  EXPECT_LE(paths.paths, 4000);
  paths.paths = 0;
  ShadeContext branched;
  branched.lightSamples = 64;
  branched.branches = 16;
  EXPECT_NEAR(mean(1000, branched).x, reflectance(), 0.02f * reflectance());
  EXPECT_LE(paths.paths, 4 * 1000) << "a share of those of the first point";
}

TEST_F(LobePaths, AreAsManyAsTheOtherPathsOfAnAudit) {
  light("indirectlight");
  ShadeContext audit;
  audit.auditPaths = 32;
  audit.lobes = LobeAudit::Paths;
  EXPECT_NEAR(mean(200, audit).x, reflectance(), 0.02f * reflectance());
  EXPECT_LE(paths.paths, 200 * 32);
  EXPECT_GT(paths.paths, 190 * 32);
}

TEST_F(LobePaths, WhereTheyBranchAgainFewGoOnAndTheMeanStays) {
  light("indirectlight");
  ShadeContext gathered;
  gathered.kind = RayKind::Diffuse;
  gathered.diffuseDepth = 1;
  gathered.highlights = HitHighlights::All;
  EXPECT_NEAR(mean(20000, gathered).x, reflectance(), 0.06f * reflectance());
  EXPECT_LE(paths.paths, 0.26f * 20000);
  EXPECT_GT(paths.paths, 0.05f * 20000);
}

TEST_F(LobePaths, AreLeftOutWhereIndirectLightOrItsHighlightsAre) {
  light("indirectlight", {number("__nonspecular", 1)});
  expectColor(mean(8), vec3(0), 0);
  scene.lights.clear();
  scene.objects.clear();
  attributes.lights.clear();
  shading.reset();
  light("indirectlight");
  ShadeContext direct;
  direct.indirect = false;
  expectColor(mean(8, direct), vec3(0), 0);
  scene.objects.clear();
  shading.reset();
  attributes.indirect.receive = false;
  expectColor(mean(8), vec3(0), 0);
  EXPECT_EQ(paths.paths, 0);
}

}  // namespace
}  // namespace tomales
