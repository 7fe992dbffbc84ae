// What the interface to rays answers where an implementation knows nothing.
#include <gtest/gtest.h>

#include "tests/unit/shade/bare_services.h"

namespace tomales {
namespace {

TEST(ShadeServices, AreDarkAtActivePointsAndLeaveOthersAlone) {
  const test::BareServices bare;
  ShadePoints points(0, 0);
  for (uint32_t i = 0; i < 3; ++i) points.add(i);
  const uint8_t active[] = {1, 0, 1};
  float x[3], y[3], z[3];
  const TmVec3 out{x, y, z};
  const auto expectDark = [&](const auto& ask) {
    for (float* c : {x, y, z}) std::fill_n(c, 3, 7.0f);
    ask();
    for (const float* c : {x, y, z})
      for (int i = 0; i < 3; ++i) EXPECT_EQ(c[i], active[i] ? 0 : 7);
  };
  expectDark([&] { bare.storedIrradiance(points, active, out); });
  expectDark([&] { bare.indirectAlong(points, active, {}, {}, {}, out); });
  x[0] = 7;
  EXPECT_FALSE(bare.interpolatedHemisphere(points, active, {}, {}, {}, out));
  EXPECT_EQ(x[0], 7);
  ShadedPoints shaded;
  EXPECT_FALSE(bare.volumesBefore(points, {}, shaded));
  EXPECT_FALSE(bare.followsLobes({}));
  EXPECT_TRUE(bare.tracesFrom(points, {}, {}));
  EXPECT_TRUE(bare.emitterBound(0).empty());
  EXPECT_FALSE(bare.sampleWholeEmitter(0, 3, {}, x, y, {}));
  bare.meetWholeEmitter(0, 0, 3, {}, {}, {out, out, z, z});
  for (const float pdf : z) EXPECT_EQ(pdf, 0);
}

}  // namespace
}  // namespace tomales
