// Many area lights, of which each point draws a few: the mean is the light of all of them.
#include "reyes/base/rng.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

constexpr int kPanels = 160;
constexpr float kSide = 0.3f, kPanelHeight = 2, kReach = 0.01f;
const vec3 kPlace(-1, 0.2f, 5);

/// Square panels in the plane z = 2 that shine towards +z.
class Panels : public ShadeServices {
 public:
  mutable int shadowRays = 0, misled = 0;

  static vec3 center(int light) {
    const auto random = [&](uint32_t k) { return 6 * unitFloat(hashCombine(static_cast<uint32_t>(light), k)) - 3; };
    return {random(1), random(2), kPanelHeight};
  }
  static void put(const EmitterPoints& out, int i, const vec3& from, const vec3& at) {
    const vec3 path = at - from;
    set(out.P, i, at);
    set(out.N, i, vec3(0, 0, 1));
    const float distance2 = dot(path, path), cosine = -path.z / std::sqrt(distance2);
    out.pdf[i] = out.meetPdf[i] = cosine > 0 ? distance2 / (cosine * kSide * kSide) : 0;
  }
  bool sampleEmitter(int light, int count, TmConstVec3 from, const float* a, const float* b,
                     const EmitterPoints& out) const override {
    for (int i = 0; i < count; ++i)
      put(out, i, get(from, i), center(light) + kSide * vec3(a[i] - 0.5f, b[i] - 0.5f, 0));
    return true;
  }
  void meetEmitter(int light, int count, TmConstVec3 from, TmConstVec3 direction,
                   const EmitterPoints& out) const override {
    for (int i = 0; i < count; ++i) {
      const vec3 P = get(from, i), d = get(direction, i), at = P + d * ((kPanelHeight - P.z) / d.z);
      const vec3 off = glm::abs(at - center(light));
      if (d.z < 0 && off.x < kSide / 2 && off.y < kSide / 2)
        put(out, i, P, at);
      else
        out.pdf[i] = out.meetPdf[i] = 0;
    }
  }
  float emitterReach(int) const override { return kReach; }
  float emitterArea(int) const override { return kSide * kSide; }
  Bound3 emitterBound(int light) const override {
    const vec3 half(kSide / 2, kSide / 2, 0);
    return {center(light) - half, center(light) + half};
  }
  /// The panels at x > 0 are hidden.
  void transmission(const ShadePoints& points, const uint8_t* active, TmConstVec3 toward, const ShadowRays&,
                    const ShadeContext&, TmVec3 light) const override {
    for (int i = 0; i < points.count(); ++i) {
      if (!active[i]) continue;
      const vec3 end = points.position(i) + get(toward, i);
      ++shadowRays;
      misled += std::abs(end.z - kPanelHeight - kReach) > 1e-4f;
      if (end.x > 0) set(light, i, vec3(0.0f));
    }
  }
  void trace(const ShadePoints&, const uint8_t*, TmConstVec3, TmConstVec3, const RayQuery&, const ShadeContext&,
             const RayResult&) const override {}
  void indirectDiffuse(const ShadePoints&, const uint8_t*, TmConstVec3, const IndirectQuery&, const ShadeContext&,
                       IndirectResult) const override {}
};

class ManyPanels : public Stage {
 protected:
  ManyPanels() {
    scene.options.user["trace:lightcut"] = number("lightcut", 8);
    hang(1);
  }
  /// Makes panels that have so many samples, in place of those before.
  void hang(float samples) {
    scene.lights.clear();
    for (int k = 0; k < kPanels; ++k)
      light("arealight",
            {number("samples", samples),
             number("intensity", 0.2f + unitFloat(hashCombine(static_cast<uint32_t>(k), 3u)))},
            true)
          .castsShadows = true;
  }
  /// The mean of points at one place. `all`: every panel shines at each of them.
  vec3 mean(bool all, int count) {
    scene.objects.clear();
    shading.reset();
    system().setServices(&panels);
    if (all) system().runAllLights();
    const ShadedPoints out = shade(points(std::vector<vec3>(static_cast<size_t>(count), kPlace)));
    vec3 sum(0);
    for (int i = 0; i < count; ++i) sum += out.color(i) / static_cast<float>(count);
    return sum;
  }
  /// E / pi under the panels that are not hidden.
  static double irradiance() {
    constexpr int kParts = 8;
    double sum = 0;
    for (int k = 0; k < kPanels; ++k)
      for (int part = 0; part < kParts * kParts; ++part) {
        const auto place = [](int p) { return (static_cast<float>(p) + 0.5f) / kParts - 0.5f; };
        const vec3 at = Panels::center(k) + kSide * vec3(place(part % kParts), place(part / kParts), 0),
                   path = at - kPlace;
        const double distance2 = dot(path, path), cosine = -path.z / std::sqrt(distance2),
                     radiance = 0.2 + double{unitFloat(hashCombine(static_cast<uint32_t>(k), 3u))};
        if (at.x < 0) sum += radiance * cosine * cosine / (distance2 * kPi) * (kSide * kSide / (kParts * kParts));
      }
    return sum;
  }
  Panels panels;
};

TEST_F(ManyPanels, BringTheirLightThoughEachPointDrawsAFew) {
  surface("matte", {number("Ka", 0), number("Kd", 1)});
  attributes.color = vec3(1);
  constexpr int kPoints = 2000;
  const float drawn = mean(false, kPoints).x;
  EXPECT_NEAR(drawn / irradiance(), 1, 0.02);
  EXPECT_LT(panels.shadowRays, 40 * kPoints);
  const int before = panels.shadowRays;
  EXPECT_NEAR(mean(true, 100).x / irradiance(), 1, 0.02);
  EXPECT_EQ(panels.shadowRays - before, 100 * kPanels);
  EXPECT_EQ(panels.misled, 0) << "shadow rays end before the geometry of the lamp";
}

TEST_F(ManyPanels, ThatAPointDrawsHaveTwoSamplesOnAverageAtMost) {
  surface("matte", {number("Ka", 0), number("Kd", 1)});
  for (const int samples : {1, 2, 16}) {
    hang(static_cast<float>(samples));
    panels.shadowRays = 0;
    EXPECT_NEAR(mean(false, 100).x / irradiance(), 1, 0.1) << samples << ": and they bring all of the light";
    EXPECT_LE(panels.shadowRays, 100 * 8 * std::min(samples, 2)) << samples;
    EXPECT_GT(panels.shadowRays, 100 * 8 * std::min(samples, 2) / 2) << samples;
  }
}

TEST_F(ManyPanels, ShineInHighlightsOfAnyWidthAsAllOfThemDo) {
  for (const float roughness : {0.02f, 0.3f}) {
    surface("metal", {number("Ka", 0), number("Ks", 1), number("roughness", roughness)});
    const float drawn = mean(false, 2000).x, all = mean(true, 400).x;
    EXPECT_GT(all, 0);
    EXPECT_NEAR(drawn / all, 1, 0.03) << roughness;
  }
  EXPECT_EQ(panels.misled, 0);
}

}  // namespace
}  // namespace tomales
