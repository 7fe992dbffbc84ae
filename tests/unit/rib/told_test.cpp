// Requests at the wrong place or with nothing to do, and what is said of them.
#include <filesystem>
#include <fstream>

#include "rib_test_tools.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

/// The message of that code in a stream.
std::string said(const std::string& text, const std::string& code) { return Reading(text).message(code).message; }
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Told, FramesAndWorldsThatBeginBeforeTheLastHasEnded) {
  const Reading frames("FrameBegin 1 WorldBegin " + kSphere + "WorldEnd\nFrameBegin 2 WorldBegin WorldEnd FrameEnd");
  ASSERT_EQ(frames.scenes.size(), 2u);
  EXPECT_EQ(frames.scenes[0].options.frame, 1);
  EXPECT_EQ(frames.scenes[1].options.frame, 2);
  EXPECT_EQ(frames.codes(), "") << "the second frame ends the first";
  const Reading world("WorldBegin " + kSphere + "FrameBegin 2 WorldBegin " + kSphere + kSphere + "WorldEnd FrameEnd");
  ASSERT_EQ(world.scenes.size(), 2u);
  EXPECT_EQ(world.scenes[0].objects.size(), 1u);
  EXPECT_EQ(world.scenes[1].objects.size(), 2u);
  EXPECT_EQ(world.told("rib-unbalanced"), 1);
}

TEST(Told, GeometryOutsideOfTheWorld) {
  const Reading r(kSphere + kSphere + inWorld(kSphere));
  EXPECT_EQ(r.scene().objects.size(), 1u);
  EXPECT_EQ(r.codes(), "rib-outside-world@1 ");
}

TEST(Told, NamesOfLightsAndSpacesThatThereAreNot) {
  EXPECT_TRUE(has(said(inWorld("Illuminate \"key\" 1"), "rib-unknown-light"), "no light has the handle \"key\""));
  EXPECT_TRUE(has(said(inWorld("CoordSysTransform \"attic\""), "rib-unknown-space"), "\"attic\""));
  EXPECT_EQ(Reading(inWorld("CoordinateSystem \"attic\" CoordSysTransform \"attic\"")).codes(), "");
}

TEST(Told, MotionsOfWhatDoesNotMoveAndThoseWithoutEnd) {
  const Reading still(inWorld("MotionBegin [0 1] Color [1 0 0] Color [0 1 0] MotionEnd " + kSphere));
  EXPECT_EQ(still.attributes(0).color, vec3(1, 0, 0));
  EXPECT_TRUE(has(still.message("rib-motion").message, "does not move; its first value is used"));
  const Reading open(inWorld("") + "MotionBegin [0 1] Translate 0 0 0 Translate 1 0 0");
  EXPECT_TRUE(has(open.message("rib-unbalanced").message, "MotionEnd is missing")) << open.codes();
}

TEST(Told, RequestsOfPRManThatHaveNoEffectHere) {
  const Reading r("VolumePixelSamples 2 2 PixelSampleImager \"vignette\" \"float amount\" 1 " + inWorld(kSphere));
  EXPECT_EQ(r.codes(), "rib-unsupported@1 rib-unsupported@1 ");
  EXPECT_EQ(r.log.worst(), Severity::Warning);
}

TEST(Told, AnErrorHandlerThatDoesNotPrint) {
  EXPECT_EQ(Reading("ErrorHandler \"print\"" + inWorld("")).codes(), "");
  EXPECT_EQ(Reading("ErrorHandler \"abort\" ErrorHandler \"ignore\"" + inWorld("")).codes(), "rib-unsupported@1 ");
}

TEST(Told, ProceduralsThatNameNothing) {
  const std::string bound = " [-1 1 -1 1 -1 1]\n";
  for (const auto& [kind, what] :
       {std::pair{"RunProgram", "program"}, {"DynamicLoad", "plugin"}, {"DelayedReadArchive", "file"}})
    EXPECT_TRUE(has(said(inWorld("Procedural \"" + std::string(kind) + "\" [\"\" \"\"]" + bound), "rib-unsupported"),
                    std::string("names no ") + what))
        << kind;
  const Reading r(inWorld("ArchiveBegin \"a\" " + kSphere + "ArchiveEnd\n" +
                          "Procedural2 \"DelayedReadArchive2\" \"LooseBound\" \"string filename\" [\"a\"]\n"));
  EXPECT_TRUE(has(r.message("rib-bound").message, "\"LooseBound\" is not supported: it is read without a bound"));
  EXPECT_EQ(r.scene().objects.size(), 1u);
}

TEST(Told, ArchivesThatLieElsewhereHoldNothingOrAreTooDeep) {
  const std::string folder = test::temporary("told_archives");
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/ball.rib") << kSphere;
  std::ofstream(folder + "/empty.rib") << "# nothing\n";
  const Reading r(inWorld("ReadArchive \"gone/ball.rib\"\nReadArchive \"empty.rib\"\nReadArchive \"ball.rib\""),
                  {folder});
  EXPECT_EQ(r.scene().objects.size(), 2u);
  EXPECT_EQ(r.codes(), "rib-elsewhere@2 rib-empty@3 ");
  EXPECT_EQ(r.message("rib-elsewhere").message,
            "ReadArchive: \"gone/ball.rib\" is not there; " + folder + "/ball.rib is read, which has its name");
  Log log(Log::Verbosity::Quiet);
  size_t objects = 0;
  RibSettings settings;
  settings.maxArchiveDepth = 2;
  settings.onScene = [&](Scene&& s) { objects = s.objects.size(); };
  std::string nested = "ArchiveBegin \"0\" " + kSphere + "ArchiveEnd ";
  for (int i = 1; i < 5; ++i)
    nested += "ArchiveBegin \"" + std::to_string(i) + "\" " + kSphere + "ReadArchive \"" + std::to_string(i - 1) +
              "\" ArchiveEnd ";
  readRibText(inWorld(nested + "ReadArchive \"4\""), "test.rib", settings, log);
  EXPECT_EQ(objects, 2u);
  EXPECT_TRUE(has(log.entries().at(0).message, "more than 2 archives within archives; ignored"));
}

TEST(ByteStream, TakesWhatLooksLikeGzipAfterItsBeginningAsItIs) {
  const std::vector<std::string> parts = {"Color", "\x1f\x8b\x08", "end"};
  size_t next = 0;
  const auto stream = rib::ByteStream::fromProgram([&](char* to, size_t) {
    if (next == parts.size()) return size_t{0};
    parts[next].copy(to, parts[next].size());
    return parts[next++].size();
  });
  std::string text;
  while (stream->peek() != rib::ByteStream::kEnd) {
    text.append(stream->begin(), stream->end());
    stream->skipTo(stream->end());
  }
  EXPECT_EQ(text, parts[0] + parts[1] + parts[2]);
}

TEST(RibWriter, KeepsReturnsQuotesAndBackslashesInStrings) {
  const std::string text = "a\r\nb\"c\\d";
  std::string written;
  {
    const auto writer = makeRibWriter({.write = [&](std::string_view more) { written += more; }});
    Request r{"Shader", {}, {}, {}};
    r.name = "ReadArchive";
    r.args.push_back({RibArg::Kind::String, {}, {text}});
    writer->request(r);
  }
  const Requests back(written);
  ASSERT_EQ(back.list.size(), 1u);
  EXPECT_EQ(back.list[0].args[0].strings[0], text);
}

}  // namespace
}  // namespace tomales
