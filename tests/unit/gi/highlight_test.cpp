// Highlights of lamps with an extent: light samples and lobe samples together must tell the same as either would.
#include <gtest/gtest.h>

#include "fixture.h"
#include "reyes/base/rng.h"

namespace tomales::test {
namespace {

/// A glossy table at z = 5 that faces the eye, under a lamp of half-width `size` at z = 3.
struct Table {
  Table(float size, float roughness, int samples, bool disk = false) {
    SceneBuilder b(32);
    auto lamp = std::make_shared<LightCall>();
    lamp->shader = call("arealight", {floatParam("samples", static_cast<float>(samples))});
    lamp->area = true;
    lamp->index = 0;
    b.scene.lights.push_back(lamp);
    b.lights.switchOn(0);
    b.quad({-4, -4, 5}, {4, -4, 5}, {4, 4, 5}, {-4, 4, 5}, vec3(1));
    attributes(b, 0).surface = std::make_shared<ShaderCall>(call("metal", {floatParam("roughness", roughness)}));
    if (disk) {
      Problems problems;
      b.add(makeDisk(0, size, 360, {}, problems), vec3(1), {0.5f, 0, 3});
    } else {
      const float x = 0.5f;
      b.quad({x - size, -size, 3}, {x + size, -size, 3}, {x + size, size, 3}, {x - size, size, 3}, vec3(1));
    }
    attributes(b, 1).areaLight = 0;
    attributes(b, 1).lights.clear();
    world = std::make_unique<World>(std::move(b.scene));
    services = world->use({GiMode::None});
  }
  static Attributes& attributes(SceneBuilder& b, size_t object) {
    return const_cast<Attributes&>(*b.scene.objects[object].attributes);
  }

  /// Colours of many points with the same geometry: only their random numbers differ.
  std::vector<float> highlights(const vec3& P, int count) const {
    ShadePoints points(world->scene.objects[0].group, 0);
    for (int k = 0; k < count; ++k) {
      const int i = points.add(hash32(static_cast<uint32_t>(k)));
      points.set3(kPx, i, P);
      points.set3(kIx, i, P);
      points.set3(kNx, i, {0, 0, -1});
      points.set3(kNgx, i, {0, 0, -1});
    }
    ShadedPoints out;
    world->shading.shade(points, {}, out);
    std::vector<float> values;
    for (int i = 0; i < count; ++i) values.push_back(out.color(i).x);
    return values;
  }

  std::unique_ptr<World> world;
  std::unique_ptr<GiServices> services;
};

struct Moments {
  double mean = 0, deviation = 0;
};
Moments momentsOf(const std::vector<float>& values) {
  Moments m;
  const auto n = static_cast<double>(values.size());
  for (const float v : values) m.mean += double{v} / n;
  for (const float v : values) m.deviation += (double{v} - m.mean) * (double{v} - m.mean) / n;
  m.deviation = std::sqrt(m.deviation);
  return m;
}

/// The integral of (N.H)^e over the lamp, over pi, by a fine grid of its area.
double exact(float size, float roughness, const vec3& P, bool disk) {
  constexpr int kGrid = 800;
  double sum = 0;
  for (int j = 0; j < kGrid; ++j)
    for (int i = 0; i < kGrid; ++i) {
      const vec2 at =
          (2.0f * vec2(static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f) / static_cast<float>(kGrid) - 1.0f) *
          size;
      if (disk && dot(at, at) > size * size) continue;
      const vec3 path = vec3(0.5f + at.x, at.y, 3) - P, L = glm::normalize(path);
      const vec3 H = glm::normalize(L - glm::normalize(P));
      const double cosine = std::abs(double{L.z}), cell = 4.0 * double{size} * double{size} / (kGrid * kGrid);
      sum += std::pow(std::max(0.0, -double{H.z}), 8 / double{roughness}) * cosine * cell /
             (double{dot(path, path)} * double{kPi});
    }
  return sum;
}

TEST(Highlights, AreThoseOfTheIntegralForSmallAndLargeLampsAndLobes) {
  for (const bool disk : {false, true})
    for (const float size : {0.05f, 0.4f, 2.0f})
      for (const float roughness : {0.3f, 0.01f}) {
        const vec3 P(0.3f, 0.1f, 5);
        const Moments m = momentsOf(Table(size, roughness, 16, disk).highlights(P, 1500));
        const double truth = exact(size, roughness, P, disk);
        EXPECT_NEAR(m.mean / truth, 1, std::max(0.004, 4 * m.deviation / truth / std::sqrt(1500.0)))
            << "lamp " << size << " roughness " << roughness << " disk " << disk;
      }
}

TEST(Highlights, OfALargeLampInANarrowLobeAreNearlyFreeOfNoise) {
  const Moments m = momentsOf(Table(2, 0.005f, 4).highlights({0.3f, 0.1f, 5}, 400));
  EXPECT_LT(m.deviation / m.mean, 0.15);  // 2.4 with samples of the lamp alone
}

}  // namespace
}  // namespace tomales::test
