#include "reyes/dfb.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// A frame of 4 x 2 pixels in two buckets; the first sees one facet.
Shot smallShot() {
  Shot shot;
  Options& o = shot.scene.options;
  o.xResolution = 4;
  o.yResolution = 2;
  o.frame = 7;
  o.screenWindow = {-1.0f, 1.0f, -0.5f, 0.5f};
  o.searchPaths["texture"] = "here:there";
  auto attributes = std::make_shared<Attributes>();
  attributes->name = "ball";
  attributes->color = {0.1f, 0.2f, 0.3f};
  attributes->trace.bias = 0.25f;
  attributes->surface = std::make_shared<ShaderCall>(
      ShaderCall{"plastic", {{"Ks", Storage::Uniform, ValueType::Float, 1, {0.5f}, {}, {}}}, {}, {}});
  Object object;
  object.attributes = attributes;
  object.where = {std::make_shared<std::string>("a.rib"), 12};
  object.group = 0;
  shot.scene.objects.push_back(object);
  shot.scene.objects.push_back(object);
  attributes->membership = {"toys"};
  shot.scene.groups.push_back({attributes, mat4(2.0f), {{"s", Storage::Vertex, ValueType::Float, 1, {}}}, 1});
  shot.scene.lights = {std::make_shared<LightCall>(LightCall{{"pointlight", {}, {}, {}}, "key", false, true, 0})};
  shot.scene.worldFromNamed["table"] = mat4(3.0f);
  shot.scene.worldFromOpenings = {mat4(4.0f)};
  shot.frame.crop = shot.frame.padded = {0, 0, 4, 2};
  shot.frame.bucketWidth = shot.frame.bucketHeight = 2;
  shot.frame.columns = 2;
  shot.frame.rows = 1;
  shot.seed = 5;
  shot.sources = {{"/a.rib", 99}};
  shot.folder = "/tmp";
  shot.world = 2;
  return shot;
}

DeepTile smallTile(const DeepFrame& frame, size_t index) {
  DeepTile tile{frame.rectOf(index), {}, {}, {}, {}, {}, {}};
  tile.pixels.resize(4);
  if (index > 0) return tile;
  ShadePoints points(0, 1);
  points.add({1234, 5});
  points.set3(kPx, 0, {1, 2, 3});
  points.primvar(0)[0] = 0.75f;
  tile.batches.push_back(points);
  tile.facets.push_back({0, {0, 0, 0, 0}, true});
  tile.fragments.push_back({0, 2.5f, 0xf0, 1, 10, 20});
  tile.pixels[2] = {0, 1};
  return tile;
}

class Dfb : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              (std::string("tomales_dfb_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
               std::to_string(::getpid()));
    fs::create_directories(folder_);
    path_ = (folder_ / "shot.dfb").string();
  }
  void TearDown() override { fs::remove_all(folder_); }

  void writeShot() {
    const Shot shot = smallShot();
    const auto writer = DfbWriter::create(path_, shot, Unfinished::Kept, error_);
    ASSERT_TRUE(writer) << error_;
    for (const size_t i : {1u, 0u}) ASSERT_TRUE(writer->write(i, smallTile(shot.frame, i)));
    ASSERT_TRUE(writer->finish());
  }
  bool readsWhole() {
    const auto file = DfbFile::open(path_, error_);
    return file && file->tile(0, error_) && file->tile(1, error_);
  }
  fs::path folder_;
  std::string path_, error_;
};

TEST_F(Dfb, HoldsWhatShadingNeedsOfTheScene) {
  writeShot();
  const auto file = DfbFile::open(path_, error_);
  ASSERT_TRUE(file) << error_;
  const Shot& s = file->shot();
  EXPECT_EQ(s.scene.options.frame, 7);
  EXPECT_EQ(s.scene.options.screenWindow->at(2), -0.5f);
  EXPECT_EQ(s.scene.options.searchPaths.at("texture"), "here:there");
  ASSERT_EQ(s.scene.groups.size(), 1u);
  const Attributes& a = *s.scene.groups[0].attributes;
  EXPECT_EQ(a.name, "ball");
  EXPECT_EQ(a.trace.bias, 0.25f);
  EXPECT_EQ(*a.surface, *smallShot().scene.groups[0].attributes->surface);
  EXPECT_EQ(s.scene.groups[0].cameraFromObject, mat4(2.0f));
  EXPECT_EQ(s.scene.groups[0].primvars.at(0).name, "s");
  EXPECT_TRUE(s.scene.groups[0].attributes->membership.contains("toys"));
  ASSERT_EQ(s.scene.objects.size(), 1u);
  EXPECT_EQ(objectName(s.scene.objects[0]), objectName(smallShot().scene.objects[1]));
  EXPECT_FALSE(hasGeometry(s.scene));
  EXPECT_TRUE(s.scene.lights.at(0)->castsShadows);
  EXPECT_EQ(s.scene.worldFromNamed.at("table"), mat4(3.0f));
  EXPECT_EQ(s.scene.worldFromOpenings, std::vector<mat4>{mat4(4.0f)});
  EXPECT_EQ(s.seed, 5u);
  EXPECT_EQ(s.sources, smallShot().sources);
  EXPECT_EQ(s.world, 2);
  EXPECT_EQ(s.frame.rectOf(1).x0, 2);
}

TEST_F(Dfb, HoldsTilesBitForBit) {
  writeShot();
  const auto file = DfbFile::open(path_, error_);
  ASSERT_TRUE(file) << error_;
  const auto tile = file->tile(0, error_);
  ASSERT_TRUE(tile) << error_;
  const DeepTile expected = smallTile(smallShot().frame, 0);
  EXPECT_EQ(tile->rect.x1, 2);
  ASSERT_EQ(tile->batches.size(), 1u);
  const ShadePoints& points = tile->batches[0];
  EXPECT_EQ(points.key(0), 1234u);
  EXPECT_EQ(points.name(0).sequence, 5u);
  EXPECT_EQ(points.position(0), vec3(1, 2, 3));
  EXPECT_EQ(points.primvar(0)[0], 0.75f);
  EXPECT_TRUE(tile->facets.at(0).matte);
  const Fragment &f = tile->fragments.at(0), &e = expected.fragments[0];
  EXPECT_TRUE(f.facet == e.facet && f.z == e.z && f.samples == e.samples && f.word == e.word && f.u == e.u &&
              f.v == e.v);
  EXPECT_EQ(tile->pixel(0, 1).count, 1u);
  EXPECT_TRUE(file->tile(1, error_)->batches.empty());
}

TEST_F(Dfb, NoticesEveryFlippedByte) {
  writeShot();
  std::ifstream in(path_, std::ios::binary);
  const std::string good{std::istreambuf_iterator<char>(in), {}};
  for (size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(~bad[i]);
    std::ofstream(path_, std::ios::binary) << bad;
    error_.clear();
    EXPECT_FALSE(readsWhole()) << "byte " << i;
    EXPECT_FALSE(error_.empty()) << "byte " << i;
  }
}

TEST_F(Dfb, ResumesOnlyTheSameShot) {
  Shot shot = smallShot();
  DfbWriter::create(path_, shot, Unfinished::Kept, error_)->write(0, smallTile(shot.frame, 0));
  EXPECT_EQ(DfbWriter::create(path_, shot, Unfinished::Resumed, error_)->tilesKept(), 1u);
  shot.scene.options.fov_degrees = 30;
  EXPECT_EQ(DfbWriter::create(path_, shot, Unfinished::Resumed, error_)->tilesKept(), 0u);
}

}  // namespace
}  // namespace tomales
