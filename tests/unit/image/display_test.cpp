#include <gtest/gtest.h>

#include <filesystem>

#include "reyes/image.h"
#include "reyes/image_files.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

class Display : public testing::Test {
 protected:
  Display() : folder_(fs::temp_directory_path() / "tomales_display") { fs::create_directories(folder_); }
  ~Display() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static Image gradient() {
    Image image{4, 2, {"R", "G", "B", "A", "Z"}, {}, 0, 0, 4, 2};
    for (int i = 0; i < 8; ++i) {
      const float v = static_cast<float>(i) / 7;
      image.pixels.insert(image.pixels.end(), {v, v * v, 1 - v, 1, 10 + v});
    }
    return image;
  }
  Image read(const std::string& name) const {
    std::string error;
    const std::optional<Image> image = readImage(path(name), error);
    EXPECT_TRUE(image) << error;
    return image.value_or(Image{});
  }
  size_t filesLeft() const { return static_cast<size_t>(std::distance(fs::directory_iterator(folder_), {})); }

  fs::path folder_;
  Options options_;
  Log log_{Log::Verbosity::Quiet};
};

TEST_F(Display, ExrKeepsEveryBitAndNoTemporaryFileStays) {
  ASSERT_TRUE(writeDisplay(gradient(), {path("a.exr"), "file", "rgbaz", {}, {}}, options_, log_));
  const Image back = read("a.exr");
  ASSERT_EQ(back.channels, gradient().channels);
  EXPECT_EQ(back.pixels, gradient().pixels);
  EXPECT_EQ(filesLeft(), 1u);
}

TEST_F(Display, ACropIsADataWindowInsideTheDisplayWindow) {
  Image image = gradient();
  image.originX = 30;
  image.originY = 20;
  image.displayWidth = 640;
  image.displayHeight = 480;
  ASSERT_TRUE(writeDisplay(image, {path("a.exr"), "openexr", "rgb", {}, {}}, options_, log_));
  const Image back = read("a.exr");
  EXPECT_EQ(back.originX, 30);
  EXPECT_EQ(back.originY, 20);
  EXPECT_EQ(back.displayWidth, 640);
  EXPECT_EQ(back.width, 4);
}

TEST_F(Display, HalfKeepsElevenBitsOfColourAndAllOfDepth) {
  Param half;
  half.name = "exrpixeltype";
  half.type = ValueType::String;
  half.strings = {"half"};
  ASSERT_TRUE(writeDisplay(gradient(), {path("a.exr"), "file", "rgbaz", {half}, {}}, options_, log_));
  const Image back = read("a.exr");
  EXPECT_NEAR(back.at(2, 0)[0], 2.0f / 7, 2e-4f);
  EXPECT_NE(back.at(2, 0)[0], 2.0f / 7);
  EXPECT_EQ(back.at(2, 0)[4], 10 + 2.0f / 7);
}

TEST_F(Display, EightBitFilesRoundToTheNearestLevelAndClamp) {
  options_.rgbaQuantize.dither = 0;
  for (const char* name : {"a.tif", "a.png"}) {
    Image image = gradient();
    image.at(0, 0)[0] = -1;
    image.at(1, 0)[0] = 7;
    ASSERT_TRUE(writeDisplay(image, {path(name), "file", "rgb", {}, {}}, options_, log_));
    const Image back = read(name);
    EXPECT_EQ(back.at(0, 0)[0], 0) << name;
    EXPECT_EQ(back.at(1, 0)[0], 1) << name;
    EXPECT_NEAR(back.at(2, 0)[0], std::round(255 * 2.0f / 7) / 255, 1e-6f) << name;
  }
}

TEST_F(Display, SixteenBitFilesHaveSixteenBits) {
  options_.rgbaQuantize = {65535, 0, 65535, 0};
  ASSERT_TRUE(writeDisplay(gradient(), {path("a.tif"), "tiff", "rgb", {}, {}}, options_, log_));
  EXPECT_NEAR(read("a.tif").at(2, 0)[0], 2.0f / 7, 0.51f / 65535);
}

TEST_F(Display, TiffHoldsFloatsWhenQuantizeIsZero) {
  options_.rgbaQuantize = {0, 0, 0, 0};
  ASSERT_TRUE(writeDisplay(gradient(), {path("a.tif"), "tiff", "rgb", {}, {}}, options_, log_));
  EXPECT_EQ(read("a.tif").at(2, 0)[0], 2.0f / 7);
}

TEST_F(Display, DitherKeepsTheMeanAndTheEndsOfTheRange) {
  Image image{128, 128, {"R"}, std::vector<float>(128 * 128, 100.3f / 255), 0, 0, 128, 128};
  image.pixels[0] = 0;
  image.pixels[1] = 1;
  image.channels = {"R"};
  options_.rgbaQuantize.dither = 0.5f;
  ASSERT_TRUE(writeDisplay(image, {path("a.tif"), "file", "r", {}, {}}, options_, log_));
  const Image back = read("a.tif");
  EXPECT_EQ(back.pixels[0], 0);
  EXPECT_EQ(back.pixels[1], 1);
  double sum = 0;
  for (size_t i = 2; i < back.pixels.size(); ++i) sum += static_cast<double>(back.pixels[i]);
  EXPECT_NEAR(255 * sum / static_cast<double>(back.pixels.size() - 2), 100.3, 0.02);
}

TEST_F(Display, SrgbIsTheStandardTransfer) {
  Image image{3, 1, {"R", "G", "B"}, {0.5f, 0.5f, 0.5f, 0.001f, 0.001f, 0.001f, 1, 1, 1}, 0, 0, 3, 1};
  ASSERT_TRUE(writeImage(path("a.png"), image, true, log_));
  const Image back = read("a.png");
  EXPECT_NEAR(255 * back.at(0, 0)[0], 188, 1e-3f);  // 0.7354
  EXPECT_NEAR(255 * back.at(1, 0)[0], 3, 1e-3f);    // 12.92 * 0.001
  EXPECT_NEAR(255 * back.at(2, 0)[0], 255, 1e-3f);
}

TEST_F(Display, TransferSrgbEncodesColourDividedByAlpha) {
  Image image{2, 1, {"R", "G", "B", "A"}, {0.25f, 0.25f, 0.25f, 0.5f, 0, 0, 0, 0}, 0, 0, 2, 1};
  Param transfer;
  transfer.name = "transfer";
  transfer.type = ValueType::String;
  transfer.strings = {"sRGB"};
  options_.rgbaQuantize.dither = 0;
  ASSERT_TRUE(writeDisplay(image, {path("a.png"), "png", "rgba", {transfer}, {}}, options_, log_));
  EXPECT_EQ(log_.entries().size(), 0u);
  // The reader multiplies by alpha again: 188 * 128 / 255.
  EXPECT_NEAR(255 * read("a.png").at(0, 0)[0], 94, 1);
}

TEST_F(Display, PngHoldsColourDividedByAlpha) {
  const float a = 65.0f / 255;
  Image image{1, 1, {"R", "G", "B", "A"}, {0.2f * a, 0.7f * a, a, a}, 0, 0, 1, 1};
  options_.rgbaQuantize = {65535, 0, 65535, 0};
  ASSERT_TRUE(writeDisplay(image, {path("a.png"), "png", "rgba", {}, {}}, options_, log_));
  const Image back = read("a.png");  // the reader multiplies by alpha again
  for (size_t c = 0; c < 4; ++c) EXPECT_NEAR(back.pixels[c], image.pixels[c], 1.6f / 65535);
}

TEST_F(Display, TiffKeepsItsWindowAndEveryBitUnderEachCompression) {
  Image large{150, 130, {"R", "G", "B", "A", "Z"}, {}, 3, 5, 200, 210};
  for (int i = 0; i < 150 * 130 * 5; ++i) large.pixels.push_back(static_cast<float>(i % 977) / 977);
  options_.rgbaQuantize = {0, 0, 0, 0};
  for (const char* name : {"", "none", "rle", "zip", "lzw"}) {
    Param compression;
    compression.name = "compression";
    compression.type = ValueType::String;
    compression.strings = {name};
    ASSERT_TRUE(writeDisplay(large, {path("a.tif"), "tiff", "rgbaz", {compression}, {}}, options_, log_)) << name;
    const Image back = read("a.tif");
    EXPECT_EQ(back.originX, 3);
    EXPECT_EQ(back.originY, 5);
    EXPECT_EQ(back.displayWidth, 200);
    EXPECT_EQ(back.displayHeight, 210);
    EXPECT_EQ(back.pixels, large.pixels) << name;
  }
  EXPECT_EQ(log_.entries().size(), 0u);
}

TEST_F(Display, WhatOtherFormatsCannotHoldIsNamed) {
  Param compression, tiled;
  compression.name = "compression";
  compression.type = ValueType::String;
  compression.strings = {"piz"};
  tiled.name = "tiled";
  tiled.type = ValueType::Integer;
  tiled.ints = {1};
  ASSERT_TRUE(writeDisplay(gradient(), {path("a.tif"), "tiff", "rgba", {compression, tiled}, {}}, options_, log_));
  EXPECT_EQ(log_.count("display-compression"), 1);
  EXPECT_EQ(log_.count("display-parameter"), 1);
  Image five{1, 1, {"a", "b", "c", "d", "e"}, {0, 0, 0, 0, 0}, 0, 0, 1, 1};
  EXPECT_FALSE(writeImage(path("a.png"), five, false, log_));
  EXPECT_EQ(log_.worst(), Severity::Output);
}

TEST_F(Display, ANameWithoutAFormatBecomesOpenExr) {
  ASSERT_TRUE(writeDisplay(gradient(), {path("ri.pic"), "file", "rgba", {}, {}}, options_, log_));
  EXPECT_TRUE(fs::exists(path("ri.exr")));
}

TEST_F(Display, ATypeThatNobodyKnowsIsToldWithTheFileThatIsWritten) {
  ASSERT_TRUE(writeDisplay(gradient(), {path("x.jpg"), "jpeg", "rgba", {}, {}}, options_, log_));
  ASSERT_EQ(log_.count("display-type"), 1);
  EXPECT_NE(log_.entries()[0].message.find(path("x.exr")), std::string::npos);
  EXPECT_TRUE(fs::exists(path("x.exr")));
}

TEST_F(Display, AnOriginInAFrameBufferIsToldToBeIgnored) {
  Param origin;
  origin.name = "origin";
  origin.type = ValueType::Integer;
  origin.arrayLength = 2;
  origin.ints = {0, 0};
  ASSERT_TRUE(writeDisplay(gradient(), {path("a.exr"), "file", "rgba", {origin}, {}}, options_, log_));
  EXPECT_EQ(log_.count("display-parameter"), 0);
  origin.ints = {0, 20};
  ASSERT_TRUE(writeDisplay(gradient(), {path("a.exr"), "file", "rgba", {origin}, {}}, options_, log_));
  EXPECT_EQ(log_.count("display-parameter"), 1);
}

TEST_F(Display, APathThatCannotBeWrittenIsAnOutputErrorNamingIt) {
  const std::string bad = path("no/such/folder/a.exr");
  EXPECT_FALSE(writeDisplay(gradient(), {bad, "file", "rgba", {}, {}}, options_, log_));
  EXPECT_FALSE(writeImage(folder_.string() + "/", gradient(), false, log_));
  EXPECT_EQ(log_.worst(), Severity::Output);
  EXPECT_NE(log_.entries()[0].message.find(bad), std::string::npos);
}

TEST_F(Display, DepthInPngIsRefused) {
  EXPECT_FALSE(writeDisplay(gradient(), {path("a.png"), "file", "z", {}, {}}, options_, log_));
  EXPECT_EQ(log_.count("display-depth"), 1);
}

TEST_F(Display, TilesPartsAndCompressionsKeepEveryBit) {
  Image large{150, 130, {"R", "G", "B", "A", "Z"}, {}, 3, 5, 200, 200};
  for (int i = 0; i < 150 * 130 * 5; ++i) large.pixels.push_back(static_cast<float>(i % 977) / 977);
  for (const char* option : {"tiled", "multipart"}) {
    Param p, compression;
    p.name = option;
    p.type = ValueType::Integer;
    p.ints = {1};
    compression.name = "compression";
    compression.type = ValueType::String;
    compression.strings = {"piz"};
    ASSERT_TRUE(writeDisplay(large, {path("a.exr"), "openexr", "rgba", {p, compression}, {}}, options_, log_))
        << option;
    const Image back = read("a.exr");
    EXPECT_EQ(back.originX, 3);
    for (int i = 0; i < 150 * 130; ++i)
      ASSERT_EQ(back.pixels[static_cast<size_t>(4 * i)], large.pixels[static_cast<size_t>(5 * i)]);
  }
  EXPECT_EQ(log_.entries().size(), 0u);
}

TEST_F(Display, AChannelMayBeExposedAndQuantisedOnItsOwn) {
  Param exposure, quantize, dither;
  exposure.name = "exposure";
  exposure.floats = {2, 1};
  quantize.name = "quantize";
  quantize.floats = {100, 200, 0, 255};
  ASSERT_TRUE(writeDisplay(gradient(), {path("a.tif"), "tiff", "rgb", {exposure, quantize}, {}}, options_, log_));
  EXPECT_FLOAT_EQ(read("a.tif").at(1, 0)[0], std::round(100 + 100 * 2.0f / 7) / 255);
}

TEST_F(Display, AFileThatIsNotFinishedLeavesNothing) {
  {
    Options one = options_;
    one.displays.push_back({path("a.exr"), "openexr", "rgb", {}, {}});
    DisplayFile file(gradient(), outputOf(one), 0, one, log_);
    EXPECT_TRUE(file.write(gradient()));
  }
  EXPECT_EQ(filesLeft(), 0u);
}

TEST_F(Display, UnknownModesAndParametersWarnAndWriteRgba) {
  Param odd;
  odd.name = "sparkle";
  ASSERT_TRUE(writeDisplay(gradient(), {path("a.exr"), "file", "_normals", {odd}, {}}, options_, log_));
  EXPECT_EQ(read("a.exr").channels.size(), 4u);
  EXPECT_EQ(log_.count("display-mode"), 1);
  EXPECT_EQ(log_.count("display-parameter"), 1);
}

TEST_F(Display, ExposureScalesThenAppliesGammaToColourAlone) {
  Image image{1, 1, {"R", "G", "B", "A", "Z"}, {0.25f, -1, 0, 0.5f, 7}, 0, 0, 1, 1};
  options_.exposureGain = 4;
  options_.exposureGamma = 2;
  expose(image, options_);
  EXPECT_FLOAT_EQ(image.pixels[0], 1);
  image.pixels[0] = 1;
  expose(image, options_);
  EXPECT_FLOAT_EQ(image.pixels[0], 2);
  EXPECT_EQ(image.pixels[1], 0);
  EXPECT_EQ(image.pixels[3], 0.5f);
  EXPECT_EQ(image.pixels[4], 7);
}

TEST_F(Display, ReadingWhatIsNoPictureSaysWhy) {
  std::string error;
  EXPECT_FALSE(readImage(path("absent.exr"), error));
  EXPECT_FALSE(error.empty());
}

}  // namespace
}  // namespace tomales
