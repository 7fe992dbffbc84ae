#include "gi/ply.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace tomales {
namespace {

namespace fs = std::filesystem;

class Ply : public testing::Test {
 protected:
  Ply() { fs::create_directories(folder_); }
  ~Ply() override { fs::remove_all(folder_); }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  std::string wrote(const std::string& text) const {
    std::ofstream(at("in.ply"), std::ios::binary) << text;
    return at("in.ply");
  }
  PointCloud read(const std::string& text, float radius = 0) const {
    convertPly(wrote(text), at("out.ptc"), radius);
    return PointFile(at("out.ptc")).readAll();
  }

 private:
  const fs::path folder_ = fs::temp_directory_path() / (std::string("tomales_ply_") +
                                                        testing::UnitTest::GetInstance()->current_test_info()->name());
};

PointCloud someCloud() {
  PointCloud cloud;
  cloud.channels = {{"power", 3}, {"age", 1}, {"uv", 2}};
  for (int i = 0; i < 40'000; ++i) {  // more than two chunks
    const float x = static_cast<float>(i);
    const float values[] = {x, 2 * x, 0.5f * x, -x, x + 1, x + 2};
    cloud.add({x, 1 / (x + 1), -x}, i % 3 ? vec3(0, 0, 1) : vec3(0), 0.25f * x, values);
  }
  return cloud;
}

TEST_F(Ply, WhatIsWrittenReadsAsTheSameCloud) {
  writePointFile(someCloud(), at("a.ptc"));
  const PointFile file(at("a.ptc"));
  writePly(file, at("a.ply"));
  const PlyFigures figures = convertPly(at("a.ply"), at("b.ptc"), 7);
  const PointCloud a = file.readAll(), b = PointFile(at("b.ptc")).readAll();
  EXPECT_EQ(figures.points, 40'000u);
  EXPECT_EQ(a.channels, b.channels);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_EQ(a.data, b.data);
}

TEST_F(Ply, AsciiOfAnotherProgramKeepsItsColours) {
  const PointCloud cloud = read(
      "ply\r\nformat ascii 1.0\r\ncomment by hand\r\nelement camera 1\r\nproperty list uchar int names\r\nelement "
      "vertex 2\r\n"
      "property double x\r\nproperty double y\r\nproperty double z\r\nproperty uchar red\r\nproperty uchar green\r\n"
      "property uchar blue\r\nproperty float w\r\nend_header\r\n3 1 2 3\r\n1 2 3 255 51 0 9\r\n4 5 6 0 0 255 8\r\n",
      0.5f);
  ASSERT_EQ(cloud.count(), 2u);
  EXPECT_EQ(cloud.channels, (std::vector<CloudChannel>{{"Cs", 3}, {"w", 1}}));
  EXPECT_EQ(cloud.position[1], vec3(4, 5, 6));
  EXPECT_EQ(cloud.radius[0], 0.5f);
  EXPECT_EQ(cloud.normal[0], vec3(0));
  EXPECT_EQ(cloud.data, (std::vector<float>{1, 0.2f, 0, 9, 0, 0, 1, 8}));
}

TEST_F(Ply, AnyNumberOfElementsWithoutPropertiesIsSkippedAtOnce) {
  const PointCloud cloud = read(
      "ply\nformat ascii 1.0\nelement nothing 18446744073709551615\nelement vertex 1\nproperty float x\nproperty float "
      "y\nproperty float z\n"
      "end_header\n1 2 3\n");
  EXPECT_EQ(cloud.count(), 1u);
}

TEST_F(Ply, BigEndianNumbersAreTurned) {
  std::string text =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty short "
      "z\nend_header\n";
  text += std::string("\x3f\x80\x00\x00\xc0\x00\x00\x00\x01\x02", 10);
  EXPECT_EQ(read(text).position.at(0), vec3(1, -2, 258));
}

TEST_F(Ply, PointsWithoutAFinitePlaceAreDroppedAndCounted) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  const PlyFigures figures = convertPly(wrote(header + "0 0 0\nnan 0 0\n1 inf 1\n"), at("out.ptc"), 0);
  EXPECT_EQ(figures.points, 1u);
  EXPECT_EQ(figures.dropped, 2u);
}

TEST_F(Ply, AnyFlippedBitOfTheDataOfOurOwnFilesIsNoticed) {
  PointCloud cloud;
  cloud.channels = {{"power", 3}};
  const float power[] = {1, 2, 3};
  for (int i = 0; i < 4; ++i) cloud.add({static_cast<float>(i), 1, 2}, {0, 0, 1}, 0.5f, power);
  writePointFile(cloud, at("a.ptc"));
  writePly(PointFile(at("a.ptc")), at("a.ply"));
  std::ifstream in(at("a.ply"), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  for (size_t byte = whole.find("end_header\n") + 11; byte < whole.size(); ++byte) {
    std::string text = whole;
    text[byte] = static_cast<char>(text[byte] ^ (1 << byte % 8));
    EXPECT_THROW(convertPly(wrote(text), at("bad.ptc"), 0), FileError) << "byte " << byte;
  }
}

TEST_F(Ply, WhatIsDamagedIsNamedAndLeavesNoFile) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  const std::string bad[] = {"",
                             "hello",
                             "ply\n",
                             "ply\nformat ascii 1.0\n",
                             "ply\nelement vertex 0\nend_header\n",
                             "ply\nformat ascii 1.0\nelement face 0\nend_header\n",
                             "ply\nformat ascii 1.0\nproperty float x\nend_header\n",
                             "ply\nformat ascii 1.0\nelement vertex 1\nproperty quaternion x\nend_header\n0\n",
                             "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n",
                             "ply\nformat ascii 1.0\nelement vertex 1\nproperty list int float x\nend_header\n0\n",
                             header + "1 2 3 4 5",
                             header + "1 2 3 4 5 six",
                             header + "1 2 3 4 5 6 7",
                             header + "1 2 3 4 -1e30 6",
                             std::string(100'000, 'p')};
  for (const std::string& text : bad) {
    EXPECT_THROW(convertPly(wrote(text), at("bad.ptc"), 0), FileError) << text.substr(0, 80);
    EXPECT_FALSE(fs::exists(at("bad.ptc"))) << text.substr(0, 80);
  }
  EXPECT_THROW(convertPly(at("nowhere.ply"), at("bad.ptc"), 0), FileError);
}

}  // namespace
}  // namespace tomales
