#include "reyes/hide/films.h"

#include <gtest/gtest.h>

namespace tomales {
namespace {

void give(Films& films, uint32_t word, uint64_t samples, uint32_t cell, float depth) {
  for (; samples; samples &= samples - 1)
    films.add(word, static_cast<uint32_t>(std::countr_zero(samples)), cell, depth);
  films.flush();
}

TEST(Films, CellsOfAGridShareAFilmUntilOneSeesASampleTwice) {
  Films films(2, 16);
  films.beginGrid();
  give(films, 1, 0b0011, 7, 1);
  give(films, 1, 0b1100, 8, 2);
  give(films, 0, 0b0001, 8, 2);
  give(films, 1, 0b0110, 9, 3);
  ASSERT_EQ(films.count(), 3U);
  EXPECT_EQ(films.film(0).word, 1U);
  EXPECT_EQ(films.film(0).samples, 0b1111U);
  EXPECT_EQ(films.cells(0)[1], 7U);
  EXPECT_EQ(films.cells(0)[2], 8U);
  EXPECT_EQ(films.depths(0)[3], 2.0f);
  EXPECT_EQ(films.cells(0)[4], Films::kNoCell);
  EXPECT_EQ(films.film(2).samples, 0b0110U);
  EXPECT_EQ(films.cells(2)[1], 9U);
}

TEST(Films, GridsDoNotShareThem) {
  Films films(1, 80);
  films.beginGrid();
  give(films, 0, uint64_t{1} << 63, 1, 1);
  films.beginGrid();
  give(films, 0, 1, 2, 1);
  give(films, 1, 0x8000, 2, 1);
  EXPECT_EQ(films.count(), 3U);
  EXPECT_EQ(films.width(), 64U);
  EXPECT_EQ(films.cells(2)[15], 2U);
}

}  // namespace
}  // namespace tomales
