// Closed bodies show their outside alone, whatever turns at their outlines: what is lit is the side that is
// seen.
#include "reyes/shader/noise.h"
#include "tests/unit/frame/hidden_body.h"

namespace tomales {
namespace {
using namespace test;

constexpr const char* kBumpyBall =
    "Attribute \"displacementbound\" \"float sphere\" [0.12] "
    "Displacement \"noisybump\" \"float Km\" [0.1] \"float frequency\" [5] \"float octaves\" [3] Sphere 0.9 "
    "-0.9 0.9 360";
constexpr const char* kPlaced = "Translate 0 0 3.2 Rotate 25 1 0.3 0.1 ";

struct Sides {
  int front = 0, back = 0;
};

/// Samples by the side that is lit of what they see.
Sides sides(const DeepFrame& frame) {
  Sides out;
  for (const DeepTile& tile : frame.tiles)
    for (const Fragment& f : tile.fragments) {
      const Facet& facet = tile.facets[f.facet];
      const ShadePoints& points = tile.batches[static_cast<size_t>(facet.batch)];
      const bool front = points.facingNormal(facet.point[0]) == points.get3(kNx, facet.point[0]);
      (front ? out.front : out.back) += std::popcount(f.samples);
    }
  return out;
}

struct Outline : ::testing::TestWithParam<std::tuple<const char*, const char*>> {
  static std::string options(const char* more = "") { return std::string(std::get<1>(GetParam())) + more; }
};

// What is left: cells that turn away at borders of pieces, which reach a tenth of a pixel beyond them.
TEST_P(Outline, OfAClosedBodyShowsItsOutsideAlone) {
  for (const char* rate : {"0.3", "1", "7"}) {
    const Sides seen = sides(hide(std::get<0>(GetParam()), options(" ShadingRate ") + rate, kPlaced));
    EXPECT_GT(seen.front, 200000);
    EXPECT_LT(seen.back, seen.front / 3000) << rate;
  }
}

// As if it stood still: shading is that of shutter open.
TEST_P(Outline, OfWhatMovesByIsLitOnTheOutsideToo) {
  const Sides seen = sides(
      hide(std::string("MotionBegin [0 1] Translate 0 0 0 Translate 0.1 0 0 MotionEnd ") + std::get<0>(GetParam()),
           options(" Shutter 0 1"), kPlaced));
  EXPECT_LT(seen.back, seen.front / 1000);
}

// From +z the outline of a ball is the border of its patches, which reaches out where it is displaced. Elsewhere
// borders of patches run into the outline.
TEST(OutlineOfADisplacedBall, IsWhereItsSurfaceIs) {
  const float radius_px = (0.9f + 0.3f * rsl::signedNoise(rsl::Vec3{0, 0, 0})) * 128 / 5.2f;
  for (const char* rate : {"0.25", "1"})
    for (const char* placed : {"", "Rotate 90 1 0 0 ", "Rotate 45 1 1 0 "}) {
      const DeepFrame frame = hide(
          "Attribute \"displacementbound\" \"float sphere\" [0.2] Displacement \"noisybump\" \"float Km\" [0.3] "
          "\"float frequency\" [0] Sphere 0.9 -0.9 0.9 360",
          std::string("Projection \"orthographic\" ScreenWindow -2.6 2.6 -2.6 2.6 ShadingRate ") + rate,
          std::string("Sides 1 Translate 0 0 3.2 ") + placed);
      int samples = 0;
      for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x) samples += covered(frame, x, y);
      EXPECT_NEAR(std::sqrt(samples / 36.0 / kPi), radius_px, 0.06) << placed << rate;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, Outline,
    ::testing::Combine(::testing::Values(kSphere, kBumpyBall),
                       ::testing::Values("ShadingInterpolation \"constant\"", "ShadingInterpolation \"smooth\"",
                                         "Projection \"orthographic\" ScreenWindow -1.3 1.3 -1.3 1.3")));

}  // namespace
}  // namespace tomales
