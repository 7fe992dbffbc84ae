#include "reyes/hide/transparent_layers.h"

#include <gtest/gtest.h>

namespace tomales {
namespace {

void give(TransparentLayers& layers, uint32_t word, uint64_t samples, uint32_t cell, float depth) {
  for (; samples; samples &= samples - 1)
    layers.add(word, static_cast<uint32_t>(std::countr_zero(samples)), cell, depth);
  layers.flush();
}

TEST(TransparentLayers, CellsOfAGridShareALayerUntilOneSeesASampleTwice) {
  TransparentLayers layers(2, 16);
  layers.beginGrid();
  give(layers, 1, 0b0011, 7, 1);
  give(layers, 1, 0b1100, 8, 2);
  give(layers, 0, 0b0001, 8, 2);
  give(layers, 1, 0b0110, 9, 3);
  ASSERT_EQ(layers.count(), 3U);
  EXPECT_EQ(layers.layer(0).word, 1U);
  EXPECT_EQ(layers.layer(0).samples, 0b1111U);
  EXPECT_EQ(layers.cells(0)[1], 7U);
  EXPECT_EQ(layers.cells(0)[2], 8U);
  EXPECT_EQ(layers.depths(0)[3], 2.0f);
  EXPECT_EQ(layers.cells(0)[4], TransparentLayers::kNoCell);
  EXPECT_EQ(layers.layer(2).samples, 0b0110U);
  EXPECT_EQ(layers.cells(2)[1], 9U);
}

TEST(TransparentLayers, GridsDoNotShareThem) {
  TransparentLayers layers(1, 80);
  layers.beginGrid();
  give(layers, 0, uint64_t{1} << 63, 1, 1);
  layers.beginGrid();
  give(layers, 0, 1, 2, 1);
  give(layers, 1, 0x8000, 2, 1);
  EXPECT_EQ(layers.count(), 3U);
  EXPECT_EQ(layers.width(), 64U);
  EXPECT_EQ(layers.cells(2)[15], 2U);
}

}  // namespace
}  // namespace tomales
