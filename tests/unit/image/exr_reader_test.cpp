// OpenEXR read by OpenEXR itself (reyes/pictures/exr_reader.h) against OpenImageIO.
#include <gtest/gtest.h>

#include <filesystem>

#include "reyes/base/rng.h"
#include "reyes/image/formats.h"
#include "reyes/image_files.h"
#include "reyes/pictures.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

class ExrReader : public testing::Test {
 protected:
  ~ExrReader() override { fs::remove(path_); }

  /// The file as it is opened, and as OpenImageIO opens it.
  std::pair<std::unique_ptr<PictureReader>, std::unique_ptr<PictureReader>> both() const {
    std::string error;
    auto ours = openPicture(path_, error);
    auto theirs = pictureLibrary(error)->open(path_, error);
    EXPECT_TRUE(ours && theirs) << error;
    return {std::move(ours), std::move(theirs)};
  }
  static void expectSameShape(const PictureReader& a, const PictureReader& b) {
    const PictureShape &x = a.shape(), &y = b.shape();
    EXPECT_EQ(x.channels, y.channels);
    EXPECT_EQ(std::tie(x.x, x.y, x.width, x.height, x.fullWidth, x.fullHeight),
              std::tie(y.x, y.y, y.width, y.height, y.fullWidth, y.fullHeight));
    EXPECT_EQ(a.deep(), b.deep());
    float m[16] = {}, n[16] = {};
    for (const char* name : {"worldtocamera", "worldtoscreen", "nothing"})
      EXPECT_EQ(a.matrix(name, m), b.matrix(name, n)) << name;
    EXPECT_TRUE(std::equal(m, m + 16, n));
  }
  void write(const Image& image, const FileFormat& format) const {
    PictureFile file(path_, image, format);
    ASSERT_TRUE(file.write(image) && file.close()) << file.error();
  }

  const std::string path_ = (fs::temp_directory_path() / "tomales_exr.exr").string();
  Metadata camera_{"worldtocamera", "", std::vector<float>(16, 0.25f)},
      screen_{"worldtoscreen", "", std::vector<float>(16, 0.75f)};
};

TEST_F(ExrReader, PicturesAreWhatOpenImageIOReads) {
  Image image{70,  65, {"A", "N.z", "R", "N.x", "G", "B", "Z", "diffuse.B", "diffuse.R", "N.y", "ZBack"}, {}, 3, 5,
              200, 210};
  for (int i = 0; i < 70 * 65 * 11; ++i) image.pixels.push_back(static_cast<float>(i % 977) / 977);
  FileFormat half{formatOfType("openexr"), SampleType::Half}, tiled{formatOfType("openexr"), SampleType::Float},
      parts = tiled;
  half.precise = {"Z"};
  half.metadata = {camera_, screen_};
  tiled.tile = 64;
  parts.multipart = true;
  for (const FileFormat& format : {half, tiled, parts}) {
    if (format.tile > 0) {
      image.height = 64;
      image.pixels.resize(70 * 64 * 11);
    }
    write(image, format);
    const auto [ours, theirs] = both();
    expectSameShape(*ours, *theirs);
    const int channels = static_cast<int>(ours->shape().channels.size());
    for (const auto& [first, end] : {std::pair(0, channels), std::pair(channels > 2 ? 2 : 0, std::min(channels, 5))}) {
      std::vector<float> a(static_cast<size_t>(70 * image.height * (end - first))), b(a.size());
      ASSERT_TRUE(ours->read(first, end, a.data()) && theirs->read(first, end, b.data()))
          << ours->error() << theirs->error();
      EXPECT_EQ(a, b);
    }
  }
}

TEST_F(ExrReader, NoiseThatDoesNotCompressAndLongNamesAreWhatOpenImageIOReads) {
  Image image{33, 37, {"a_name_longer_than_the_31_bytes_of_old_files", "k"}, {}, 0, 0, 33, 37};
  for (uint32_t i = 0; i < 33 * 37 * 2; ++i)
    image.pixels.push_back(__builtin_bit_cast(float, hash32(i) & ~0x00800000U));  // no infinities
  FileFormat format{formatOfType("openexr"), SampleType::Float};
  format.metadata = {{"another_name_that_is_longer_than_31_bytes", "text", {}}};
  write(image, format);
  EXPECT_GE(fs::file_size(path_), image.pixels.size() * sizeof(float));
  const auto [ours, theirs] = both();
  std::vector<float> a(image.pixels.size()), b(a.size());
  ASSERT_TRUE(ours->read(0, 2, a.data()) && theirs->read(0, 2, b.data())) << ours->error() << theirs->error();
  EXPECT_EQ(a, image.pixels);
  EXPECT_EQ(b, image.pixels);
}

TEST_F(ExrReader, DeepPixelsAreWhatOpenImageIOReads) {
  FileFormat format{formatOfType("openexr"), SampleType::Half};
  format.deep = true;
  format.precise = {"Z", "ZBack"};
  format.metadata = {camera_, screen_};
  const Image shape{5, 3, {"AR", "AG", "AB", "Z", "ZBack"}, {}, 2, 1, 9, 8};
  DeepRows rows{2, 1, 5, 3, {}, {}};
  for (uint32_t i = 0; i < 15; ++i) {
    rows.counts.push_back(i % 4);
    for (uint32_t v = 0; v < 5 * (i % 4); ++v) rows.values.push_back(static_cast<float>(i + v) / 64);
  }
  PictureFile file(path_, shape, format);
  ASSERT_TRUE(file.write(rows) && file.close()) << file.error();
  const auto [ours, theirs] = both();
  expectSameShape(*ours, *theirs);
  std::vector<uint32_t> counts, otherCounts;
  std::vector<float> values, otherValues;
  ASSERT_TRUE(ours->readDeep(counts, values) && theirs->readDeep(otherCounts, otherValues));
  EXPECT_EQ(counts, rows.counts);
  EXPECT_EQ(values, rows.values);
  EXPECT_EQ(counts, otherCounts);
  EXPECT_EQ(values, otherValues);
}

TEST_F(ExrReader, DamagedFilesAreRefusedWithAReason) {
  Image image{70, 65, {"R", "G", "B"}, std::vector<float>(70 * 65 * 3, 0.5f), 0, 0, 70, 65};
  write(image, {formatOfType("openexr"), SampleType::Float});
  const auto whole = fs::file_size(path_);
  for (const uintmax_t size : {whole - 5, whole / 2, uintmax_t{40}}) {
    fs::resize_file(path_, size);
    std::string error;
    EXPECT_FALSE(readImage(path_, error)) << size;
    EXPECT_FALSE(error.empty()) << size;
  }
}

}  // namespace
}  // namespace tomales
