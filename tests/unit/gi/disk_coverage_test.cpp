// How much of a measured point's disk lies on surfaces, against areas that are known.
#include "gi/photons/disk_coverage.h"

#include <gtest/gtest.h>

#include "gi/photons/sources.h"
#include "tests/unit/gi/fixture.h"

namespace tomales {
namespace {

using namespace test;

constexpr float kDisk = 0.2f, kWall = 4;
/// Rays lie on a spiral, and one in 32 is 3 % of the area.
constexpr double kTolerance = 0.04;

/// A wall that faces the eye, from -1 to 1.
SceneBuilder wall() {
  SceneBuilder b;
  b.light("pointlight", {floatParam("intensity", 3), pointParam("from", {0, 0, kWall - 1.5f})});
  b.quad({-1, -1, kWall}, {1, -1, kWall}, {1, 1, kWall}, {-1, 1, kWall}, vec3(0.5f));
  return b;
}

MeasurementPoint on(float x, float y, float side = -1) { return {{x, y, kWall}, {0, 0, side}, kDisk, 0.001f, 64}; }

/// Returns the part of a circle that lies before a line at `distance` radii from its centre.
double beforeLine(double distance) {
  return 1 - (std::acos(distance) - distance * std::sqrt(1 - distance * distance)) / double{kPi};
}

TEST(DiskCoverage, IsWholeInTheMiddleOfAWallOnBothSides) {
  const World world(wall().scene);
  for (const float side : {-1.0f, 1.0f}) {
    EXPECT_TRUE(isCovered(world.rays, on(0.3f, -0.5f, side), 1));
    EXPECT_EQ(coverage(world.rays, on(0.3f, -0.5f, side), 1), 1);
  }
}

TEST(DiskCoverage, IsThePartBeforeAnEdge) {
  const World world(wall().scene);
  for (const float distance : {0.0f, 0.3f, 0.6f}) {
    const MeasurementPoint point = on(1 - distance * kDisk, 0.1f);
    EXPECT_FALSE(isCovered(world.rays, point, 1));
    EXPECT_NEAR(coverage(world.rays, point, 1), beforeLine(double{distance}), kTolerance) << distance;
    EXPECT_NEAR(coverage(world.rays, point, 3), beforeLine(double{distance} / 3), kTolerance) << distance;
  }
  EXPECT_NEAR(coverage(world.rays, on(1, 1), 1), 0.25, kTolerance) << "at a corner";
  EXPECT_GT(coverage(world.rays, on(1.5f, 0), 1), 0) << "beyond the wall";
}

TEST(DiskCoverage, LeavesOutWhatIsTurnedAway) {
  SceneBuilder b;
  b.sphere(kDisk, vec3(0.5f), {0, 0, kWall + kDisk});
  auto fine = std::make_shared<Attributes>(*b.scene.objects[0].attributes);
  fine->trace.tessellation = 16;
  b.scene.objects[0].attributes = fine;
  const World world(b.scene);
  EXPECT_NEAR(coverage(world.rays, on(0, 0), 1), 0.5, kTolerance) << "a ball is turned by 45 degrees at half its area";
}

TEST(DiskCoverage, IsNotHiddenByWhatCutsTheDisk) {
  SceneBuilder b = wall();
  b.quad({-0.1f, -1, kWall - 0.18f}, {0, -1, kWall - 0.001f}, {0, 1, kWall - 0.001f}, {-0.1f, 1, kWall - 0.18f},
         vec3(0.5f));
  const World world(b.scene);
  EXPECT_EQ(coverage(world.rays, on(0, 0), 1), 1);
}

/// Returns the mean E/pi of the lamp on the part of a disk that lies on the wall.
double meanOnWall(const vec3& P, float radius) {
  double sum = 0;
  int places = 0;
  for (int i = -50; i <= 50; ++i)
    for (int j = -50; j <= 50; ++j) {
      const float x = P.x + radius * static_cast<float>(i) / 50, y = P.y + radius * static_cast<float>(j) / 50;
      if (i * i + j * j > 2500 || std::abs(x) > 1 || std::abs(y) > 1) continue;
      const double toLight = std::sqrt(double{x} * double{x} + double{y} * double{y} + 2.25);
      sum += 3 * 1.5 / (toLight * toLight * toLight);
      ++places;
    }
  return sum / places;
}

TEST(DiskCoverage, MakesTheIrradianceAtAnEdgeThatOfTheWallBesideIt) {
  World world(wall().scene);
  const auto services = world.use({.mode = GiMode::None});
  const PhotonSources sources(world.rays, world.shading, {400000}, world.log);
  const std::vector<MeasurementPoint> points = {on(0, 0), on(0.98f, 0), on(-0.99f, 0.99f), on(0, -1)};
  for (const bool knowsEdges : {true, false}) {
    PhotonMeasurement m(points, sources.power(), knowsEdges ? &world.rays : nullptr, 1);
    m.beginPass(1, 1);
    sources.pass(1, 400000, [&](std::span<const StoredPhoton> photons) { m.count(photons); });
    m.endPass();
    for (size_t i = 0; i < points.size(); ++i) {
      const double expected = meanOnWall(points[i].P, kDisk), got = double{m.overPi(i).y};
      if (knowsEdges || i == 0)
        EXPECT_NEAR(got, expected, (i == 2 ? 0.15 : 0.06) * expected) << i;  // a corner is a quarter of the rays
      else
        EXPECT_LT(got, 0.7 * expected) << i;
    }
  }
}

}  // namespace
}  // namespace tomales
