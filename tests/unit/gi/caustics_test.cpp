// Light of photons that lie beside darkness.
#include "gi/photons/caustics.h"

#include <gtest/gtest.h>

namespace tomales {
namespace {

constexpr int kPhotons = 60;  ///< Along each edge of a square.

/// A bright square of edge 1 around the origin of the plane z = 0, which gets 1 W, evenly; all is dark beside it.
PointCloud brightSquare() {
  PointCloud out;
  out.channels = {{kIndirectPower, 3}};
  const float share = 1.0f / (kPhotons * kPhotons);
  for (int i = 0; i < kPhotons * kPhotons; ++i) {
    const vec2 at = (vec2(i % kPhotons, i / kPhotons) + 0.5f) / float{kPhotons} - 0.5f;
    const vec3 power(share, 2 * share, 0);
    out.add(vec3(at, 0), {0, 0, 1}, 0, &power.x);
  }
  return out;
}

const PhotonIrradianceSettings kSettings{50, 1};

TEST(CausticPhotons, BringAsMuchLightAsTheyHave) {
  const CausticPhotons caustic(brightSquare(), kSettings);
  constexpr int kPlaces = 240;
  constexpr float kWidth = 1.6f;
  vec3 sum(0);
  for (int i = 0; i < kPlaces * kPlaces; ++i) {
    const vec2 at = kWidth * ((vec2(i % kPlaces, i / kPlaces) + 0.5f) / float{kPlaces} - 0.5f);
    sum += caustic.irradiance(vec3(at, 0), {0, 0, 1}, 0) * (kWidth * kWidth / (kPlaces * kPlaces));
  }
  EXPECT_NEAR(sum.x, 1, 0.01f);
  EXPECT_NEAR(sum.y, 2, 0.02f);
  EXPECT_EQ(sum.z, 0);
}

TEST(CausticPhotons, AreEvenInsideAndLeaveTheDarkDark) {
  const CausticPhotons caustic(brightSquare(), kSettings);
  EXPECT_NEAR(caustic.irradiance({0.1f, 0.05f, 0}, {0, 0, 1}, 0).x, 1, 0.05f);
  // The nearest 50 photons of one on the edge fill half a disk.
  const float widest = std::sqrt(2 * 51 / (kPi * kPhotons * kPhotons)) * 1.1f;
  EXPECT_EQ(caustic.irradiance({0.5f + widest, 0, 0}, {0, 0, 1}, 0), vec3(0));
  EXPECT_GT(caustic.irradiance({0.5f + 0.5f * widest, 0, 0}, {0, 0, 1}, 0).x, 0.01f);
}

TEST(CausticPhotons, ShineOnTheirSideOfTheirSurfaceAlone) {
  const CausticPhotons caustic(brightSquare(), kSettings);
  EXPECT_EQ(caustic.irradiance({0, 0, 0}, {0, 0, -1}, 0), vec3(0));
  EXPECT_EQ(caustic.irradiance({0, 0, 0.1f}, {0, 0, 1}, 0), vec3(0));
}

TEST(CausticPhotons, AreDarkWhereThereAreNone) {
  PointCloud none;
  none.channels = {{kIndirectPower, 3}};
  EXPECT_EQ(CausticPhotons(none, kSettings).irradiance({0, 0, 0}, {0, 0, 1}, 0), vec3(0));
}

}  // namespace
}  // namespace tomales
