// Trim curves: what they leave has exactly their area, and closed bodies made of trimmed pieces have no cracks.
#include <fmt/format.h>

#include "tests/unit/frame/hidden_body.h"

namespace tomales {
namespace {
using namespace test;

/// RISpec's circle of nine controls around (u, v), as the arguments of TrimCurve.
std::string circle(float u, float v, float radius) {
  const double h = std::sqrt(0.5);
  const double x[9] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, y[9] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  std::string us, vs, ws;
  for (int k = 0; k < 9; ++k) {
    const double w = k % 2 ? h : 1;
    us += fmt::format("{:.9f} ", (u + radius * x[k]) * w);
    vs += fmt::format("{:.9f} ", (v + radius * y[k]) * w);
    ws += fmt::format("{:.9f} ", w);
  }
  return fmt::format("TrimCurve [1] [3] [0 0 0 1 1 2 2 3 3 4 4 4] [0] [4] [9] [{}] [{}] [{}] ", us, vs, ws);
}

const std::string kKeepInside = "Attribute \"trimcurve\" \"sense\" [\"outside\"] ";
const std::string kSquare = "NuPatch 2 2 [-2 -2 2 2] -2 2 2 2 [-2 -2 2 2] -2 2 \"P\" [-2 -2 0 2 -2 0 -2 2 0 2 2 0] ";

double coveredArea_px2(const DeepFrame& frame) {
  int64_t samples = 0;
  for (int y = frame.crop.y0; y < frame.crop.y1; ++y)
    for (int x = frame.crop.x0; x < frame.crop.x1; ++x) samples += covered(frame, x, y);
  return static_cast<double>(samples) / frame.samplesPerPixel;
}

/// Orthographic, 50 px a unit, facing the square.
DeepFrame hideFlat(const std::string& body, const std::string& options = "") {
  return hide(body, "Projection \"orthographic\" ScreenWindow -1.28 1.28 -1.28 1.28 " + options, "Translate 0 0 3 ");
}

TEST(Trim, ADiskHasTheAreaOfTheCircleAtAnyShadingRate) {
  for (const char* rate : {"0.25", "1", "16", "400"}) {
    const double disk = coveredArea_px2(
        hideFlat(fmt::format("ShadingRate {} {}", rate, kKeepInside) + circle(0.1f, -0.05f, 1) + kSquare));
    EXPECT_NEAR(disk / (M_PI * 50 * 50), 1, 1e-3) << "rate " << rate;
  }
}

TEST(Trim, TheSensesShareTheSurfaceBetweenThem) {
  const double inside = coveredArea_px2(hideFlat(kKeepInside + circle(0, 0, 0.9f) + kSquare));
  const double outside = coveredArea_px2(hideFlat(circle(0, 0, 0.9f) + kSquare));
  EXPECT_NEAR(inside + outside, 128 * 128, 2);
}

TEST(Trim, ALoopInALoopIsOutside) {
  const auto ring = [](const std::string& outer, const std::string& inner) {
    return kKeepInside + outer + kSquare + inner;
  };
  const std::string two =
      "TrimCurve [1 1] [2 2] [0 0 1 2 3 4 4 0 0 1 2 3 4 4] [0 0] [4 4] [5 5] [-1 1 1 -1 -1 -0.5 0.5 0.5 -0.5 -0.5] "
      "[-1 -1 1 1 -1 -0.5 -0.5 0.5 0.5 -0.5] [1 1 1 1 1 1 1 1 1 1] ";
  EXPECT_NEAR(coveredArea_px2(hideFlat(ring(two, ""))), 3 * 50 * 50, 2);
  EXPECT_NEAR(coveredArea_px2(hideFlat(two + kSquare)), 128 * 128 - 3 * 50 * 50, 2);
}

TEST(Trim, AnEmptyTrimCurveAndTheEndOfItsAttributesEndIt) {
  const std::string empty = "TrimCurve [] [] [] [] [] [] [] [] [] ";
  EXPECT_EQ(coveredArea_px2(hideFlat(circle(0, 0, 1) + empty + kSquare)), 128 * 128);
  EXPECT_EQ(coveredArea_px2(hideFlat("AttributeBegin " + circle(0, 0, 1) + "AttributeEnd " + kSquare)), 128 * 128);
}

TEST(Trim, MovesAndBlursWithItsSurface) {
  // A disk that moves over 20 px covers the same area, spread.
  const std::string move = "MotionBegin [0 1] Translate -0.2 0 0 Translate 0.2 0 0 MotionEnd ";
  EXPECT_NEAR(
      coveredArea_px2(hideFlat(kKeepInside + circle(0, 0, 0.7f) + move + kSquare, "Shutter 0 1")) / (M_PI * 35 * 35), 1,
      2e-3);
}

TEST(Trim, WhatIsCutAwayIsNotDiced) {
  Log log(Log::Verbosity::Quiet);
  EXPECT_EQ(coveredArea_px2(hideFlat(kKeepInside + circle(1.8f, 1.8f, 0.1f) + kSquare)), 0);
}

/// Returns a surface of revolution: RISpec's circle times a meridian of points (radius, height, weight).
std::string revolved(const std::string& vLine, std::initializer_list<vec3> meridian) {
  const float h = std::sqrt(0.5f);
  const vec3 ring[9] = {{1, 0, 1},   {1, 1, h},  {0, 1, 1},  {-1, 1, h}, {-1, 0, 1},
                        {-1, -1, h}, {0, -1, 1}, {1, -1, h}, {1, 0, 1}};
  std::string out = "NuPatch 9 3 [0 0 0 1 1 2 2 3 3 4 4 4] 0 4 " + vLine + " \"Pw\" [";
  for (const vec3& m : meridian)
    for (const vec3& c : ring) {
      const float w = c.z * m.z;
      out += fmt::format("{} {} {} {} ", c.x * m.x * w, c.y * m.x * w, m.y * w, w);
    }
  return out + "] ";
}

std::string sphere() {
  const float h = std::sqrt(0.5f);
  return revolved("5 3 [0 0 0 1 1 2 2 2] 0 2", {{0, -1, 1}, {1, -1, h}, {1, 0, 1}, {1, 1, h}, {0, 1, 1}});
}

/// A can: a tube that is too long and is trimmed at both ends, and two squares trimmed to circles that close it.
std::string can() {
  const std::string tube = revolved("2 2 [-1 -1 1 1] -1 1", {{0.8f, -1, 1}, {0.8f, 1, 1}});
  const std::string band =
      "TrimCurve [1] [2] [0 0 1 2 3 4 4] [0] [4] [5] [-1 5 5 -1 -1] [-0.7 -0.7 0.7 0.7 -0.7] [1 1 1 1 1] ";
  const std::string cap = kKeepInside + circle(0, 0, 0.8f) + kSquare;
  return kKeepInside + band + tube + "AttributeBegin Translate 0 0 0.7 " + cap +
         "AttributeEnd ReverseOrientation Translate 0 0 -0.7 " + cap;
}

TEST(Trim, LeavesNoCrackWherePiecesOfDifferentRatesMeet) {
  const std::string cut = circle(1.8f, 1.1f, 0.6f);
  for (const auto& rates : {std::pair{1.0, 1.0}, {0.25, 2.0}, {4.0, 0.5}})
    for (const char* turn : {"", "Rotate 70 0 1 0.2 ", "Rotate 130 1 0.4 0 "}) {
      const std::string body =
          fmt::format("ShadingRate {} {}{} ShadingRate {} {}", rates.first, cut, sphere(), rates.second, kKeepInside) +
          sphere();
      const Holes found = holes(hide(turn + body));
      EXPECT_GT(found.inside_px, 1500);
      EXPECT_EQ(found.samples, 0) << rates.first << ' ' << rates.second << ' ' << turn;
    }
}

TEST(Trim, LeavesNoCrackAtTheRimOfACan) {
  for (const char* rate : {"0.25", "1", "4"})
    for (const char* turn : {"", "Rotate 70 0 1 0.2 ", "Rotate 130 1 0.4 0 "}) {
      const Holes found = holes(hide(fmt::format("ShadingRate {} {}", rate, turn) + can()));
      EXPECT_GT(found.inside_px, 1500);
      EXPECT_EQ(found.samples, 0) << rate << ' ' << turn;
    }
}

}  // namespace
}  // namespace tomales
