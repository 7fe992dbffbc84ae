// Small balls cover what they should, in focus and out of it.
#include <fmt/format.h>

#include "tests/unit/frame/hidden_body.h"

namespace tomales {
namespace {
using namespace test;

/// The share of a disk with the ball's outline that samples cover. An fStop of 0 means that the ball is in focus.
double share(float radius, int fStop, int degrees, float x) {
  const std::string options = fStop ? fmt::format("DepthOfField {} 1 5", fStop) : "";
  const DeepFrame f = hide(fmt::format("Translate {} {} 10 Rotate {} 1 0.3 0 Sphere {} {} {} 360", x, 0.7f * x, degrees,
                                       radius, -radius, radius),
                           options, "");
  double area_px2 = 0;
  for (int y = f.crop.y0; y < f.crop.y1; ++y)
    for (int x_px = f.crop.x0; x_px < f.crop.x1; ++x_px) area_px2 += covered(f, x_px, y) / 36.0;
  const double outline_px = 64 / std::tan(glm::radians(20.0)) * std::tan(std::asin(radius / 10));
  return area_px2 / (M_PI * outline_px * outline_px);
}

TEST(SmallBalls, CoverTheAreaOfADiskHoweverFarOutOfFocus) {
  for (const float radius : {0.3f, 0.5f, 1.0f})  // 5 to 18 px
    for (const int fStop : {0, 4, 2, 1})
      for (const int degrees : {0, 35, 90})
        for (const float x : {0.0f, 0.1f, -0.3f}) {
          const double found = share(radius, fStop, degrees, x);
          EXPECT_GT(found, 0.94) << radius << ' ' << fStop << ' ' << degrees << ' ' << x;
          EXPECT_LT(found, 1.04) << radius << ' ' << fStop << ' ' << degrees << ' ' << x;
        }
}

}  // namespace
}  // namespace tomales
