#include "reyes/app/settings.h"

#include <gtest/gtest.h>

#include "reyes/image.h"
#include "reyes/image_files.h"

namespace tomales {
namespace {

TEST(Frames, ListsAndRangesWithStepsAreSortedAndUnique) {
  EXPECT_EQ(parseFrames("1-10x2,15"), (std::vector<int>{1, 3, 5, 7, 9, 15}));
  EXPECT_EQ(parseFrames("7"), std::vector<int>{7});
  EXPECT_EQ(parseFrames("3,1-3"), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(parseFrames("-2-1"), (std::vector<int>{-2, -1, 0, 1}));
}

TEST(Frames, WhatIsNoListIsRefused) {
  for (const char* text : {"", ",", "a", "1-", "5-1", "1-10x0", "1-10x", "1,,2", "1 2", "0-2147483647"})
    EXPECT_FALSE(parseFrames(text)) << text;
}

TEST(Crop, IsFourOrderedFractions) {
  const auto crop = parseCrop("0,0.5,0.25,1");
  ASSERT_TRUE(crop);
  EXPECT_EQ(*crop, (std::array<float, 4>{0, 0.5f, 0.25f, 1}));
  for (const char* text :
       {"", "0,1,0", "0,1,0,1,0", "0.5,0.5,0,1", "1,0,0,1", "0,1.5,0,1", "-0.1,1,0,1", "nan,1,0,1", "a,b,c,d"})
    EXPECT_FALSE(parseCrop(text)) << text;
}

TEST(Pair, IsTwoNumbersWithinItsLimits) {
  EXPECT_EQ(parsePair("640x480", 1, 65536), (std::array<int, 2>{640, 480}));
  for (const char* text : {"640", "640x", "x480", "0x480", "640x-1", "99999x1", "640x480x3", "6.5x4"})
    EXPECT_FALSE(parsePair(text, 1, 65536)) << text;
}

TEST(OutputName, HashesBecomeThePaddedFrameNumber) {
  EXPECT_EQ(withFrameNumber("a.####.exr", 12), "a.0012.exr");
  EXPECT_EQ(withFrameNumber("a#.exr", 123), "a123.exr");
  EXPECT_EQ(withFrameNumber("a.exr", 1), "a.exr");
  EXPECT_EQ(withFrameNumber("##", 7), "07");
}

TEST(OutputName, PicturesAreKnownByTheirExtension) {
  for (const char* name : {"a.exr", "b/c.TIF", "d.tiff", "e.png"}) EXPECT_TRUE(namesPicture(name)) << name;
  for (const char* name : {"a.jpg", "exr", "a.exr.gz", ""}) EXPECT_FALSE(namesPicture(name)) << name;
}

TEST(GiMethod, HasNames) {
  EXPECT_EQ(parseGi("points"), giMethodNamed("points"));
  EXPECT_EQ(parseGi("reference"), giMethodNamed("reference"));
  EXPECT_EQ(parseGi("scene"), nullptr) << "is left to the scene";
  EXPECT_FALSE(parseGi("Gather"));
}

TEST(Settings, BytesMayHaveAUnit) {
  EXPECT_EQ(parseBytes("1000"), 1000);
  EXPECT_EQ(parseBytes("600M"), int64_t{600} << 20);
  EXPECT_EQ(parseBytes("2G"), int64_t{2} << 30);
  for (const char* text : {"", "M", "-1", "0", "1.5G", "9999999999T", "12Q"}) EXPECT_FALSE(parseBytes(text)) << text;
}

}  // namespace
}  // namespace tomales
