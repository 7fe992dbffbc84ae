// Surfaces made of pieces that know nothing of each other but have the same numbers at the borders that they share, as
// every exporter writes them. A sample inside the outline that sees nothing fell through a seam; one that sees two
// layers of a half transparent sheet met the seam twice.
#include <fmt/format.h>

#include <cstdlib>

#include "reyes/base/parallel.h"
#include "reyes/base/rng.h"
#include "tests/unit/frame/hidden_body.h"

namespace tomales {
namespace {
using namespace test;

constexpr int kQuads = 6;  ///< Along each side of a sheet.

float between(float lo, float hi, int i, int j, int what) {
  return lerp(lo, hi,
              unitFloat(hashCombine(static_cast<uint32_t>(i), static_cast<uint32_t>(j), static_cast<uint32_t>(what))));
}

/// A point of a bumpy sheet over [-1, 1]^2; i and j run from 0 to `count`. Those of the outline stay in line, so that
/// the outline has no corner that could be taken for a hole.
vec3 point(int i, int j, int count = kQuads) {
  const float step = 2.0f / static_cast<float>(count);
  const float x = -1 + step * (static_cast<float>(i) + (i % count ? between(-0.3f, 0.3f, i, j, 0) : 0));
  const float y = -1 + step * (static_cast<float>(j) + (j % count ? between(-0.3f, 0.3f, i, j, 1) : 0));
  return {x, y, between(-0.1f, 0.1f, i, j, 2)};
}

std::string text(const vec3& p) { return fmt::format("{} {} {} ", p.x, p.y, p.z); }

using Corner = std::array<vec3, 4>;  ///< In order around the quadrilateral.

/// write(corners, i, j): the RIB of a quadrilateral of the sheet.
template <class Write>
std::string sheetOf(const Write& write) {
  std::string rib;
  for (int j = 0; j < kQuads; ++j)
    for (int i = 0; i < kQuads; ++i)
      rib += write(Corner{point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)}, i, j);
  return rib;
}

std::string polygon(std::initializer_list<vec3> points) {
  std::string rib = "Polygon \"P\" [";
  for (const vec3& p : points) rib += text(p);
  return rib + "] ";
}

std::string triangles() {
  return sheetOf([](const Corner& c, int i, int j) {
    return (i + j) % 2 ? polygon({c[0], c[1], c[2]}) + polygon({c[0], c[2], c[3]})
                       : polygon({c[1], c[2], c[3]}) + polygon({c[1], c[3], c[0]});
  });
}
std::string quadrilaterals() {
  return sheetOf([](const Corner& c, int, int) { return polygon({c[0], c[1], c[2], c[3]}); });
}
std::string bilinearPatches() {
  return sheetOf([](const Corner& c, int, int) {
    return "Patch \"bilinear\" \"P\" [" + text(c[0]) + text(c[1]) + text(c[3]) + text(c[2]) + "] ";
  });
}
std::string singleFaces() {
  return sheetOf([](const Corner& c, int, int) {
    return "SubdivisionMesh \"catmull-clark\" [4] [0 1 2 3] [\"interpolateboundary\"] [0 0] [] [] \"P\" [" +
           text(c[0]) + text(c[1]) + text(c[2]) + text(c[3]) + "] ";
  });
}
/// Neighbours have other rates, and so are split to other depths.
std::string otherRates() {
  return sheetOf([](const Corner& c, int i, int j) {
    return fmt::format("ShadingRate {} ", std::array{0.2, 1.0, 30.0}[(i + 2 * j) % 3]) +
           polygon({c[0], c[1], c[2], c[3]});
  });
}
std::string everyKind() {
  return sheetOf([](const Corner& c, int i, int j) {
    const std::string around = text(c[0]) + text(c[1]) + text(c[2]) + text(c[3]);
    switch ((i + 3 * j) % 4) {
      case 0:
        return polygon({c[0], c[1], c[2]}) + polygon({c[0], c[2], c[3]});
      case 1:
        return "SubdivisionMesh \"catmull-clark\" [4] [0 1 2 3] [\"interpolateboundary\"] [0 0] [] [] \"P\" [" +
               around + "] ";
      case 2:
        return "NuPatch 2 2 [0 0 1 1] 0 1 2 2 [0 0 1 1] 0 1 \"P\" [" + text(c[0]) + text(c[1]) + text(c[3]) +
               text(c[2]) + "] ";
      default:
        return "SubdivisionMesh \"bilinear\" [4] [0 1 2 3] [] [] [] [] \"P\" [" + around + "] ";
    }
  });
}

/// One mesh: each face owns its vertices, or all share those of the sheet.
std::string mesh(bool welded) {
  std::string counts, faces, points;
  int own = 0;
  for (int j = 0; j < kQuads; ++j)
    for (int i = 0; i < kQuads; ++i) {
      counts += "4 ";
      for (const auto& [di, dj] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
        faces += fmt::format("{} ", welded ? (j + dj) * (kQuads + 1) + i + di : own++);
        if (!welded) points += text(point(i + di, j + dj));
      }
    }
  for (int j = 0; welded && j <= kQuads; ++j)
    for (int i = 0; i <= kQuads; ++i) points += text(point(i, j));
  return "PointsPolygons [" + counts + "] [" + faces + "] \"P\" [" + points + "] ";
}

/// Cubic pieces that share rows of control points. Their borders are curves.
std::string cubicPieces(const char* before, const char* after) {
  constexpr int kPieces = 3;
  std::string rib;
  for (int j = 0; j < kPieces; ++j)
    for (int i = 0; i < kPieces; ++i) {
      rib += before;
      for (int b = 0; b < 4; ++b)
        for (int a = 0; a < 4; ++a) rib += text(point(3 * i + a, 3 * j + b, 3 * kPieces));
      rib += after;
    }
  return rib;
}
std::string bicubicPatches() { return cubicPieces("Patch \"bicubic\" \"P\" [", "] "); }
std::string nuPatches() {
  return cubicPieces("NuPatch 4 4 [0 0 0 0 1 1 1 1] 0 1 4 4 [0 0 0 0 1 1 1 1] 0 1 \"P\" [", "] ");
}

/// A welded mesh between polygons that share the edges of its outline.
std::string meshAndPolygons() {
  std::string counts, faces, points, rib;
  for (int j = 1; j + 1 < kQuads; ++j)
    for (int i = 1; i + 1 < kQuads; ++i) {
      counts += "4 ";
      for (const auto& [di, dj] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
        faces += fmt::format("{} ", (j + dj) * (kQuads + 1) + i + di);
    }
  for (int j = 0; j <= kQuads; ++j)
    for (int i = 0; i <= kQuads; ++i) points += text(point(i, j));
  rib = "SubdivisionMesh \"bilinear\" [" + counts + "] [" + faces + "] [] [] [] [] \"P\" [" + points + "] ";
  return rib + sheetOf([](const Corner& c, int i, int j) {
           const bool outside = i == 0 || j == 0 || i == kQuads - 1 || j == kQuads - 1;
           return outside ? polygon({c[0], c[1], c[2], c[3]}) : std::string();
         });
}

struct Sheet {
  const char* name;
  std::string rib;
};
class Seam : public testing::TestWithParam<Sheet> {};

const char* const kTurns[] = {"", "Rotate 37 0 0 1", "Rotate 50 1 0.3 0.2 Rotate 10 0 0 1"};

DeepFrame seen(const std::string& body, const char* size, const char* options = "", const char* samples = "12 12") {
  return hideRib(
      fmt::format("Format {0} {0} 1 PixelSamples {1} PixelFilter \"box\" 1 1 Projection \"perspective\" "
                  "\"fov\" 40 Clipping 0.1 100 {2} Translate 0 0 3.2 WorldBegin {3} WorldEnd",
                  size, samples, options, body));
}

TEST_P(Seam, LetsNoSampleThrough) {
  int64_t inside = 0;
  for (const char* size : {"64", "150", "251"})
    for (const char* rate : {"0.25", "1", "4"})
      for (const char* turn : kTurns) {
        const Holes found = holes(seen(fmt::format("ShadingRate {} {} ", rate, turn) + GetParam().rib, size));
        inside += found.inside_px;
        EXPECT_EQ(found.samples, 0) << size << " px, rate " << rate << ", " << turn;
      }
  EXPECT_GT(inside, 200'000);
}

/// Returns by how much the layers that all samples of a pixel see differ from one each, at the worst pixel inside the
/// outline.
int mostOff(const DeepFrame& frame) {
  const int all = frame.samplesPerPixel;
  int most = 0, inside = 0;
  for (int y = 1; y + 1 < frame.crop.y1; ++y)
    for (int x = 1; x + 1 < frame.crop.x1; ++x) {
      int covering = 0;
      for (int k = 0; k < 9; ++k) covering += 2 * covered(frame, x + k % 3 - 1, y + k / 3 - 1) >= all;
      if (covering < 9) continue;
      ++inside;
      most = std::max(most, std::abs(covered(frame, x, y) - all));
    }
  EXPECT_GT(inside, 4000);
  return most;
}

TEST_P(Seam, IsNotSeenWhereSurfacesAreTransparent) {
  constexpr int kSeen = 144 / 16;  // of 144 samples: it makes a pixel of half a sheet 1/64 too opaque
  for (const char* rate : {"0.25", "1", "4"})
    for (const char* turn : {"", "Rotate 37 0 0 1"}) {
      const DeepFrame frame =
          seen(fmt::format("Opacity 0.5 0.5 0.5 ShadingRate {} {} ", rate, turn) + GetParam().rib, "150");
      EXPECT_LE(mostOff(frame), kSeen) << "rate " << rate << ", " << turn;
    }
}

TEST_P(Seam, LetsNoSampleThroughWhereItMovesOrIsOutOfFocus) {
  constexpr int kBlur_px = 6;
  for (const char* rate : {"0.25", "1", "4"}) {
    const std::string body = fmt::format("ShadingRate {} ", rate) + GetParam().rib;
    const Holes moving =
        holes(seen("MotionBegin [0 1] Rotate 10 1 0.3 0.2 Rotate 16 1 0.3 0.2 MotionEnd " + body, "150", "Shutter 0 1"),
              kBlur_px);
    EXPECT_GT(moving.inside_px, 2500);
    EXPECT_EQ(moving.samples, 0) << "moving, rate " << rate;
    const Holes blurred = holes(seen("Rotate 37 1 0 1 " + body, "150", "DepthOfField 4 1 2"), kBlur_px);
    EXPECT_GT(blurred.inside_px, 2500);
    EXPECT_EQ(blurred.samples, 0) << "out of focus, rate " << rate;
  }
}

/// What the samples of the pixels of a window see: which of them, and how far.
std::vector<std::pair<uint64_t, float>> within(const DeepFrame& frame, const PixelRect& window) {
  std::vector<std::pair<uint64_t, float>> out;
  for (int y = window.y0; y < window.y1; ++y)
    for (int x = window.x0; x < window.x1; ++x) {
      out.emplace_back(~uint64_t{0}, -1.0f);
      forFragments(frame, x, y, [&](const DeepTile&, const Fragment& f) { out.emplace_back(f.samples, f.z); });
    }
  return out;
}

// Borders are moved onto each other in the order in which pieces come, which none of these may change.
TEST_P(Seam, IsTheSameForAnyThreadsBucketsAndCrop) {
  const PixelRect middle{45, 30, 105, 90};
  for (const std::string blur : {"", "MotionBegin [0 1] Rotate 10 1 0.3 0.2 Rotate 16 1 0.3 0.2 MotionEnd "}) {
    const std::string body = "Opacity 0.5 0.5 0.5 ShadingRate 1 Rotate 37 0 0 1 " + blur + GetParam().rib;
    const std::string shutter = "Shutter 0 1 ";
    const auto of = [&](const std::string& options) {
      return within(seen(body, "150", (shutter + options).c_str(), "4 4"), middle);
    };
    const auto whole = of("");
    ASSERT_GT(whole.size(), 7000u);
    for (const char* options :
         {"CropWindow 0.3 0.7 0.2 0.6", "Option \"limits\" \"integer bucketsize[2]\" [7 13]",
          "Option \"limits\" \"integer bucketsize[2]\" [150 150]", "Option \"bucket\" \"string order\" \"random\""})
      EXPECT_EQ(of(options), whole) << options << " " << blur;
    const ThreadLimit one(1);
    EXPECT_EQ(of(""), whole) << "one thread " << blur;
  }
}

INSTANTIATE_TEST_SUITE_P(Sheets, Seam,
                         testing::Values(Sheet{"Triangles", triangles()}, Sheet{"Quadrilaterals", quadrilaterals()},
                                         Sheet{"BilinearPatches", bilinearPatches()},
                                         Sheet{"SingleFaces", singleFaces()}, Sheet{"OtherRates", otherRates()},
                                         Sheet{"EveryKind", everyKind()}, Sheet{"UnweldedMesh", mesh(false)},
                                         Sheet{"WeldedMesh", mesh(true)}, Sheet{"BicubicPatches", bicubicPatches()},
                                         Sheet{"NuPatches", nuPatches()}, Sheet{"MeshAndPolygons", meshAndPolygons()}),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace tomales
