#include <gtest/gtest.h>

#include "kernel_run.h"
#include "reyes/shader/noise.h"

namespace tomales::compiler {
namespace {

using rsl::Vec3;

struct Slopes : testing::Test {
  Values p{3, 4, true}, d{3, 4, true}, out{3, 4, true};
  int points = 4 * kBlock;
  Slopes() {
    Numbers numbers(9);
    // Places and steps that sums hold exactly, out where the components of triple noise are taken too.
    for (float& x : p.data) x = std::round(numbers.within(-20, 20) * 512) / 512;
    for (float& x : d.data) x = std::round(numbers.within(-8, 8)) / 8;
  }
  void run(Op op) {
    const Lanes from[] = {p.lanes(), d.lanes()};
    kernelOf(op)(4, out.lanes(), from);
  }
  Vec3 at(Values& v, int i) { return {v.at(0, i), v.at(1, i), v.at(2, i)}; }
};
constexpr float kStep = 0x1p-8f;  // the error is its square, times a third derivative; and rounding over the step

TEST_F(Slopes, OfNoiseAreItsCentredDifferences) {
  run(Op::Slope3F);
  for (int i = 0; i < points; ++i) {
    const Vec3 q = at(p, i), step = kStep * at(d, i);
    EXPECT_NEAR(out.at(0, i), (rsl::noise(q + step) - rsl::noise(q - step)) / (2 * kStep), 1e-3) << i;
  }
}
TEST_F(Slopes, OfTripleNoiseAreThoseOfEachComponent) {
  run(Op::Slope3T);
  for (int i = 0; i < points; ++i) {
    const Vec3 q = at(p, i), step = kStep * at(d, i), hi = rsl::noise3(q + step), lo = rsl::noise3(q - step);
    EXPECT_NEAR(out.at(0, i), (hi.x - lo.x) / (2 * kStep), 1e-3) << i;
    EXPECT_NEAR(out.at(1, i), (hi.y - lo.y) / (2 * kStep), 1e-3) << i;
    EXPECT_NEAR(out.at(2, i), (hi.z - lo.z) / (2 * kStep), 1e-3) << i;
  }
}
TEST_F(Slopes, GrowAsTheirDirectionDoesAndAreZeroWithoutOne) {
  run(Op::Slope3F);
  const std::vector<float> once = out.data;
  for (float& x : d.data) x *= 2;
  run(Op::Slope3F);
  for (int i = 0; i < points; ++i) EXPECT_EQ(out.at(0, i), 2 * once[static_cast<size_t>(i)]);
  for (float& x : d.data) x = 0;
  run(Op::Slope3F);
  for (int i = 0; i < points; ++i) EXPECT_EQ(out.at(0, i), 0);
}
TEST_F(Slopes, OfPlacesThatAreNoNumbersDoNoHarm) {
  Numbers numbers(10);
  for (float& x : p.data) x = numbers.any();
  for (float& x : d.data) x = numbers.any();
  run(Op::Slope3F);
  run(Op::Slope3T);
}

}  // namespace
}  // namespace tomales::compiler
