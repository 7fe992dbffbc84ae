#include "reyes/shade/texture.h"
#include "tests/unit/temporary.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

namespace tomales {
namespace {

namespace fs = std::filesystem;
using Texel = std::function<std::array<float, 3>(int x, int y)>;

class Pictures : public ::testing::Test {
 protected:
  Pictures()
      : folder(fs::path(test::temporary("")) /
               ("tomales_texture_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~Pictures() override { fs::remove_all(folder); }

  std::string write(const std::string& name, int size, const Texel& texel, int channels = 3) const {
    OIIO::ImageBuf picture(OIIO::ImageSpec(size, size, channels, OIIO::TypeDesc::FLOAT));
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) picture.setpixel(x, y, texel(x, y).data());
    const std::string path = (folder / name).string();
    EXPECT_TRUE(picture.write(path));
    return path;
  }
  Textures& textures() {
    if (!textures_)
      textures_ = std::make_unique<Textures>(TextureSettings{folder.string(), (folder / "cache").string()}, log, stats);
    return *textures_;
  }
  /// One point, over a square of that edge.
  std::array<float, 3> at(const std::string& name, float s, float t, float edge = 0,
                          const std::function<void(TextureQuery&)>& change = {}) {
    TextureQuery q;
    q.name = name.c_str();
    const uint8_t active = 1;
    const float zero = 0;
    q.count = 1;
    q.active = &active;
    q.s = &s;
    q.t = &t;
    q.su = &edge;
    q.tu = &zero;
    q.sv = &zero;
    q.tv = &edge;
    if (change) change(q);
    std::array<float, 3> out{-1, -1, -1};
    found = textures().lookup(q, {}, "test", {&out[0], &out[1], &out[2]});
    return out;
  }
  size_t filesInCache() const {
    size_t n = 0;
    if (fs::exists(folder / "cache"))
      for (const auto& entry : fs::recursive_directory_iterator(folder / "cache")) n += entry.is_regular_file();
    return n;
  }

  const fs::path folder;
  Log log{Log::Verbosity::Quiet};
  Stats stats;
  bool found = false;

 private:
  std::unique_ptr<Textures> textures_;
};

std::array<float, 3> checker(int x, int y) {
  const float v = (x + y) % 2 ? 1.0f : 0.0f;
  return {v, v, v};
}

TEST_F(Pictures, APlainPictureIsConvertedOnceByContentAndFoundAlongThePath) {
  write("a.tif", 64, checker);
  fs::copy(folder / "a.tif", folder / "b.tif");
  EXPECT_NEAR(at("a.tif", 0.5f, 0.5f, 0.5f)[0], 0.5f, 0.01f);
  EXPECT_EQ(filesInCache(), 1u);
  at("b.tif", 0.5f, 0.5f);
  EXPECT_EQ(filesInCache(), 1u) << "the same content has the same file";
  Textures again({folder.string(), (folder / "cache").string()}, log, stats);
  std::vector<float> numbers;
  std::string text;
  ASSERT_TRUE(again.info("a.tif", "resolution", numbers, text));
  EXPECT_EQ(numbers, (std::vector<float>{64, 64}));
  EXPECT_EQ(filesInCache(), 1u);
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(Pictures, AFootprintIsAveragedOverItsOwnShape) {
  // Stripes along t: what is long in t stays sharp, what is long in s is grey.
  const std::string stripes = write("stripes.tif", 128, [](int x, int) {
    return std::array<float, 3>{x / 8 % 2 ? 1.0f : 0.0f, 0, 0};
  });
  const float s = 76.0f / 128, wide = 0.25f, narrow = 1.0f / 128, zero = 0;
  const auto shaped = [&](const float* su, const float* tv) {
    return at(stripes, s, 0.5f, 0, [&](TextureQuery& q) {
      q.su = su;
      q.tu = &zero;
      q.sv = &zero;
      q.tv = tv;
    })[0];
  };
  EXPECT_GT(shaped(&narrow, &wide), 0.95f);
  EXPECT_NEAR(shaped(&wide, &narrow), 0.5f, 0.1f);
}

TEST_F(Pictures, WidthScalesBlurWidensAndZeroIsAPoint) {
  const std::string c = write("c.tif", 64, checker);
  const float s = 10.5f / 64, t = 10.5f / 64;
  EXPECT_NEAR(at(c, s, t, 0.25f)[0], 0.5f, 0.02f);
  EXPECT_EQ(at(c, s, t, 0.25f, [](TextureQuery& q) { q.sWidth = q.tWidth = 0; })[0], 0.0f);
  EXPECT_EQ(at(c, s + 1.0f / 64, t, 0.25f, [](TextureQuery& q) { q.sWidth = q.tWidth = 0; })[0], 1.0f);
  EXPECT_NEAR(at(c, s, t, 0, [](TextureQuery& q) { q.sBlur = q.tBlur = 0.25f; })[0], 0.5f, 0.02f);
}

TEST_F(Pictures, ChannelsCountFromTheFirstAndWhatIsMissingIsFilled) {
  const std::string c = write("c.tif", 16, [](int, int) { return std::array<float, 3>{0.1f, 0.2f, 0.3f}; });
  const auto from = [](int channel, int count, float fill) {
    return [=](TextureQuery& q) {
      q.channel = channel;
      q.channels = count;
      q.fill = fill;
    };
  };
  EXPECT_NEAR(at(c, 0.5f, 0.5f, 0, from(2, 1, 0))[0], 0.3f, 1e-6f);
  const auto two = at(c, 0.5f, 0.5f, 0, from(1, 3, 0.75f));
  EXPECT_NEAR(two[0], 0.2f, 1e-6f);
  EXPECT_NEAR(two[1], 0.3f, 1e-6f);
  EXPECT_NEAR(two[2], 0.75f, 1e-6f);
}

TEST_F(Pictures, OutsideIsBlackUnlessTheFileWraps) {
  const std::string white = write("white.tif", 16, [](int, int) { return std::array<float, 3>{1, 1, 1}; });
  EXPECT_EQ(at(white, 1.5f, 0.5f)[0], 0);
  std::string error;
  ASSERT_EQ(
      makeTexture({TextureRecipe::Shape::Picture, {white}, (folder / "w.tex").string(), "periodic", "clamp"}, error),
      Making::Done)
      << error;
  EXPECT_EQ(at("w.tex", 1.5f, 7)[0], 1);
  EXPECT_EQ(filesInCache(), 1u) << "w.tex serves as it is";
}

TEST_F(Pictures, TilesOfAMarkedNameAreChosenByWholeNumbersOfST) {
  write("t.1001.tif", 8, [](int, int) { return std::array<float, 3>{0.25f, 0, 0}; });
  write("t.1012.tif", 8, [](int, int) { return std::array<float, 3>{0.5f, 0, 0}; });
  for (const char* name : {"t.<UDIM>.tif", "t._MAPID_.tif"}) {
    EXPECT_EQ(at(name, 0.5f, 0.5f)[0], 0.25f);
    EXPECT_EQ(at(name, 1.5f, 1.5f)[0], 0.5f);
    EXPECT_EQ(at(name, 5.5f, 0.5f)[0], 0) << "no such tile: fill";
    EXPECT_TRUE(found);
  }
  EXPECT_TRUE(log.entries().empty());
}

TEST_F(Pictures, WhatIsMissingOrTruncatedIsMagentaAndReported) {
  EXPECT_EQ(at("absent.tif", 0.5f, 0.5f), (std::array<float, 3>{1, 0, 1}));
  EXPECT_FALSE(found);
  for (const std::string type : {".png", ".tif"}) {
    const std::string whole = write("whole" + type, 256, [](int x, int y) {
      return std::array<float, 3>{float(x * 7 % 11) / 11, float(y) / 256, 0};
    });
    std::ifstream in(whole, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), {});
    std::ofstream(folder / ("cut" + type), std::ios::binary) << bytes.substr(0, bytes.size() / 2);
    EXPECT_EQ(at(("cut" + type).c_str(), 0.5f, 0.9f), (std::array<float, 3>{1, 0, 1})) << type;
    EXPECT_NE(log.entries().back().message.find("cut" + type), std::string::npos);
  }
  EXPECT_EQ(log.worst(), Severity::Missing);
  EXPECT_EQ(filesInCache(), 0u);
}

TEST_F(Pictures, AConversionThatFailsLeavesNoFile) {
  std::string error;
  EXPECT_EQ(makeTexture({TextureRecipe::Shape::Picture, {"absent.tif"}, (folder / "x.tex").string()}, error),
            Making::Unreadable);
  EXPECT_FALSE(error.empty());
  const std::string c = write("c.tif", 16, checker);
  error.clear();
  EXPECT_EQ(makeTexture({TextureRecipe::Shape::Picture, {c}, (folder / "no" / "x.tex").string()}, error),
            Making::Unwritable);
  EXPECT_FALSE(error.empty());
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

// Each face shows its own direction at its centre; between centres the picture is continuous.
TEST_F(Pictures, ACubeBecomesTheSurroundingsThatItShows) {
  const float forward[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const float right[6][3] = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}};
  const float down[6][3] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
  TextureRecipe recipe;
  recipe.shape = TextureRecipe::Shape::Cube;
  recipe.file = (folder / "sky.env").string();
  recipe.sWrap = "periodic";
  recipe.tWrap = "clamp";
  constexpr int n = 64;
  for (int f = 0; f < 6; ++f)
    recipe.pictures.push_back(write("face" + std::to_string(f) + ".exr", n, [&](int x, int y) {
      const float a = 2 * (float(x) + 0.5f) / n - 1, b = 2 * (float(y) + 0.5f) / n - 1;
      float d[3], length = 0;
      for (int k = 0; k < 3; ++k) {
        d[k] = forward[f][k] + a * right[f][k] + b * down[f][k];
        length += d[k] * d[k];
      }
      return std::array<float, 3>{1 + d[0] / std::sqrt(length), 1 + d[1] / std::sqrt(length),
                                  1 + d[2] / std::sqrt(length)};
    }));
  std::string error;
  ASSERT_EQ(makeTexture(recipe, error), Making::Done) << error;
  for (int k = 0; k < 200; ++k) {
    const float s = std::fmod(0.618034f * float(k), 1.0f), t = 0.02f + 0.96f * float(k) / 200;
    const auto c = at("sky.env", s, t, 0, [](TextureQuery& q) { q.latlong = true; });
    const float theta = float(M_PI) * t, phi = 2 * float(M_PI) * s;
    EXPECT_NEAR(c[0], 1 + std::sin(theta) * std::cos(phi), 0.03f);
    EXPECT_NEAR(c[1], 1 + std::sin(theta) * std::sin(phi), 0.03f);
    EXPECT_NEAR(c[2], 1 + std::cos(theta), 0.03f);
  }
}

TEST_F(Pictures, InformationIsThatOfThePicture) {
  write("c.tif", 32, checker);
  std::vector<float> numbers;
  std::string text;
  EXPECT_TRUE(textures().info("c.tif", "channels", numbers, text));
  EXPECT_EQ(numbers, std::vector<float>{3});
  EXPECT_TRUE(textures().info("c.tif", "type", numbers, text));
  EXPECT_EQ(text, "texture");
  EXPECT_TRUE(textures().info("absent.tif", "exists", numbers, text));
  EXPECT_EQ(numbers, std::vector<float>{0});
  EXPECT_FALSE(textures().info("absent.tif", "resolution", numbers, text));
  EXPECT_FALSE(textures().info("c.tif", "weight", numbers, text));
}

}  // namespace
}  // namespace tomales
