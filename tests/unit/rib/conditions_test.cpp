// Conditions, variables and search paths.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "reyes/rib/expression.h"
#include "reyes/rib/search_path.h"
#include "rib_test_tools.h"

namespace tomales {
namespace {

bool isTrue(const std::string& expression) {
  const std::map<std::string, std::string> values = {{"n", "3"}, {"name", "hero"}, {"Option:user:empty", ""}};
  return rib::holds(expression, [&](const std::string& name) {
    const auto it = values.find(name);
    return it == values.end() ? std::nullopt : std::optional(it->second);
  });
}

TEST(Expression, FollowsItsGrammar) {
  for (const char* text : {"1",
                           "$n == 3",
                           "$n == 3.0",
                           "$n > 2 && $n < 4",
                           "1 + 2 * 3 == 7",
                           "(1 + 2) * 3 == 9",
                           "!0",
                           "-1 < 0",
                           "'a' < 'b'",
                           "$name == 'hero'",
                           "${name} == hero",
                           "$name =~ 'h*o'",
                           "$name =~ '?er?'",
                           "defined(n)",
                           "!defined(m)",
                           "concat($name, '_', $n) == 'hero_3'",
                           "$($n - 1) == 2",
                           "0 || 1",
                           "1e-3 < 1e+3",
                           "6 / 4 == 1.5",
                           "$Option:user:empty == ''",
                           "!defined(m) || $m == 1",
                           "1 || hero + 1",
                           "!(defined(m) && $m + 1 > 2)",
                           "1 != 1 == 0",
                           "1 < 2 == 1",
                           "2 <= 2",
                           "1 <= 2",
                           "2 >= 2",
                           "3 >= 2",
                           "true"})
    EXPECT_TRUE(isTrue(text)) << text;
  for (const char* text : {"0", "''", "false", "$n != 3", "$name =~ 'x*'", "1 && 0", "!$n", "3 <= 2", "1 >= 2", "2 < 2",
                           "2 > 2", "defined(m) && $m == 1", "0 && ($m || 1)"})
    EXPECT_FALSE(isTrue(text)) << text;
  for (const std::string& text :
       {std::string(""), std::string("1 +"), std::string("$m"), std::string("0 || $m"), std::string("1 && $m"),
        std::string("(1"), std::string("1 2"), std::string("'a"), std::string("hero + 1"), std::string("&"),
        std::string(100000, '('), std::string(100000, '!')})
    EXPECT_THROW(isTrue(text), rib::ExpressionError) << text.substr(0, 20);
}

TEST(Expression, RefusesWhatTakesHours) {
  const std::string a(1 << 17, 'a');
  EXPECT_THROW(isTrue("'" + a + "' =~ '" + std::string(1 << 16, '*') + a + "b'"), rib::ExpressionError);
  EXPECT_THROW(isTrue("concat('" + std::string(1 << 20, 'a') + "', 'b') == ''"), rib::ExpressionError);
}

TEST(Conditional, ReadsTheFirstBranchThatHolds) {
  const auto radii = [](const std::string& mode) {
    const Reading r(
        "Option \"user\" \"string mode\" \"" + mode + "\"\n" +
        inWorld("IfBegin \"$mode == 'a'\" Color 1 0 0 IfBegin \"0\" Color 9 9 9 Else Opacity .5 .5 .5 IfEnd\n"
                "ElseIf \"$user:mode == 'b'\" Color 2 0 0 ElseIf \"$Option:user:mode == 'b'\" Color 8 0 0 "
                "Else Color 3 0 0 IfEnd\n" +
                kSphere));
    EXPECT_TRUE(r.log.entries().empty()) << r.codes();
    return r.attributes(0).color.x + r.attributes(0).opacity.x;
  };
  EXPECT_EQ(radii("a"), 1.5f);
  EXPECT_EQ(radii("b"), 3);
  EXPECT_EQ(radii("c"), 4);
}

TEST(Conditional, SeesFrameAndAttributesInArchivesToo) {
  const Reading r(
      "FrameBegin 7 " +
      inWorld("ArchiveBegin \"a\" IfBegin \"$Attribute:identifier:name =~ 'x*' && $Frame == 7\" " + kSphere +
              "IfEnd ArchiveEnd ReadArchive \"a\" Attribute \"identifier\" \"name\" \"xy\" ReadArchive \"a\"") +
      "FrameEnd");
  EXPECT_EQ(r.scene().objects.size(), 1u);
}

TEST(Conditional, BranchesThatAreNotReadMaySpeakToOthers) {
  const Reading r(inWorld("IfBegin \"0\" Spheer 1 Sphere 1 \"nope\" 2 Color 1 IfBegin \"1\" Cubic IfEnd Else " +
                          kSphere + "Spheer IfEnd\nCuboid"));
  EXPECT_EQ(r.scene().objects.size(), 1u);
  EXPECT_EQ(r.codes(), "rib-unknown-request@3 rib-unknown-request@4 ");
}

TEST(Conditional, BadOnesAreFalseAndUnbalancedOnesEndWithTheFile) {
  const Reading r("Else IfEnd\n" + inWorld("IfBegin \"1 +\"\n" + kSphere + "IfEnd\n" + kSphere) + "IfBegin \"1\"");
  EXPECT_EQ(r.scene().objects.size(), 1u);
  EXPECT_EQ(r.message("rib-condition").where.line, 3);
  EXPECT_EQ(r.log.count("rib-unbalanced"), 3) << r.codes();
}

TEST(Variables, AreSubstitutedInStringsOnceAsked) {
  setenv("TOMALES_TEST_FOLDER", "from_env", 1);
  const Reading r(
      "Display \"${shot}.exr\" \"file\" \"rgb\" Option \"user\" \"string shot\" \"s1\" Option \"ribparse\" "
      "\"string varsubst\" \"$\"\n"
      "Display \"+${shot}/${TOMALES_TEST_FOLDER}.exr\" \"file\" \"rgb\"\nDisplay \"+${nowhere}$\" \"file\" "
      "\"rgb\"" +
      inWorld(""));
  const auto& displays = r.scene().options.displays;
  ASSERT_EQ(displays.size(), 3u);
  EXPECT_EQ(displays[0].name, "${shot}.exr");
  EXPECT_EQ(displays[1].name, "s1/from_env.exr");
  EXPECT_EQ(displays[2].name, "${nowhere}$");
  EXPECT_EQ(r.message("rib-variable").where.line, 3);
}

TEST(Variables, ThatSearchPathsLackAreNamedOnceInOneMessage) {
  const std::string path = "Option \"searchpath\" \"string shader\" \"@:${NOWHERE}/a:${NOWHERE}/b:${NOWHERE_ELSE}\"\n";
  for (const char* substitution : {"", "Option \"ribparse\" \"string varsubst\" \"$\" "}) {
    const Reading r(substitution + path + inWorld(""));
    EXPECT_EQ(r.codes(), "rib-variable@1 ");
    EXPECT_NE(r.message("rib-variable").message.find("has no NOWHERE, NOWHERE_ELSE;"), std::string::npos);
  }
}

TEST(Variables, ThatDoubleEndWithAMessage) {
  std::string text = "Option \"ribparse\" \"string varsubst\" \"$\" Option \"user\" \"string a\" \"0123456789\"\n";
  for (int k = 0; k < 60; ++k) text += "Option \"user\" \"string a\" \"${a}${a}\"\n";
  const Reading r(text + inWorld(kSphere));
  EXPECT_LE(r.scene().options.user.at("user:a").strings[0].size(), rib::kLongestText);
  EXPECT_NE(r.message("rib-variable").message.find("longer than 1048576 bytes"), std::string::npos) << r.codes();
  EXPECT_EQ(r.message("rib-variable").where.line, 18);
}

TEST(SearchPath, ThatDoublesEndsWithAMessageAndKeepsWhatItWas) {
  std::string text = "Option \"searchpath\" \"string archive\" \"a\"\n";
  for (int k = 0; k < 60; ++k) text += "Option \"searchpath\" \"string archive\" \"&:&\"\n";
  const Reading r(text + inWorld(kSphere));
  const std::string& path = r.scene().options.searchPaths.at("archive");
  EXPECT_TRUE(path.starts_with("a:a") && path.size() <= rib::kLongestSearchPath);
  EXPECT_NE(r.message("rib-option").message.find("longer than 65536 bytes"), std::string::npos) << r.codes();
}

TEST(SearchPath, OfMappedFoldersIsBoundedToo) {
  const Reading r("Option \"searchpath\" \"string archive\" \"a:a:a\" \"string[3] dirmap\" [\"NFS\" \"a\" \"" +
                  std::string(60000, 'b') + "\"]" + inWorld(kSphere));
  EXPECT_EQ(r.scene().options.searchPaths.at("archive"), "a:a:a");
  EXPECT_NE(r.message("rib-option").message.find("longer than"), std::string::npos) << r.codes();
}

TEST(SearchPath, KnowsTheEnvironmentAndPreviousValues) {
  setenv("TOMALES_TEST_FOLDER", "/env", 1);
  const Reading r(
      "Option \"searchpath\" \"texture\" \"/a:@\" Option \"searchpath\" \"texture\" "
      "\"&:$TOMALES_TEST_FOLDER/b:${TOMALES_TEST_FOLDER}\"" +
      inWorld(""));
  EXPECT_EQ(r.scene().options.searchPaths.at("texture"), "/a:/env/b:/env");
}

TEST(SearchPath, MapsFoldersOfTheZoneOfUnix) {
  const std::string folder = testing::TempDir();
  std::ofstream(folder + "mapped.rib") << kSphere;
  const std::string map =
      "Option \"searchpath\" \"string dirmap\" [\"[\\\"UNC\\\" \\\"/z/\\\" \\\"/no/\\\"] [\\\"NFS\\\" "
      "\\\"/z/\\\" \\\"" +
      folder + "\\\"]\"]\n";
  EXPECT_EQ(Reading(map + inWorld("ReadArchive \"/z/mapped.rib\"")).scene().objects.size(), 1u);
  EXPECT_EQ(Reading(map + "Option \"searchpath\" \"archive\" \"/z/\"" + inWorld("ReadArchive \"mapped.rib\""))
                .scene()
                .objects.size(),
            1u);
  EXPECT_EQ(Reading("Option \"searchpath\" \"archive\" \"/z/\"\n" + map + inWorld("ReadArchive \"mapped.rib\""))
                .scene()
                .objects.size(),
            1u)
      << "in either order";
}

TEST(SearchPath, IsMappedOnceThoughEveryFrameSaysItAgain) {
  const std::string map = "Option \"searchpath\" \"string dirmap\" [\"NFS\" \"/a\" \"/a/b\"]\n",
                    path = "Option \"searchpath\" \"texture\" \"&:/a\"\n";
  const Reading r(map + "Option \"searchpath\" \"texture\" \"/a\"\n" + map + path + map + inWorld(""));
  EXPECT_EQ(r.scene().options.searchPaths.at("texture"), "/a/b:/a/b");
}

}  // namespace
}  // namespace tomales
