#include "reyes/app/frame/outputs.h"

#include <gtest/gtest.h>

#include "reyes/output.h"

namespace tomales {
namespace {

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
  Options o =
      displaysOf({{"a.tif", "file"}, {"a.tif", "framebuffer"}, {"./a.tif", "tiff"}, {"b", "openexr"}, {"b", "zfile"}});
  Log log(Log::Verbosity::Quiet);
  nameOutputs(o, {}, log);
  ASSERT_EQ(o.displays.size(), 3u);
  EXPECT_EQ(o.displays[1].type, "openexr");
  EXPECT_EQ(log.count("display-window"), 1);
  EXPECT_EQ(log.count("display-twice"), 1);

  Options window = displaysOf({{"w", "framebuffer"}});
  nameOutputs(window, {}, log);
  EXPECT_EQ(window.displays.size(), 1u) << "else there would be no picture at all";
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
