#include "reyes/image/formats.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "reyes/base/temporary_folder.h"
#include "reyes/image_files.h"

namespace tomales {
namespace {

TEST(PictureFormats, AreFoundByTypeAndByExtension) {
  std::set<std::string_view> words;
  for (const PictureFormat* f : pictureFormats()) {
    EXPECT_EQ(formatOfType(f->name), f);
    for (const auto type : f->types) EXPECT_EQ(formatOfType(type), f);
    for (const auto extension : f->extensions) EXPECT_EQ(formatOfExtension("a" + std::string(extension)), f);
    EXPECT_TRUE(words.insert(f->name).second) << f->name << " is the name of two formats";
    for (const Words& all : {f->types, f->extensions})
      for (const auto word : all) EXPECT_TRUE(words.insert(word).second) << word << " leads to two formats";
  }
  EXPECT_EQ(formatOfExtension("B.TIFF"), formatOfType("tif"));
  EXPECT_EQ(formatOfType("jpeg"), nullptr);
  EXPECT_EQ(formatOfExtension("a"), nullptr);
}

TEST(PictureFormats, HoldWhatIsWrittenToThem) {
  const TemporaryFolder folder(std::filesystem::temp_directory_path());
  Image image{3, 2, {"R", "G", "B"}, {}};
  for (int i = 0; i < 18; ++i) image.pixels.push_back(static_cast<float>(i) / 18);
  for (const PictureFormat* f : pictureFormats()) {
    Log log(Log::Verbosity::Quiet);
    const std::string file = (folder.path() / ("a" + std::string(f->extensions.front()))).string();
    ASSERT_TRUE(writeImage(file, image, false, log)) << f->name;
    std::string error;
    const auto back = readImage(file, error);
    ASSERT_TRUE(back && back->pixels.size() == image.pixels.size()) << f->name << ": " << error;
    for (size_t i = 0; i < image.pixels.size(); ++i)
      EXPECT_NEAR(back->pixels[i], image.pixels[i], f->quantises ? 0.5f / 255 + 1e-6f : 0) << f->name;
  }
}

TEST(PictureFormats, TheirParametersMayHaveAnyEnd) {
  EXPECT_TRUE(formatOfType("exr")->takes("exrheader_owner"));
  EXPECT_FALSE(formatOfType("exr")->takes("exrhead"));
  EXPECT_FALSE(formatOfType("png")->takes("exrheader_owner"));
  EXPECT_TRUE(anyFormatTakes("tiled"));
  EXPECT_FALSE(anyFormatTakes("tile"));
}

}  // namespace
}  // namespace tomales
