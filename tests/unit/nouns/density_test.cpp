// What rays meet in a lattice of densities, against closed forms.
#include "reyes/density.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

namespace tomales {
namespace {

/// A lattice that holds f at each point from `first` to `last`; index space is object space.
template <class F>
DensityGrid lattice(const ivec3& first, const ivec3& last, const F& f, const mat4& indexFromObject = mat4(1.0f)) {
  DensityGrid out(first, last, indexFromObject, {vec3(first) - 1.0f, vec3(last) + 1.0f});
  for (int x = first.x; x <= last.x; ++x)
    for (int y = first.y; y <= last.y; ++y)
      for (int z = first.z; z <= last.z; ++z)
        if (const float v = f(x, y, z); v != 0) out.set({x, y, z}, v);
  out.finish();
  return out;
}

TEST(Density, OfEqualPointsIsTheirNumberTimesTheirDistance) {
  const DensityGrid grid = lattice(ivec3(-3), ivec3(12), [](int, int, int) { return 2.0f; });
  for (int axis = 0; axis < 3; ++axis) {
    vec3 from(3.3f), along(0);
    from[axis] = -50;
    along[axis] = 1;
    EXPECT_NEAR(grid.columnDensity(from, along, 0, 100), 2 * 16, 1e-4) << axis;
    from[axis] = 50;
    along[axis] = -1;
    EXPECT_NEAR(grid.columnDensity(from, along, 0, 100), 2 * 16, 1e-4) << axis;
  }
}

// xyz is linear along each axis, so the lattice holds it exactly; along a diagonal it is a cubic.
TEST(Density, OfAProductOfCoordinatesIsExact) {
  const DensityGrid grid = lattice(ivec3(0), ivec3(20), [](int x, int y, int z) { return float(x * y * z); });
  const vec3 along = glm::normalize(vec3(1));
  const float length = 10 * std::sqrt(3.0f);
  EXPECT_NEAR(grid.columnDensity(vec3(0), along, 0, length), std::sqrt(3.0) * 1e4 / 4, 0.05);
  const auto slanted = [](double t) { return (1 + 2 * t) * (3 + t) * (15 - 3 * t); };
  double sum = 0;
  for (int i = 0; i < 4000; ++i) sum += slanted((i + 0.5) / 1000) / 1000;
  EXPECT_NEAR(grid.columnDensity({1, 3, 15}, {2, 1, -3}, 0, 4), sum, 1e-3);
}

TEST(Density, IsFoundBehindEmptyBricks) {
  const DensityGrid grid = lattice(ivec3(0), ivec3(200, 3, 3), [](int x, int, int) { return x == 190 ? 1.0f : 0.0f; });
  EXPECT_NEAR(grid.columnDensity({-5, 1.5f, 1.5f}, {1, 0.001f, 0}, 0, 300), 1, 1e-4);
  EXPECT_NEAR(grid.columnDensity({205, 1.5f, 1.5f}, {-1, 0, 0}, 0, 300), 1, 1e-4);
  EXPECT_EQ(grid.columnDensity({-5, 1.5f, 1.5f}, {1, 0, 0}, 0, 100), 0);
}

TEST(Density, IsFoundThroughATransformation) {
  const mat4 indexFromObject = glm::scale(glm::rotate(mat4(1.0f), 0.7f, vec3(0, 0, 1)), vec3(4));
  const DensityGrid grid = lattice(
      ivec3(-9), ivec3(9), [](int, int, int) { return 1.0f; }, indexFromObject);
  EXPECT_NEAR(grid.columnDensity({-0.5f, 0, 0}, {1, 0, 0}, 0, 1), 1, 1e-5);
}

TEST(Density, AlongARayAddsUpToItsColumnDensity) {
  const DensityGrid grid = lattice(ivec3(0), ivec3(40), [](int x, int y, int z) {
    return x / 8 % 2 == 1 ? 0.0f : float((x * 7 + y * 3 + z * 5) % 11);
  });
  const vec3 from(-3, 5.2f, 7.7f), along = glm::normalize(vec3(1, 0.4f, 0.3f));
  DensityAlongRay way;
  grid.cross(from, along, 1, 44, 2, way);
  EXPECT_NEAR(way.columnDensity(), 2 * grid.columnDensity(from, along, 1, 44), 1e-3f * way.columnDensity());
  for (const DensityAlongRay::Knot& k : way.knots)
    EXPECT_NEAR(k.columnDensity, 2 * grid.columnDensity(from, along, 1, 1 + k.distance / 2),
                1e-3f * way.columnDensity());
  for (float amount = 1; amount < way.columnDensity(); amount += 0.7f) {
    const DensityAlongRay::Place there = way.atColumnDensity(amount), back = way.atDistance(there.distance);
    EXPECT_NEAR(back.columnDensity, amount, 1e-3f);
    EXPECT_GT(there.density, 0);
    EXPECT_NEAR(2 * grid.columnDensity(from, along, 1, 1 + there.distance / 2), amount, 3) << "within a cell";
  }
}

TEST(Density, TakesNothingThatIsNoDensity) {
  DensityGrid grid(ivec3(0), ivec3(7), mat4(1.0f), {vec3(0), vec3(7)});
  grid.set({1, 1, 1}, -2);
  grid.set({2, 2, 2}, kInfinity);
  grid.set({3, 3, 3}, std::nanf(""));
  grid.set({4, 4, 4}, 1);
  EXPECT_EQ(grid.finish(), 3u);
  EXPECT_EQ(grid.at({1, 1, 1}), 0);
  EXPECT_EQ(grid.at({4, 4, 4}), 1);
}

}  // namespace
}  // namespace tomales
