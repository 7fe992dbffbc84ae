// Tests the hider's counts of samples whose result is uncertain or badly shown.
#include <gtest/gtest.h>

#include "tests/unit/hide/tile.h"

namespace tomales::test {
namespace {

constexpr PixelRect kDiagnosed{0, 0, 32, 32};

HideDiagnostics diagnosticsOf(const World& w, const Rasters& rasters) {
  const SamplePattern pattern(4, 4, true, 1);
  Hider hider(w.scene, Camera(w.scene.options), pattern, kDiagnosed);
  for (const auto& r : rasters) hider.insert(r);
  HideDiagnostics diagnostics;
  hider.resolve(&diagnostics);
  return diagnostics;
}

/// Two slanted squares of other dicing, `apart` in depth, behind what hides part of them.
int conflictPixels(float apart, bool hidden = false) {
  World w;
  w.add();
  w.add();
  w.add();
  w.freeze();
  const auto slanted = [](float z) {
    return [z](float u, float v, int) { return at(4 + 24 * u, 4 + 24 * v, z + 3 * u + 2 * v); };
  };
  Rasters rasters{raster(w, makeGrid(0, 1, 24, 24, slanted(5))), raster(w, makeGrid(1, 2, 17, 19, slanted(5 + apart)))};
  if (hidden) rasters.push_back(raster(w, makeGrid(2, 3, 1, 1, rectangle(0, 0, 32, 32, 1))));
  const HideDiagnostics diagnostics = diagnosticsOf(w, rasters);
  const auto found = diagnostics.samePlaces.find({0, 1});
  return found == diagnostics.samePlaces.end() ? 0 : found->second;
}

TEST(Diagnostics, SurfacesAtTheSamePlaceAreToldByTheirPixels) {
  EXPECT_GT(conflictPixels(0), 24 * 24 / 2);
  EXPECT_GT(conflictPixels(1e-5f), 24 * 24 / 4);
}

TEST(Diagnostics, SurfacesThatDepthsTellApartAreNotInDoubt) { EXPECT_EQ(conflictPixels(0.05f), 0); }

TEST(Diagnostics, WhatIsHiddenAfterwardsIsNotInConflict) { EXPECT_EQ(conflictPixels(0, true), 0); }

TEST(Diagnostics, WhatStandsInFrontOfAConflictIsNotPartOfItEvenIfItIsOneOfTheTwo) {
  World w;
  w.add();
  w.add();
  w.freeze();
  // A box on a floor: its bottom lies in the floor, and its top hides both.
  const auto floor = makeGrid(0, 1, 24, 24, rectangle(0, 0, 32, 32, 9)),
             bottom = makeGrid(1, 2, 17, 19, rectangle(4, 4, 28, 28, 9));
  const auto top = makeGrid(1, 3, 9, 9, rectangle(4, 4, 28, 28, 5));
  EXPECT_FALSE(diagnosticsOf(w, {raster(w, floor), raster(w, bottom)}).samePlaces.empty());
  EXPECT_TRUE(diagnosticsOf(w, {raster(w, floor), raster(w, bottom), raster(w, top)}).samePlaces.empty());
}

TEST(Diagnostics, WallsThatMeetAreNotInConflict) {
  World w;
  w.add();
  w.add();
  w.freeze();
  const auto one = makeGrid(0, 1, 24, 24, [](float u, float v, int) { return at(16 * u, 32 * v, 5 + 8 * u); });
  const auto other = makeGrid(1, 2, 24, 24, [](float u, float v, int) { return at(32 * u, 32 * v, 5 + 16 * (1 - u)); });
  const HideDiagnostics diagnostics = diagnosticsOf(w, {raster(w, one), raster(w, other)});
  for (const auto& [pair, pixels] : diagnostics.samePlaces) EXPECT_LT(pixels, 3);
}

/// A cylinder that stands upright, of so many micropolygons around and so many pixels wide.
HideDiagnostics::Turns turnsOfCylinder(int around, float radius_px) {
  World w;
  w.add();
  w.freeze();
  const auto turn = [](float u) { return kPi * (u - 0.5f); };
  const auto g = makeGrid(0, 1, around, 4, [&](float u, float v, int) {
    return at(16 + radius_px * std::sin(turn(u)), 4 + 24 * v, 40 - radius_px * std::cos(turn(u)));
  });
  for (int k = 0; k < g->vertexCount(); ++k) {
    const float a = turn(static_cast<float>(k % (around + 1)) / static_cast<float>(around));
    g->N(0)[k] = std::sin(a);
    g->N(2)[k] = -std::cos(a);
  }
  const HideDiagnostics diagnostics = diagnosticsOf(w, {raster(w, g)});
  return diagnostics.turns.at(0);
}

TEST(Diagnostics, MicropolygonsThatTurnFarAreCounted) {
  const auto coarse = turnsOfCylinder(4, 12), fine = turnsOfCylinder(24, 12), thin = turnsOfCylinder(4, 0.3f);
  EXPECT_EQ(coarse.turned, coarse.all);
  EXPECT_GT(coarse.all, 8);
  EXPECT_EQ(fine.turned, 0);
  EXPECT_EQ(thin.turned, 0) << "it has no outline to spoil";
}

}  // namespace
}  // namespace tomales::test
