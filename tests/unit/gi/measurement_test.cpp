// Photons that are counted at points, against closed forms: alone, as caustics of the reference, and progressively.
#include "gi/photons/measurement.h"

#include <gtest/gtest.h>

#include "gi/photons/stream.h"
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

void setPhotonModel(SceneBuilder& b, size_t object, const std::string& model, const std::string& surface = "matte") {
  auto changed = std::make_shared<Attributes>(*b.scene.objects[object].attributes);
  changed->photon.shadingModel = model, changed->surface = std::make_shared<ShaderCall>(call(surface));
  b.scene.objects[object].attributes = changed;
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

PhotonMeasurement measured(World& world, std::vector<MeasurementPoint> points, const PhotonSettings& settings,
                           const std::vector<float>& scales) {
  const auto services = world.use({.mode = GiMode::None});
  const PhotonStream stream(world.rays, world.shading, settings, world.log);
  PhotonMeasurement out(std::move(points), stream.power());
  uint32_t seed = 1;
  for (const float scale : scales) {
    out.beginPass(scale);
    stream.pass(seed++, [&](std::span<const StoredPhoton> photons) { out.count(photons); });
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

TEST(PhotonMeasurement, ItsNoiseIsTheErrorThatItHas) {
  World world(closedSphere());
  const PhotonMeasurement m = measured(world, pointsOnSphere(0), {3000}, {1, 1, 1, 1, 1, 1, 1, 1});
  double error = 0;
  for (size_t i = 0; i < m.size(); ++i)
    error += std::abs(double{m.overPi(i).y} / kDirect - 1) / static_cast<double>(m.size());
  EXPECT_NEAR(m.noise() / error, 1, 0.3);
  EXPECT_LT(measured(world, pointsOnSphere(0), {3000}, {1}).noise(), 0) << "one pass cannot tell";
}

/// A floor at z = 0 that faces +z and reflects nothing; the eye is not asked.
void addFloor(SceneBuilder& b, float half) {
  b.quad({-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}, vec3(0));
}

double unpolarised(double cosine, double index) {
  const double inside = std::sqrt(1 - (1 - cosine * cosine) / (index * index));
  const double rs = (cosine - index * inside) / (cosine + index * inside),
               rp = (inside - index * cosine) / (inside + index * cosine);
  return (rs * rs + rp * rp) / 2;
}

TEST(PhotonMeasurement, APaneOfGlassLetsThroughWhatFresnelSays) {
  const double cosine = 0.5, sine = std::sqrt(0.75);
  SceneBuilder b;
  b.light("distantlight", {floatParam("intensity", 2), pointParam("from", {0, 0, 0}),
                           pointParam("to", {static_cast<float>(sine), 0, static_cast<float>(-cosine)})});
  addFloor(b, 2);
  const float h = 9;  // what its edges let in falls beside the floor
  b.quad({-h, -h, 1.2f}, {-h, h, 1.2f}, {h, h, 1.2f}, {h, -h, 1.2f}, vec3(1));
  b.quad({-h, -h, 1}, {h, -h, 1}, {h, h, 1}, {-h, h, 1}, vec3(1));
  for (const size_t side : {1, 2}) setPhotonModel(b, side, "glass");
  World world(b.scene);
  const double R = unpolarised(cosine, 1.5), expected = 2 * cosine * (1 - R) / (1 + R);
  const MeasurementPoint middle{{0, 0, 0}, {0, 0, 1}, 1.5f, 0.01f, kAll};
  PhotonSettings settings{1000000, 0, 0, false};
  settings.focusedOnly = true;
  EXPECT_NEAR(double{measured(world, {middle}, settings, {1}).overPi(0).y}, expected, 0.005 * expected);
}

/// Indirect light at (0, 0, 0) above the floor of `b`, with all of the sky at radiance 1.
double underASky(SceneBuilder& b, GiMode mode, bool causticsAlone, int64_t photons) {
  World world(b.scene);
  const auto services = world.use({mode, 4096, 1});
  PhotonPasses passes;
  passes.photons = photons;
  passes.focusedOnly = causticsAlone, passes.shrinks = !causticsAlone;
  passes.log = &world.log;
  passes.tell = [](auto...) {};
  services->setPhotonPasses(passes);
  DeepFrame frame;
  frame.bucketWidth = frame.bucketHeight = 1, frame.columns = frame.rows = 1;
  DeepTile& tile = frame.tiles.emplace_back();
  ShadePoints& points = tile.batches.emplace_back(world.scene.objects[0].group, 0);
  points.add(7U);
  points.set3(kIx, 0, {0, 0, -1}), points.set3(kNx, 0, {0, 0, 1}), points.set3(kNgx, 0, {0, 0, 1});
  points.channel(kArea)[0] = 0.06f, points.channel(kTime)[0] = -1;
  gatherFrame(*services, frame);
  return double{indirectAt(*services, points, *world.shading.indirectQuery(points.group()))[0].y};
}

SceneBuilder mirrorUnderSky(const char* model) {
  SceneBuilder b;
  b.light("environmentlight", {floatParam("intensity", 1)});
  b.light("indirectlight", {});
  addFloor(b, 0.5f);
  b.sphere(1, vec3(1), {0, 0, 1.5f});
  setPhotonModel(b, 1, model, "mirror");
  return b;
}

// A mirror of radius R at the distance d covers (R / d)^2 of the hemisphere, and shows the sky there.
TEST(Caustics, OfTheReferenceAreThoseOfASkyInAMirrorNotCountedTwice) {
  SceneBuilder paths = mirrorUnderSky("matte"), photons = mirrorUnderSky("chrome");
  const double expected = 1 / (1.5 * 1.5);
  EXPECT_NEAR(underASky(paths, GiMode::Reference, true, 1 << 10), expected, 0.02 * expected) << "paths find it";
  EXPECT_NEAR(underASky(photons, GiMode::Reference, true, 1 << 21), expected, 0.04 * expected);
}

TEST(ProgressivePhotons, OfASkyInAMirrorBringTheSame) {
  SceneBuilder b = mirrorUnderSky("chrome");
  const double expected = 1 / (1.5 * 1.5);
  // Disks of the first passes are wider than what the mirror lights evenly.
  EXPECT_NEAR(underASky(b, GiMode::Progressive, false, 1 << 20), expected, 0.15 * expected);
}

}  // namespace
}  // namespace tomales
