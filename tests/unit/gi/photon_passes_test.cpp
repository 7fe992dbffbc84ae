// The passes in which photons are sent that are counted.
#include "gi/photons/passes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tomales {
namespace {

/// Returns the mean area of the disks over that of the micropolygon, photons weighted alike.
double meanArea(int64_t photons) {
  double sum = 0;
  for (const PhotonPass& p : photonPasses(photons, true))
    sum += static_cast<double>(p.photons) * double{p.scale} * double{p.scale};
  return sum / static_cast<double>(photons);
}

TEST(PhotonPasses, SendAsManyPhotonsAsAskedForInHalvesOfARound) {
  for (const int64_t photons : {1, 7, 1000, 8192, 8193, 150'000, 1'000'000, 30'000'001}) {
    int64_t sent = 0, even = 0;
    const std::vector<PhotonPass> passes = photonPasses(photons, true);
    for (size_t i = 0; i < passes.size(); ++i) {
      EXPECT_GT(passes[i].photons, 0);
      sent += passes[i].photons;
      if (i % 2 == 0) even += passes[i].photons;
      if (!passes[i].endsRound) continue;
      EXPECT_NEAR(static_cast<double>(2 * even - sent), 0, static_cast<double>(passes.size())) << photons;
    }
    EXPECT_EQ(sent, photons);
    EXPECT_TRUE(passes.back().endsRound);
  }
}

TEST(PhotonPasses, DoublePhotonsFromRoundToRound) {
  int64_t sent = 0, before = 0;
  for (const PhotonPass& p : photonPasses(1 << 24, true)) {
    sent += p.photons;
    if (!p.endsRound) continue;
    EXPECT_EQ(sent, before == 0 ? 1 << 13 : 2 * before);
    before = sent;
  }
}

TEST(PhotonPasses, LetTheMeanAreaOfDisksFallWithTheCubeRootOfThePhotons) {
  for (int64_t photons = 1 << 14; photons < 1'000'000'000; photons *= 8)
    EXPECT_NEAR(meanArea(photons) / meanArea(8 * photons), 2, 1e-4) << photons;
  EXPECT_NEAR(meanArea(1 << 28), 1.5, 1e-4) << "the mean of n^(-1/3) up to where it is 1";
}

TEST(PhotonPasses, ThatDoNotShrinkHaveTheScale1) {
  for (const PhotonPass& p : photonPasses(1'000'000, false)) EXPECT_EQ(p.scale, 1);
}

}  // namespace
}  // namespace tomales
