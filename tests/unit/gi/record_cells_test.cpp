#include "gi/cache/record_cells.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/gi/cache_records.h"

namespace tomales {
namespace {

constexpr uint32_t kRecords = 2000;
/// Records on a wall, which reach as far as three pixels at most.
std::vector<RecordReach> recordsOnAWall() {
  std::vector<RecordReach> out;
  for (uint32_t i = 0; i < kRecords; ++i)
    out.push_back({randomIn(i, 1) * vec3(1, 1, 0), {0, 0, 1}, unitFloat(hashCombine(i, 2)), kInfinity, 0, 0});
  return out;
}

float reachOf(const RecordReach& r, float pixelSize) { return std::min(r.size, 3 * pixelSize); }

/// Pixels are larger on the right.
float pixelsAt(const vec3& p) { return 0.02f + 0.01f * p.x; }

RecordCells cellsOfAWall() {
  return RecordCells(kBox, recordsOnAWall(), reachOf, [](const Bound3& box) { return pixelsAt(box.hi); });
}

TEST(RecordCells, TheListOfAPlaceHasEveryRecordThatServesItInOrderAndFewOthers) {
  const RecordCells cells = cellsOfAWall();
  size_t listed = 0, serving = 0;
  for (uint32_t i = 0; i < 500; ++i) {
    const vec3 x = randomIn(i, 3) * vec3(1, 1, 0);
    const auto list = cells.find(x, pixelsAt(x));
    ASSERT_TRUE(list);
    EXPECT_TRUE(std::is_sorted(list->begin(), list->end()));
    for (uint32_t r = 0; r < kRecords; ++r)
      if (glm::length(cells[r].position - x) <= reachOf(cells[r], pixelsAt(x))) {
        ++serving;
        EXPECT_TRUE(std::binary_search(list->begin(), list->end(), r));
      }
    listed += list->size();
  }
  EXPECT_GT(serving, 1000u);
  EXPECT_LT(listed, 4 * serving);
}

TEST(RecordCells, APlaceOutsideOrOfLargerPixelsThanWasSaidHasNoList) {
  const RecordCells cells = cellsOfAWall();
  EXPECT_TRUE(cells.find({0.5f, 0.5f, 0}, 0.02f));
  EXPECT_FALSE(cells.find({0.5f, 0.5f, 0}, 0.03f));
  EXPECT_FALSE(cells.find({1.1f, 0.5f, 0}, 0.02f));
}

TEST(RecordCells, SmallRecordsAmongManyLargeOnesDoNotTakeMemoryWithoutEnd) {
  std::vector<RecordReach> records = recordsOnAWall();
  for (uint32_t i = 0; i < kRecords; ++i) records[i].size = i % 2 ? 1.0f : 1e-3f;
  const RecordCells cells(
      kBox, records, [](const RecordReach& r, float) { return r.size; }, [](const Bound3&) { return 1.0f; });
  EXPECT_LT(cells.listed(), 500 * kRecords);
  const vec3 x = records[0].position;
  const auto list = cells.find(x, 1);
  EXPECT_EQ(list->front(), 0u);
  for (uint32_t r = 1; r < kRecords; r += 2) {
    const bool serves = glm::length(records[r].position - x) <= 1;
    EXPECT_TRUE(!serves || std::binary_search(list->begin(), list->end(), r));
  }
}

TEST(RecordCells, ManyRecordsAtOnePlaceAndNoRecordsAtAllHaveLists) {
  const auto noPixels = [](const Bound3&) { return 1.0f; };
  const RecordReach same{vec3(0.3f), {0, 0, 1}, 1e-9f, kInfinity, 0, 0};
  const RecordCells crowded(kBox, std::vector(50, same), reachOf, noPixels), empty(kBox, {}, reachOf, noPixels);
  EXPECT_EQ(crowded.find(vec3(0.3f), 1)->size(), 50u);
  EXPECT_EQ(crowded.find(vec3(-0.3f), 1)->size(), 0u);
  EXPECT_EQ(empty.find(vec3(0.3f), 1)->size(), 0u);
}

}  // namespace
}  // namespace tomales
