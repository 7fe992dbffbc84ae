#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "reyes/prim/face_pieces.h"

namespace tomales {
namespace {

/// A star-shaped outline of twelve corners, and a spike of no width at one of them.
std::vector<Point2> spiked(uint32_t seed, bool outward) {
  std::vector<Point2> out;
  const auto random = [&](uint32_t k) { return double{unitFloat(hashCombine(seed, k))}; };
  for (uint32_t k = 0; k < 12; ++k) {
    const double angle = 2 * M_PI * k / 12, r = 1 + 3 * random(k);
    const Point2 p(r * std::cos(angle), r * std::sin(angle));
    out.push_back(p);
    if (k != seed % 12) continue;
    out.push_back((outward ? 1.7 : 0.6) * p);
    out.push_back(p);
  }
  return out;
}

double areaOf(const std::vector<Point2>& p, const Piece& piece) {
  double area = 0;
  for (size_t i = 1; i + 1 < piece.size(); ++i)
    area += 0.5 * turn(p[static_cast<size_t>(piece[0])], p[static_cast<size_t>(piece[i])],
                       p[static_cast<size_t>(piece[i + 1])]);
  return area;
}

TEST(FacePieces, FillAnOutlineOnceWhateverSpikesItHas) {
  for (uint32_t seed = 0; seed < 300; ++seed)
    for (const bool outward : {false, true}) {
      const std::vector<Point2> p = spiked(seed, outward);
      Piece all(p.size());
      for (size_t i = 0; i < p.size(); ++i) all[i] = static_cast<int>(i);
      double sum = 0;
      for (const Piece& piece : convexPieces({p}).list) {
        EXPECT_GT(areaOf(p, piece), 0) << seed;
        sum += areaOf(p, piece);
      }
      EXPECT_NEAR(sum, areaOf(p, all), 1e-9) << seed << ' ' << outward;
    }
}

}  // namespace
}  // namespace tomales
