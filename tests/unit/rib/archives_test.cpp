// Inline archives, procedurals and programs.

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "reyes/base/parallel.h"
#include "rib_test_tools.h"

namespace tomales {
namespace {

/// As Reading, but programs are allowed and must answer at once.
struct Trusting {
  std::vector<Scene> scenes;
  Log log{Log::Verbosity::Quiet};
  explicit Trusting(const std::string& text) {
    RibSettings settings;
    settings.trust.programs = true;
    settings.programPatience_s = 2;
    settings.onScene = [this](Scene&& s) { scenes.push_back(opened(std::move(s))); };
    readRibText(text, "test.rib", settings, log);
  }
  size_t objects() const { return scenes.at(0).objects.size(); }
};

TEST(InlineArchive, IsReadWhereItIsCalledAndNotWhereItStands) {
  const Reading r(
      inWorld("ArchiveBegin \"a\" Translate 1 0 0 " + kSphere + "ArchiveEnd\nReadArchive \"a\" ReadArchive \"a\""));
  ASSERT_EQ(r.scene().objects.size(), 2u);
  EXPECT_EQ(r.object(1).worldFromObject.at(0)[3].x, 2);
  EXPECT_TRUE(r.log.entries().empty()) << r.codes();
}

TEST(InlineArchive, MayHoldArchivesAndBeRedefined) {
  const Reading r(inWorld("ArchiveBegin \"a\" ArchiveBegin \"b\" " + kSphere +
                          "ArchiveEnd ReadArchive \"b\" ArchiveEnd "
                          "ReadArchive \"a\" ReadArchive \"b\" ArchiveBegin \"a\" ArchiveEnd ReadArchive \"a\""));
  EXPECT_EQ(r.scene().objects.size(), 2u);
}

TEST(InlineArchive, NeitherReadsItselfNorDoublesWithoutEnd) {
  const Reading self(inWorld("ArchiveBegin \"a\" " + kSphere + "ReadArchive \"a\" ArchiveEnd ReadArchive \"a\""));
  EXPECT_EQ(self.scene().objects.size(), 1u);
  EXPECT_EQ(self.log.count("rib-archive-recursion"), 1);
  std::string text = "ArchiveBegin \"0\" ArchiveEnd\n";
  for (int i = 1; i < 60; ++i) {
    const std::string below = "ReadArchive \"" + std::to_string(i - 1) + "\" ";
    text += "ArchiveBegin \"" + std::to_string(i) + "\" " + below + below + "ArchiveEnd\n";
  }
  const Reading bomb(inWorld(text + "ReadArchive \"59\"\n" + kSphere));
  EXPECT_EQ(bomb.scene().objects.size(), 1u);
  EXPECT_GE(bomb.log.count("rib-archive-recursion"), 1);
}

TEST(InlineArchive, WithoutEndIsReported) {
  const Reading r(inWorld(kSphere) + "ArchiveBegin \"a\" " + kSphere);
  EXPECT_EQ(r.message("rib-unbalanced").where.line, 5);
  EXPECT_EQ(Reading("ArchiveEnd").log.count("rib-unbalanced"), 1);
}

TEST(Procedural, OfAnArchiveThatHasBeenReadToItsEndIsNoRecursion) {
  const std::string bound = "[-1 1 -1 1 -1 1]\n";
  const Reading r(inWorld("ArchiveBegin \"b\" " + kSphere + "ArchiveEnd ArchiveBegin \"a\" " +
                          "Procedural \"DelayedReadArchive\" [\"b\"] " + bound +
                          "ArchiveEnd\nReadArchive \"a\"\nProcedural \"DelayedReadArchive\" [\"a\"] " + bound));
  EXPECT_EQ(r.scene().objects.size(), 2u);
  EXPECT_TRUE(r.log.entries().empty()) << r.codes();
}

TEST(Procedural, DelayedReadArchiveKeepsItsStateToItself) {
  const Reading r(inWorld("ArchiveBegin \"a\" Translate 1 0 0 Color 1 0 0 " + kSphere +
                          "ArchiveEnd Translate 0 5 0\n"
                          "Procedural \"DelayedReadArchive\" [\"a\"] [-1 1 -1 1 -1 1]\n"
                          "Procedural2 \"DelayedReadArchive2\" \"SimpleBound\" \"string filename\" [\"a\"] "
                          "\"float[6] bound\" [-1 1 -1 1 -1 1]\n" +
                          kSphere));
  ASSERT_EQ(r.scene().objects.size(), 3u);  // what is opened comes last
  EXPECT_EQ(r.attributes(0).color, vec3(1));
  EXPECT_EQ(r.object(1).worldFromObject.at(0)[3], vec4(1, 5, 0, 1));
  EXPECT_EQ(r.object(2).worldFromObject.at(0)[3], vec4(1, 5, 0, 1));
  EXPECT_TRUE(r.log.entries().empty()) << r.codes();
}

TEST(Procedural, BoundsThatAreNoBoxAndUnknownKindsAreReported) {
  const Reading r(inWorld("ArchiveBegin \"a\" " + kSphere +
                          "ArchiveEnd\n"
                          "Procedural \"DelayedReadArchive\" [\"a\"] [nan 1 -1 1 -1 1]\nProcedural "
                          "\"DynamicLode\" [\"x\"] [0 1 0 1 0 1]"));
  EXPECT_EQ(r.scene().objects.size(), 1u);
  EXPECT_EQ(r.message("rib-bound").where.line, 4);
  EXPECT_EQ(r.message("rib-unsupported").severity, Severity::Missing);
}

TEST(Procedural, SeesTheStreamAsItWasWhereItStands) {
  const Reading r(
      inWorld("ArchiveBegin \"a\" Sphere 2 -2 2 360 ArchiveEnd Declare \"k\" \"constant float\"\n"
              "Procedural \"DelayedReadArchive\" [\"a\"] [-1 1 -1 1 -1 1]\n"
              "ArchiveBegin \"a\" Cone 1 1 360 Cone 1 1 360 ArchiveEnd\n"
              "Procedural \"DelayedReadArchive\" [\"a\"] [-1 1 -1 1 -1 1]\n"));
  ASSERT_EQ(r.scene().objects.size(), 3u);
  EXPECT_NEAR(r.object(0).shape().bound(0, {}).hi.z, 2, 1e-5);
}

TEST(Procedural, ThatReadsItselfOrDoublesWithoutEndEnds) {
  const std::string bound = "[-1 1 -1 1 -1 1]\n";
  const Reading self(inWorld("ArchiveBegin \"a\" " + kSphere + "Procedural \"DelayedReadArchive\" [\"a\"] " + bound +
                             "ArchiveEnd Procedural \"DelayedReadArchive\" [\"a\"] " + bound));
  EXPECT_EQ(self.scene().objects.size(), 1u);
  EXPECT_EQ(self.log.count("rib-archive-recursion"), 1);
}

TEST(Procedural, LightsAndWorldsInsideAreRefused) {
  const Reading r(inWorld("ArchiveBegin \"a\" LightSource \"pointlight\" 1 WorldEnd WorldBegin " + kSphere +
                          "ArchiveEnd Procedural \"DelayedReadArchive\" [\"a\"] [-1 1 -1 1 -1 1]\n"));
  EXPECT_EQ(r.scene().objects.size(), 1u);
  EXPECT_TRUE(r.scene().lights.empty());
  EXPECT_EQ(r.log.count("rib-procedural-light"), 1);
  EXPECT_EQ(r.log.count("rib-unbalanced"), 2);
}

TEST(RunProgram, IsStartedOnceForManyCalls) {
  const std::string starts = testing::TempDir() + "tomales_starts";
  const std::string call = "Procedural2 \"RunProgram2\" \"SimpleBound\" \"string programname\" [\"echo >> " + starts +
                           "; while read detail radius; do echo Sphere $radius -1 1 360; printf '\\\\377'; done\" ] "
                           "\"string data\" [\"";
  std::string text;
  for (int i = 1; i <= 5; ++i) text += call + std::to_string(i) + "\"] \"float[6] bound\" [0 1 0 1 0 1]\n";
  {
    std::vector<Scene> scenes;
    Log log(Log::Verbosity::Quiet);
    RibSettings settings;
    settings.trust.programs = true;
    settings.programPatience_s = 10;
    settings.onScene = [&](Scene&& s) {
      const ThreadLimit one(1);
      scenes.push_back(opened(std::move(s)));
    };
    readRibText(inWorld(text), "test.rib", settings, log);
    ASSERT_EQ(scenes.at(0).objects.size(), 5u) << (log.entries().empty() ? "" : log.entries()[0].message);
    EXPECT_TRUE(log.entries().empty());
  }
  std::ifstream file(starts);
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>(), '\n'), 1);
  std::filesystem::remove(starts);
}

TEST(RunProgram, IsNotRunUnlessAllowed) {
  const std::string file = testing::TempDir() + "tomales_must_not_exist";
  const Reading r(inWorld("Procedural \"RunProgram\" [\"touch " + file + "\" \"\"] [0 1 0 1 0 1]\nSystem \"touch " +
                          file + "\"\n" + kSphere));
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_EQ(r.log.count("rib-system"), 2);
  EXPECT_EQ(r.log.worst(), Severity::Missing);
  EXPECT_EQ(r.scene().objects.size(), 1u);
}

TEST(RunProgram, GetsDetailAndDataAndEndsWithItsMark) {
  const Trusting r(
      inWorld("Procedural \"RunProgram\" [\"read detail radius; echo \\\"Sphere $radius -1 1 360\\\"; printf "
              "'\\\\377Sphere 1 -1 1 360'; sleep 100\" "
              "\"2.5\"] [-1 1 -1 1 -1 1]\n" +
              kSphere));
  EXPECT_EQ(r.objects(), 2u);
  EXPECT_TRUE(r.log.entries().empty()) << r.log.entries()[0].message;
}

TEST(RunProgram, ThatHangsDiesOrIsAbsentIsReported) {
  const std::pair<const char*, const char*> rows[] = {{"sleep 100", "did not answer in time and was killed"},
                                                      {"exit 3", "failed with exit code 3"},
                                                      {"kill -9 $$", "died of signal 9"},
                                                      {"no_such_program_of_tomales", "does not exist"},
                                                      {"true", "wrote no request"}};
  for (const auto& [command, trouble] : rows) {
    const Trusting r(
        inWorld("\nProcedural \"RunProgram\" [\"" + std::string(command) + "\" \"\"] [0 1 0 1 0 1]\n" + kSphere));
    EXPECT_EQ(r.objects(), 1u) << command;
    ASSERT_EQ(r.log.count("rib-program"), 1) << command;
    EXPECT_EQ(r.log.entries().at(0).where.line, 3);
    EXPECT_NE(r.log.entries().at(0).message.find(trouble), std::string::npos) << r.log.entries().at(0).message;
  }
}

TEST(RunProgram, MayAskForItselfAgainAndAgain) {
  const std::string call =
      "Procedural \"RunProgram\" [\"while read detail data; do if [ $data = 1 ]; then printf 'ReadArchive "
      "\\\\042inner\\\\042\\\\n'; else echo Sphere 1 -1 1 360; fi; printf '\\\\377'; done\" \"";
  const std::string now = "\"] [-inf inf -inf inf -inf inf]\n";
  const Trusting r(
      inWorld("ArchiveBegin \"inner\" " + call + "2" + now + "ArchiveEnd\n" + call + "1" + now + call + "1" + now));
  EXPECT_EQ(r.objects(), 2u);
  EXPECT_TRUE(r.log.entries().empty()) << r.log.entries()[0].message;
}

TEST(RunProgram, ThatNeverEndsItsAnswerIsKilled) {
  for (const char* command : {"yes version 3.03", "yes Sphere"}) {
    const Trusting r(inWorld("Procedural \"RunProgram\" [\"" + std::string(command) + "\" \"\"] [-1 1 -1 1 -1 1]"));
    EXPECT_EQ(r.log.count("rib-program"), 1) << command;
  }
}

TEST(System, RunsWhenAllowedAndReportsFailure) {
  const Trusting r(inWorld("System \"true\"\nSystem \"exit 4\"\n"));
  ASSERT_EQ(r.log.entries().size(), 1u);
  EXPECT_NE(r.log.entries()[0].message.find("exit code 4"), std::string::npos);
}

TEST(Procedural, FollowsReferencesToThePatternsBeforeIt) {
  const std::string open = "Procedural \"DelayedReadArchive\" [\"a\"] [-1 1 -1 1 -1 1]\n";
  const Reading r(inWorld(
      "ArchiveBegin \"a\" Bxdf \"PxrDiffuse\" \"m\" \"reference color diffuseColor\" "
      "\"wood:resultRGB\" " +
      kSphere + "ArchiveEnd\n" + open + "Pattern \"PxrTexture\" \"wood\" \"string filename\" \"wood.tif\"\n" + open));
  ASSERT_EQ(r.scene().objects.size(), 2u);
  EXPECT_EQ(r.log.count("rib-reference"), 1) << "the first procedural does not know what follows it";
  int textured = 0;
  for (size_t i = 0; i < 2; ++i) textured += r.attributes(i).surface->name == "paintedplastic";
  EXPECT_EQ(textured, 1);
}

}  // namespace
}  // namespace tomales
