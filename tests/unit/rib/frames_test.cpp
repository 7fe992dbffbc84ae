// Frames that are passed over, what in them would outlive them, and what Make requests read.
#include <fstream>

#include "rib_test_tools.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

std::string frame(int number, const std::string& world) {
  return "FrameBegin " + std::to_string(number) + "\n" + inWorld(world) + "FrameEnd\n";
}

TEST(SkippedFrames, AreCountedAndLeaveTheOthersAsTheyAre) {
  std::vector<int> asked, worlds;
  std::vector<size_t> objects;
  Log log(Log::Verbosity::Quiet);
  RibSettings settings;
  settings.onScene = [&](Scene&& s) { objects.push_back(s.objects.size()); };
  settings.skipsFrame = [&](int number) {
    asked.push_back(number);
    return number % 2 == 0;
  };
  settings.onSkipped = [&](int count) { worlds.push_back(count); };
  readRibText(frame(1, kSphere) + frame(2, "\"WorldBegin\" [1 2\n3] Sphere x") +
                  "FrameBegin 4 WorldBegin WorldEnd WorldBegin 1.5 [2 3] WorldEnd FrameEnd\n" +
                  frame(3, kSphere + kSphere) + "Nonsense\n",
              "test.rib", settings, log);
  EXPECT_EQ(asked, (std::vector<int>{1, 2, 4, 3}));
  EXPECT_EQ(worlds, (std::vector<int>{1, 2}));
  EXPECT_EQ(objects, (std::vector<size_t>{1, 2}));
  ASSERT_EQ(log.entries().size(), 1u);
  EXPECT_EQ(log.entries()[0].where.line, 21) << "lines count on in frames that are passed over";
}

TEST(SkippedFrames, EndWhereTheNextOneBeginsAndMayNotHoldTheWorldsOfArchives) {
  std::vector<std::string> outlive;
  Log log(Log::Verbosity::Quiet);
  int scenes = 0;
  RibSettings settings;
  settings.onScene = [&](Scene&&) { ++scenes; };
  settings.skipsFrame = [](int number) { return number == 1; };
  settings.onOutliving = [&](const Request& r) { outlive.push_back(r.name); };
  readRibText(
      "FrameBegin 1 WorldBegin FrameBegin 2\nDeclare \"a\" \"float\" ColorSamples [1 1 1] [1 1 1] "
      "ArchiveBegin \"w\" WorldBegin WorldEnd ArchiveEnd\nReadArchive \"w\" Option \"ribparse\" \"varsubst\" \"$\" "
      "Option \"limits\" \"bucketsize\" [16 16] System \"true\" Color [1]\n",
      "test.rib", settings, log);
  EXPECT_EQ(scenes, 1);
  EXPECT_EQ(outlive,
            (std::vector<std::string>{"Declare", "ColorSamples", "ArchiveBegin", "WorldBegin", "Option", "System"}));
}

TEST(MakeSources, AreThePicturesThatMakeRequestsReadButNoShadows) {
  const auto written = [](const std::string& name, const std::string& text) {
    std::ofstream(test::temporary(name)) << text;
    return test::temporary(name);
  };
  const std::string faces =
      "MakeCubeFaceEnvironment \"1.tif\" \"2.tif\" \"3.tif\" \"4.tif\" \"5.tif\" \"6.tif\" \"cube.tx\" 90 \"box\" 1 "
      "1\n";
  const std::string texture = "MakeTexture \"./a/../b.tif\" \"b.tx\" \"black\" \"black\" \"box\" 1 1\n";
  const std::string shadow = "MakeShadow \"z.tif\" \"z.shd\"\n", filler(100'000, ' ');
  const auto sources = [&](const std::string& text) { return makeSources({written("make.rib", text)}); };
  EXPECT_EQ(sources(texture + kSphere), (std::set<std::string>{"b.tif"}));
  EXPECT_EQ(sources(faces), (std::set<std::string>{"1.tif", "2.tif", "3.tif", "4.tif", "5.tif", "6.tif"}));
  EXPECT_EQ(sources(shadow + kSphere), std::set<std::string>{}) << "no file is parsed for shadows alone";
  EXPECT_EQ(sources(shadow + texture), (std::set<std::string>{"b.tif", "z.tif"}));
  for (size_t before = 65'520; before < 65'545; ++before)  // across the border of what is read at once
    EXPECT_EQ(sources(filler.substr(0, before) + texture), (std::set<std::string>{"b.tif"})) << before;
  EXPECT_EQ(
      makeSources({written("1.rib", texture), "/nowhere.rib", test::temporary(""), written("2.rib", faces)}).size(),
      7u);
}

TEST(MakeSources, AreFoundWithoutMessagesWhichTheReaderGives) {
  std::ofstream(test::temporary("faulty.rib"))
      << "MakeTexture \"b.tif\" \"b.tx\" \"black\" \"black\" \"box\" 1 1\nSphere 1\nNoSuchRequest 1\n";
  testing::internal::CaptureStderr();
  EXPECT_EQ(makeSources({test::temporary("faulty.rib")}), (std::set<std::string>{"b.tif"}));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(PlainParse, TellsOfFilesThatCannotBeReadOrHoldNothing) {
  struct : RiSink {
    void request(const Request& r) override { names += r.name + " "; }
    std::string names;
  } sink;
  Log log(Log::Verbosity::Quiet);
  EXPECT_FALSE(parseRib({"/nowhere.rib"}, sink, log));
  EXPECT_EQ(log.count("rib-open"), 1);
  EXPECT_FALSE(parseRibText("# nothing\n", "test.rib", sink, log));
  EXPECT_EQ(log.count("rib-empty"), 1);
  EXPECT_TRUE(parseRibText("Declare \"x\" \"float\" Sides 2", "test.rib", sink, log));
  EXPECT_EQ(sink.names, "Declare Sides ");
}

}  // namespace
}  // namespace tomales
