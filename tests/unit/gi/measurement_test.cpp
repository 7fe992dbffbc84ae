// Photons that are counted at points, against closed forms. tests/cli/counted_photons_test.py does the same with whole
// frames.
#include "gi/photons/measurement.h"

#include <gtest/gtest.h>

#include "gi/photons/sources.h"
#include "reyes/base/parallel.h"
#include "tests/unit/gi/fixture.h"

namespace tomales {
namespace {

using namespace test;

constexpr int kAll = 64;
constexpr float kRadius = 2, kAlbedo = 0.5f, kIntensity = 3;
constexpr double kDirect = double{kIntensity} / (double{kRadius} * double{kRadius});  ///< E/pi.

/// A lamp in the middle of a sphere. It gives kDirect everywhere, and all bounces together 1 / (1 - albedo) times that.
Scene closedSphere() {
  SceneBuilder b;
  b.light("pointlight", {floatParam("intensity", kIntensity), pointParam("from", {0, 0, 0.5f})});
  b.light("indirectlight", {});
  b.sphere(kRadius, vec3(kAlbedo), {0, 0, 0.5f});
  auto fine = std::make_shared<Attributes>(*b.scene.objects[0].attributes);
  fine->trace.tessellation = 4;
  b.scene.objects[0].attributes = fine;
  return b.scene;
}

std::vector<MeasurementPoint> pointsOnSphere(int bounces) {
  std::vector<MeasurementPoint> out;
  for (int i = 0; i < 200; ++i) {
    const float z = (static_cast<float>(i) + 0.5f) / 100 - 1, phi = 2.4f * static_cast<float>(i),
                r = std::sqrt(1 - z * z);
    const vec3 d(r * std::cos(phi), r * std::sin(phi), z);
    out.push_back({vec3(0, 0, 0.5f) + kRadius * d, -d, 0.1f * (1 + static_cast<float>(i % 3)), 0.02f, bounces});
  }
  return out;
}

/// Counts one pass for each scale. `stops`: goes on in another measurement after the first pass.
PhotonMeasurement measured(World& world, std::vector<MeasurementPoint> points, const PhotonSettings& settings,
                           const std::vector<float>& scales, bool stops = false) {
  const auto services = world.use({.mode = GiMode::None});
  const PhotonSources sources(world.rays, world.shading, settings, world.log);
  PhotonMeasurement out(points, sources.power());
  uint32_t seed = 1;
  for (const float scale : scales) {
    out.beginPass(scale, 1 / static_cast<double>(scales.size()));
    sources.pass(seed++, settings.emit, [&](std::span<const StoredPhoton> photons) { out.count(photons); });
    out.endPass();
    if (!std::exchange(stops, false)) continue;
    const PhotonSums sums = out.sums();
    out = PhotonMeasurement(points, sources.power());
    EXPECT_TRUE(out.resume(sums));
  }
  return out;
}

double meanOf(const PhotonMeasurement& m) {
  double sum = 0;
  for (size_t i = 0; i < m.size(); ++i) sum += double{m.overPi(i).y} / static_cast<double>(m.size());
  return sum;
}

TEST(PhotonMeasurement, FindsTheIrradianceOfAClosedSphereWithAsManyBouncesAsAPointCounts) {
  World world(closedSphere());
  double expected = 0;
  for (int bounces = 0; bounces < 3; ++bounces) {
    expected += kDirect * std::pow(double{kAlbedo}, bounces);
    EXPECT_NEAR(meanOf(measured(world, pointsOnSphere(bounces), {200000}, {1})), expected, 0.01 * expected) << bounces;
  }
}

TEST(PhotonMeasurement, IsTheMeanOfPassesOfAnyRadius) {
  World world(closedSphere());
  EXPECT_NEAR(meanOf(measured(world, pointsOnSphere(0), {50000}, {1.5f, 1, 0.7f, 0.5f})), kDirect, 0.01 * kDirect);
}

TEST(PhotonMeasurement, HasTheSameBitsForAnyNumberOfThreadsAndOrderOfPoints) {
  World world(closedSphere());
  const auto sums = [&](int threads, bool reversed) {
    const ThreadLimit limit(threads);
    std::vector<MeasurementPoint> points = pointsOnSphere(kAll);
    if (reversed) std::reverse(points.begin(), points.end());
    const PhotonMeasurement m = measured(world, points, {20000}, {1, 0.8f, 0.7f});
    std::vector<vec3> out;
    for (size_t i = 0; i < m.size(); ++i) out.push_back(m.overPi(reversed ? m.size() - 1 - i : i));
    return out;
  };
  const std::vector<vec3> one = sums(1, false);
  EXPECT_EQ(one, sums(3, false));
  EXPECT_EQ(one, sums(2, true));
}

TEST(PhotonMeasurement, WeighsItsPasses) {
  World world(closedSphere());
  const auto services = world.use({.mode = GiMode::None});
  const PhotonSources sources(world.rays, world.shading, {20000}, world.log);
  PhotonMeasurement m(pointsOnSphere(0), sources.power());
  for (const double weight : {0.2, 0.4, 0.1}) {
    m.beginPass(1, weight);
    if (weight == 0.4) sources.pass(1, 20000, [&](std::span<const StoredPhoton> photons) { m.count(photons); });
    m.endPass();
  }
  EXPECT_NEAR(meanOf(m), 4 * kDirect / 7, 0.01 * kDirect) << "two of three passes are dark";
}

TEST(PhotonMeasurement, GoesOnWithTheSameBitsWhereAnotherStopped) {
  World world(closedSphere());
  const std::vector<MeasurementPoint> points = pointsOnSphere(kAll);
  const PhotonMeasurement whole = measured(world, points, {20000}, {1, 0.8f, 0.7f}),
                          resumed = measured(world, points, {20000}, {1, 0.8f, 0.7f}, true);
  for (size_t i = 0; i < points.size(); ++i) EXPECT_EQ(whole.overPi(i), resumed.overPi(i));
  EXPECT_EQ(whole.noise(), resumed.noise());
  PhotonMeasurement other(pointsOnSphere(kAll), 1);
  PhotonSums sums = whole.sums();
  sums.power.pop_back();
  EXPECT_FALSE(other.resume(sums)) << "sums of other points";
}

TEST(PhotonMeasurement, ItsNoiseIsTheErrorThatItHas) {
  World world(closedSphere());
  const PhotonMeasurement m = measured(world, pointsOnSphere(0), {3000}, {1, 1, 1, 1, 1, 1, 1, 1});
  double error = 0;
  for (size_t i = 0; i < m.size(); ++i)
    error += std::abs(double{m.overPi(i).y} / kDirect - 1) / static_cast<double>(m.size());
  EXPECT_NEAR(m.noise() / error, 1, 0.3);
  EXPECT_LT(measured(world, pointsOnSphere(0), {3000}, {1}).noise(), 0) << "one pass cannot tell";
}

}  // namespace
}  // namespace tomales
