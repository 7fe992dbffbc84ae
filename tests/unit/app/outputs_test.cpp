#include "reyes/app/frame/outputs.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "reyes/output.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

Options displaysOf(const std::vector<std::pair<std::string, std::string>>& namesAndTypes) {
  Options out;
  for (const auto& [name, type] : namesAndTypes) {
    out.displays.emplace_back();
    out.displays.back().name = name;
    out.displays.back().type = type;
  }
  return out;
}

std::vector<std::string> namesIn(const Options& options) {
  std::vector<std::string> out;
  for (const DisplayCall& d : options.displays) out.push_back(d.name);
  return out;
}

TEST(Outputs, TakeTheNameOfTheCommandLineAndStandBesideIt) {
  Options o =
      displaysOf({{"maps/lamp.z", "shadow"}, {"m.exr", "file"}, {"m_id.exr", "openexr"}, {"passes/z.tif", "tiff"}});
  RenderSettings settings;
  settings.picture.output = "shots/look.##.png";
  o.frame = 5;
  Log log(Log::Verbosity::Quiet);
  nameOutputs(o, settings, log);
  EXPECT_EQ(namesIn(o), (std::vector<std::string>{"maps/lamp.z", "shots/look.05.png", "shots/look.05_id.exr",
                                                  "shots/look.05_z.tif"}));
  EXPECT_EQ(o.displays[1].mode, "rgb") << "a picture for screens has no alpha";
  EXPECT_EQ(o.displays[2].type, "openexr");
}

TEST(Outputs, OfOnePictureKeepTheMapsThatLaterFramesRead) {
  Options o = displaysOf({{"m.exr", "file"}, {"lamp.z", "shadow"}, {"z.exr", "file"}});
  RenderSettings settings;
  settings.picture.output = "look.exr";
  settings.picture.onePicture = true;
  Log log(Log::Verbosity::Quiet);
  nameOutputs(o, settings, log);
  EXPECT_EQ(namesIn(o), (std::vector<std::string>{"look.exr", "lamp.z"}));
}

TEST(Outputs, ThatMakeRequestsReadKeepTheirNames) {
  Options o = displaysOf({{"./face.tif", "tiff"}, {"m.exr", "file"}});
  RenderSettings settings;
  settings.picture.output = "look.exr";
  settings.input.sources = {"face.tif"};
  Log log(Log::Verbosity::Quiet);
  nameOutputs(o, settings, log);
  EXPECT_EQ(namesIn(o), (std::vector<std::string>{"./face.tif", "look.exr"}));
  EXPECT_TRUE(writesMapsAlone(displaysOf({{"face.tif", "tiff"}}), settings));
}

TEST(Outputs, OfASceneWithoutDisplayAreTheDefaultOne) {
  Options o;
  Log log(Log::Verbosity::Quiet);
  nameOutputs(o, {}, log);
  EXPECT_EQ(o.displays.size(), 1u);
}

TEST(Outputs, NeverWriteOverAnotherOfTheirFrame) {
  Options o = displaysOf({{"a.tif", "file"}, {"a.tif", "framebuffer"}, {"b.exr", "openexr"}});
  Log log(Log::Verbosity::Quiet);
  nameOutputs(o, {}, log);
  EXPECT_EQ(namesIn(o), (std::vector<std::string>{"a.tif", "b.exr"}));
  EXPECT_EQ(log.count("display-window"), 1);

  Options window = displaysOf({{"w", "framebuffer"}});
  nameOutputs(window, {}, log);
  EXPECT_EQ(window.displays.size(), 1u) << "else there would be no picture at all";
}

TEST(Outputs, OfOneFileByAnyNameAreFoundToBeOne) {
  const fs::path folder = fs::path(testing::TempDir()) / "outputs_of_one_file";
  fs::remove_all(folder);
  fs::create_directories(folder / "real");
  fs::create_directory_symlink(folder / "real", folder / "linked");
  fs::create_symlink("a.exr", folder / "real/link.exr");
  const std::string in = folder.string();
  const std::string a = in + "/real/a.exr";
  for (const auto& [name, type] :
       std::vector<std::pair<std::string, std::string>>{{a, "zfile"},
                                                        {in + "/./real/../real/a", "file"},
                                                        {in + "/linked/a.exr", "openexr"},
                                                        {in + "/real/link.exr", "file"},
                                                        {fs::relative(a).string(), "tiff"}}) {
    Options o = displaysOf({{a, "openexr"}, {name, type}, {a + "2", "null"}, {a + "2", "null"}});
    Log log(Log::Verbosity::Quiet);
    nameOutputs(o, {}, log);
    EXPECT_EQ(o.displays.size(), 3u) << name;
    EXPECT_EQ(log.count("display-twice"), 1) << name;
  }
  fs::remove_all(folder);
}

TEST(Outputs, ThatTheUserNamesComeBeforeOthersOfThatNameWithoutAWarning) {
  Options o = displaysOf({{"box.exr", "openexr"}, {"box.png", "png"}});
  Log log(Log::Verbosity::Quiet);
  RenderSettings settings;
  settings.picture.output = "look.png";
  nameOutputs(o, settings, log);
  ASSERT_EQ(o.displays.size(), 1u);
  EXPECT_EQ(o.displays[0].name, "look.png");
  EXPECT_EQ(log.count("display-twice"), 1);
  EXPECT_EQ(log.worst(), Severity::Note);
}

TEST(Outputs, AreMapsAloneWhereEveryDisplayIsOne) {
  EXPECT_TRUE(writesMapsAlone(displaysOf({{"a.z", "shadow"}, {"b.z", "zfile"}}), {}));
  EXPECT_FALSE(writesMapsAlone(displaysOf({{"a.z", "shadow"}, {"b.exr", "file"}}), {}));
  EXPECT_FALSE(writesMapsAlone({}, {})) << "a frame without Displays writes the default picture";
}

}  // namespace
}  // namespace tomales
