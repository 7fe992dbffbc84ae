// Closed bodies in front of nothing: a sample inside the silhouette that sees nothing looks through a crack.
#include <gtest/gtest.h>

#include <bit>

#include "reyes/frame.h"
#include "reyes/rib.h"

extern const TmShaderLibrary* tomales_builtin_shaders(void);

namespace tomales {
namespace {

DeepFrame hide(const std::string& body, const std::string& options = {}) {
  Log log(Log::Verbosity::Quiet);
  Stats stats;
  std::vector<Scene> scenes;
  RibSettings settings;
  settings.onScene = [&](Scene&& s) { scenes.push_back(std::move(s)); };
  readRibText(
      "Format 128 128 1 PixelSamples 6 6 PixelFilter \"box\" 1 1 Projection \"perspective\" \"fov\" 40 "
      "Clipping 0.1 100 " +
          options + " Translate 0 0 3.2 Rotate 25 1 0.3 0.1 WorldBegin " + body + " WorldEnd",
      "crack.rib", settings, log);
  ShaderRegistry registry(log);
  registry.addLibrary(tomales_builtin_shaders(), "built-in");
  const ShadingSystem shading(scenes.at(0), registry, nullptr, log, stats);
  DeepFrame frame = hideFrame(scenes[0], shading, {}, stats, log);
  for (const LogEntry& e : log.entries()) ADD_FAILURE() << e.code;
  return frame;
}

int covered(const DeepFrame& frame, int x, int y) {
  const DeepTile& tile = frame.tileAt(x, y);
  const DeepPixel& p = tile.pixel(x, y);
  int n = 0;
  for (uint32_t k = 0; k < p.count; ++k) n += std::popcount(tile.fragments[p.first + k].samples);
  return n;
}

struct Holes {
  int inside_px = 0, samples = 0;
};

/// A pixel lies inside the silhouette if all within `margin` pixels of it are at least half covered: where
/// blur spreads the silhouette by that much to either side, coverage is whole again.
Holes holes(const DeepFrame& frame, int margin = 2) {
  Holes found;
  const PixelRect& r = frame.crop;
  const auto inside = [&](int x, int y) {
    for (int dy = -margin; dy <= margin; ++dy)
      for (int dx = -margin; dx <= margin; ++dx)
        if (!r.contains(x + dx, y + dy) || 2 * covered(frame, x + dx, y + dy) < frame.samplesPerPixel)
          return false;
    return true;
  };
  for (int y = r.y0; y < r.y1; ++y)
    for (int x = r.x0; x < r.x1; ++x)
      if (inside(x, y)) ++found.inside_px, found.samples += frame.samplesPerPixel - covered(frame, x, y);
  return found;
}

constexpr const char* kSphere = "Sphere 1 -1 1 360";
constexpr const char* kTorus = "Torus 0.75 0.3 0 360 360";
constexpr const char* kCube =
    "Rotate 20 1 1 0 SubdivisionMesh \"catmull-clark\" [4 4 4 4 4 4] [0 1 3 2 4 6 7 5 0 4 5 1 2 3 7 6 0 2 6 "
    "4 1 5 7 3] "
    "[\"interpolateboundary\"] [0 0] [] [] \"P\" [-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 1 1 "
    "1]";
constexpr const char* kBumpy =
    "Attribute \"displacementbound\" \"float sphere\" [0.12] "
    "Displacement \"noisybump\" \"float Km\" [0.1] \"float frequency\" [3] \"float octaves\" [2] Sphere 0.9 "
    "-0.9 0.9 360";

struct Body {
  const char *name, *rib;
};
class Crack : public testing::TestWithParam<Body> {};

TEST_P(Crack, NoneInAClosedBodyAtAnyShadingRate) {
  for (const char* rate : {"0.25", "1", "4"})
    for (const char* turn : {"", "Rotate 70 0 1 0.2 ", "Rotate 130 1 0.4 0 "}) {
      const Holes found = holes(hide("ShadingRate " + std::string(rate) + " " + turn + GetParam().rib));
      EXPECT_GT(found.inside_px, 1500);
      EXPECT_EQ(found.samples, 0) << "rate " << rate << " " << turn;
    }
}

TEST_P(Crack, NoneWhenGridsAreSmall) {
  for (const char* size : {"4", "23"}) {
    const Holes found =
        holes(hide(GetParam().rib, "Option \"limits\" \"gridsize\" [" + std::string(size) + "]"));
    EXPECT_GT(found.inside_px, 1500);
    EXPECT_EQ(found.samples, 0) << "grids of " << size;
  }
}

TEST_P(Crack, NoneWhenItMovesOrIsOutOfFocus) {
  // 8 degrees at radius 1 are 8 px between the extremes; the circle of confusion at z = 3.2 is 176 / 8 * 0.19
  // = 4 px.
  constexpr int kBlur_px = 6;
  const std::string body = GetParam().rib;
  const Holes moving = holes(
      hide("MotionBegin [0 1] Rotate 0 1 1 0 Rotate 8 1 1 0 MotionEnd " + body, "Shutter 0 1"), kBlur_px);
  EXPECT_GT(moving.inside_px, 500);
  EXPECT_EQ(moving.samples, 0);
  const Holes blurred = holes(hide(body, "DepthOfField 4 1 2"), kBlur_px);
  EXPECT_GT(blurred.inside_px, 500);
  EXPECT_EQ(blurred.samples, 0);
}

INSTANTIATE_TEST_SUITE_P(Bodies, Crack,
                         testing::Values(Body{"Sphere", kSphere}, Body{"Torus", kTorus},
                                         Body{"SubdivisionCube", kCube}, Body{"DisplacedSphere", kBumpy}),
                         [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace tomales
