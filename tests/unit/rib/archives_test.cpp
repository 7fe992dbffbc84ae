// Inline archives, procedurals, programs, conditions, variables, search paths and resources.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "reyes/base/parallel.h"
#include "reyes/rib/expression.h"
#include "rib_test_tools.h"

namespace tomales {
namespace {

const std::string kSphere = "Sphere 1 -1 1 360\n";

/// As Reading, but programs are allowed and must answer at once.
struct Trusting {
  std::vector<Scene> scenes;
  Log log{Log::Verbosity::Quiet};
  explicit Trusting(const std::string& text) {
    RibSettings settings;
    settings.allowSystem = true;
    settings.programPatience_s = 2;
    settings.onScene = [this](Scene&& s) { scenes.push_back(opened(std::move(s))); };
    readRibText(text, "test.rib", settings, log);
  }
  size_t objects() const { return scenes.at(0).objects.size(); }
};

TEST(InlineArchive, IsReadWhereItIsCalledAndNotWhereItStands) {
  const Reading r(inWorld("ArchiveBegin \"a\" Translate 1 0 0 " + kSphere +
                          "ArchiveEnd\nReadArchive \"a\" ReadArchive \"a\""));
  ASSERT_EQ(r.scene().objects.size(), 2u);
  EXPECT_EQ(r.object(1).worldFromObject.at(0)[3].x, 2);
  EXPECT_TRUE(r.log.entries().empty()) << r.codes();
}

TEST(InlineArchive, MayHoldArchivesAndBeRedefined) {
  const Reading r(
      inWorld("ArchiveBegin \"a\" ArchiveBegin \"b\" " + kSphere +
              "ArchiveEnd ReadArchive \"b\" ArchiveEnd "
              "ReadArchive \"a\" ReadArchive \"b\" ArchiveBegin \"a\" ArchiveEnd ReadArchive \"a\""));
  EXPECT_EQ(r.scene().objects.size(), 2u);
}

TEST(InlineArchive, NeitherReadsItselfNorDoublesWithoutEnd) {
  const Reading self(
      inWorld("ArchiveBegin \"a\" " + kSphere + "ReadArchive \"a\" ArchiveEnd ReadArchive \"a\""));
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
  const Reading r(inWorld("ArchiveBegin \"a\" Sphere 2 -2 2 360 ArchiveEnd Declare \"k\" \"constant float\"\n"
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
  const std::string starts = testing::TempDir() + "tomales_starts_" + std::to_string(getpid());
  const std::string call = "Procedural2 \"RunProgram2\" \"SimpleBound\" \"string programname\" [\"echo >> " + starts +
                           "; while read detail radius; do echo Sphere $radius -1 1 360; printf '\\\\377'; done\" ] "
                           "\"string data\" [\"";
  std::string text;
  for (int i = 1; i <= 5; ++i) text += call + std::to_string(i) + "\"] \"float[6] bound\" [0 1 0 1 0 1]\n";
  {
    std::vector<Scene> scenes;
    Log log(Log::Verbosity::Quiet);
    RibSettings settings;
    settings.allowSystem = true;
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
  const Reading r(inWorld("Procedural \"RunProgram\" [\"touch " + file +
                          "\" \"\"] [0 1 0 1 0 1]\nSystem \"touch " + file + "\"\n" + kSphere));
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
  for (const char* command : {"sleep 100", "exit 3", "kill -9 $$", "no_such_program_of_tomales", "true"}) {
    const Trusting r(inWorld("\nProcedural \"RunProgram\" [\"" + std::string(command) +
                             "\" \"\"] [0 1 0 1 0 1]\n" + kSphere));
    EXPECT_EQ(r.objects(), 1u) << command;
    EXPECT_EQ(r.log.count("rib-program"), 1) << command;
    EXPECT_EQ(r.log.entries().at(0).where.line, 3);
  }
}

TEST(System, RunsWhenAllowedAndReportsFailure) {
  const Trusting r(inWorld("System \"true\"\nSystem \"exit 4\"\n"));
  ASSERT_EQ(r.log.entries().size(), 1u);
  EXPECT_NE(r.log.entries()[0].message.find("exit code 4"), std::string::npos);
}

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
                           "true"})
    EXPECT_TRUE(isTrue(text)) << text;
  for (const char* text : {"0", "''", "false", "$n != 3", "$name =~ 'x*'", "1 && 0", "!$n"})
    EXPECT_FALSE(isTrue(text)) << text;
  for (const std::string& text : {std::string(""), std::string("1 +"), std::string("$m"), std::string("(1"),
                                  std::string("1 2"), std::string("'a"), std::string("hero + 1"),
                                  std::string("&"), std::string(100000, '('), std::string(100000, '!')})
    EXPECT_THROW(isTrue(text), rib::ExpressionError) << text.substr(0, 20);
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
      inWorld(
          "ArchiveBegin \"a\" IfBegin \"$Attribute:identifier:name =~ 'x*' && $Frame == 7\" " + kSphere +
          "IfEnd ArchiveEnd ReadArchive \"a\" Attribute \"identifier\" \"name\" \"xy\" ReadArchive \"a\"") +
      "FrameEnd");
  EXPECT_EQ(r.scene().objects.size(), 1u);
}

TEST(Conditional, BranchesThatAreNotReadMaySpeakToOthers) {
  const Reading r(inWorld("IfBegin \"0\" Spheer 1 Sphere 1 \"nope\" 2 Color 1 IfBegin \"1\" Cubic IfEnd Else " + kSphere + "Spheer IfEnd\nCuboid"));
  EXPECT_EQ(r.scene().objects.size(), 1u);
  EXPECT_EQ(r.codes(), "rib-unknown-request@3 rib-unknown-request@4 ");
}

TEST(Conditional, BadOnesAreFalseAndUnbalancedOnesEndWithTheFile) {
  const Reading r("Else IfEnd\n" + inWorld("IfBegin \"1 +\"\n" + kSphere + "IfEnd\n" + kSphere) +
                  "IfBegin \"1\"");
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
}

TEST(Display, WithoutANameWritesTheDefault) {
  for (const char* name : {"", ".", "+.."}) {
    const Reading r("Display \"" + std::string(name) + "\" \"file\" \"rgb\"" + inWorld(""));
    EXPECT_EQ(r.scene().options.displays.at(0).name, "ri.pic");
    EXPECT_EQ(r.log.count("rib-display"), 1) << name;
  }
}

TEST(Resource, RestoresAllOrSubsets) {
  const std::string save =
      "AttributeBegin Color 1 0 0 Translate 1 0 0 Matte 1 Sides 1 Resource \"r\" \"attributes\" \"string "
      "operation\" \"save\" AttributeEnd\n";
  const auto restored = [&](const std::string& subset) {
    return Reading(inWorld(save + "Resource \"r\" \"attributes\" \"string operation\" \"restore\"" +
                           (subset.empty() ? "" : " \"string subset\" \"" + subset + "\"") + "\n" + kSphere));
  };
  for (const char* subset : {"", "all", "shading", "transform", "hiding", "shading, hiding,transform"}) {
    const Reading r = restored(subset);
    const std::string name = subset;
    const auto has = [&](const char* part) {
      return name.empty() || name == "all" || name.find(part) != std::string::npos;
    };
    EXPECT_EQ(r.attributes(0).color.y, has("shading") ? 0 : 1) << name;
    EXPECT_EQ(r.object(0).worldFromObject.at(0)[3].x, has("transform") ? 1 : 0) << name;
    EXPECT_EQ(r.attributes(0).matte, has("hiding")) << name;
  }
}

TEST(Resource, HasScopesOfItsOwnAndMovesIntoTheWorld) {
  const Reading r(
      "Translate 0 0 5 Resource \"c\" \"attributes\" \"string operation\" \"save\"" +
      inWorld("ResourceBegin Resource \"r\" \"attributes\" \"string operation\" \"save\" ResourceEnd\n"
              "Resource \"r\" \"attributes\" \"string operation\" \"restore\"\nResourceEnd\n"
              "Translate 1 1 1 Resource \"c\" \"attributes\" \"string operation\" \"restore\"\n" +
              kSphere));
  EXPECT_EQ(r.log.count("rib-resource"), 1);
  EXPECT_EQ(r.log.count("rib-unbalanced"), 1);
  EXPECT_EQ(r.object(0).worldFromObject.at(0), mat4(1));
}

TEST(Interning, AlikeAttributesAreOneAndGroupTogether) {
  std::string text;
  for (int i = 0; i < 100; ++i)
    text += "AttributeBegin Surface \"matte\" \"Kd\" .5\nColor " + std::to_string(i % 3) + " 0 0 " + kSphere +
            "AttributeEnd\n";
  const Reading r(inWorld(text));
  EXPECT_EQ(r.scene().groups.size(), 3u);
  EXPECT_EQ(r.object(0).attributes, r.object(99).attributes);
  EXPECT_NE(r.object(0).attributes, r.object(1).attributes);
}

TEST(EmptyMesh, IsAWarningOnly) {
  const Reading r(
      inWorld("PointsPolygons [] [] \"P\" []\nSubdivisionMesh \"catmull-clark\" [] [] \"P\" []\n" + kSphere));
  EXPECT_EQ(r.scene().objects.size(), 1u);
  EXPECT_EQ(r.log.count("rib-empty-mesh"), 2);
  EXPECT_EQ(r.log.worst(), Severity::Warning);
}

TEST(Ris, BxdfsBecomeStandardShaders) {
  const Reading r(inWorld("Bxdf \"PxrDiffuse\" \"d\" \"color diffuseColor\" [.1 .2 .3] " + kSphere +
                          "Bxdf \"PxrDiffuse\" \"e\" " + kSphere +
                          "Bxdf \"PxrDisney\" \"f\" \"color baseColor\" [.4 .5 .6] \"float roughness\" .25 " +
                          kSphere));
  EXPECT_EQ(r.attributes(0).surface->name, "matte");
  EXPECT_EQ(r.attributes(0).color, vec3(.1f, .2f, .3f));
  EXPECT_EQ(r.attributes(2).surface->name, "disney");
  EXPECT_EQ(findParam(r.attributes(2).surface->params, "roughness")->number(0), .25f);
  EXPECT_EQ(r.log.count("rib-substitute"), 2) << "once a name";
}

TEST(Ris, AreaLightsEmitAlongTheirZAndStaySwitchedOn) {
  for (const char* kind : {"PxrRectLight", "PxrDiskLight", "PxrSphereLight"}) {
    const Reading r(inWorld("Attribute \"visibility\" \"int camera\" 0 \"int indirect\" 0 Light \"" + std::string(kind) +
                            "\" \"key\" \"float intensity\" 3 \"float exposure\" 2 \"__instanceid\" [\"k\"]\n" + kSphere));
    ASSERT_EQ(r.scene().lights.size(), 1u) << kind;
    EXPECT_TRUE(r.scene().lights[0]->area);
    EXPECT_EQ(findParam(r.scene().lights[0]->shader.params, "intensity")->number(0), 12);
    EXPECT_EQ(r.attributes(0).areaLight, 0);
    EXPECT_FALSE(r.attributes(0).visibility.camera || r.attributes(0).visibility.transmission || r.attributes(0).visibility.diffuse);
    EXPECT_EQ(r.attributes(1).areaLight, -1);
    EXPECT_TRUE(r.attributes(1).visibility.transmission);
    EXPECT_EQ(r.attributes(1).lights, std::vector<int>{0});
    if (kind == std::string("PxrSphereLight")) continue;
    std::vector<float> x(12);
    const float half = .5f;
    r.object(0).shape().evaluate(
        0, 1, &half, &half,
        {&x[0], &x[1], &x[2], &x[3], &x[4], &x[5], &x[6], &x[7], &x[8], &x[9], &x[10], &x[11]});
    EXPECT_GT(x[11], 0) << kind;
  }
}

TEST(Ris, LightsOutlastTheirBlock) {
  const Reading r(inWorld("AttributeBegin AttributeBegin Light \"PxrDistantLight\" \"sun\" " + kSphere + "AttributeEnd " + kSphere +
                          "Illuminate \"sun\" 0 " + kSphere + "AttributeEnd " + kSphere));
  for (const size_t i : {0u, 1u, 3u}) EXPECT_EQ(r.attributes(i).lights, std::vector<int>{0}) << i;
  EXPECT_TRUE(r.attributes(2).lights.empty());
}

TEST(Ris, IntegratorsTurnIndirectLightOn) {
  const auto bounces = [](const std::string& params) {
    const Reading r("Integrator \"PxrPathTracer\" \"i\" " + params + inWorld(kSphere));
    const Param* p = r.scene().lights.empty() ? nullptr : findParam(r.scene().lights[0]->shader.params, "bounces");
    return r.scene().lights.empty() ? 0.0f : p ? p->number(0) : -1.0f;
  };
  EXPECT_EQ(bounces(""), -1) << "that of indirectlight";
  EXPECT_EQ(bounces("\"int maxPathLength\" 4"), 3);
  EXPECT_EQ(bounces("\"int maxPathLength\" 1"), 0) << "direct light alone";
  EXPECT_EQ(bounces("\"int maxIndirectBounces\" 2"), 2);
  const Reading path(
      "Integrator \"PxrPathTracer\" \"i\"" +
      inWorld("Light \"PxrDomeLight\" \"sky\" \"string lightColorMap\" \"sky.exr\" " + kSphere));
  ASSERT_EQ(path.scene().lights.size(), 2u);
  EXPECT_EQ(path.scene().lights[0]->shader.name, "indirectlight");
  EXPECT_EQ(path.scene().lights[1]->shader.name, "environmentlight");
  EXPECT_TRUE(Reading("Integrator \"PxrDirectLighting\" \"i\"" + inWorld(kSphere)).scene().lights.empty());
  EXPECT_EQ(Reading("Hider \"raytrace\" \"int maxsamples\" 256 \"int incremental\" 1" + inWorld("")).scene().options.xSamples, 8);
}

TEST(Ris, ReferencesAreFollowedToPatternsThatHaveASubstitute) {
  const Reading r(inWorld(
      "Pattern \"PxrTexture\" \"wood\" \"string filename\" \"wood.tif\" Pattern \"PxrChecker\" \"board\" \"color colorA\" [1 0 0]\n"
      "Pattern \"PxrPrimvar\" \"own\" \"string varname\" \"Cs\"\nPattern \"PxrFractal\" \"noise\"\n"
      "Bxdf \"PxrDiffuse\" \"a\" \"reference color diffuseColor\" \"wood:resultRGB\" " + kSphere +
      "Bxdf \"PxrDisney\" \"b\" \"reference color baseColor\" [\"board:resultRGB\"] \"int[] x\" [] " + kSphere +
      "Color .2 .3 .4 Bxdf \"PxrDiffuse\" \"c\" \"reference color diffuseColor\" \"own:resultRGB\" " + kSphere +
      "Bxdf \"PxrDiffuse\" \"d\" \"reference color diffuseColor\" \"noise:resultRGB\" " + kSphere +
      "Bxdf \"PxrDiffuse\" \"e\" \"reference color diffuseColor\" \"nowhere:resultRGB\" " + kSphere));
  EXPECT_EQ(r.attributes(0).surface->name, "paintedplastic");
  EXPECT_EQ(findParam(r.attributes(0).surface->params, "texturename")->strings[0], "wood.tif");
  EXPECT_EQ(r.attributes(1).color, vec3(.5f, 0, 0));
  EXPECT_EQ(r.attributes(2).color, vec3(.2f, .3f, .4f));
  EXPECT_EQ(r.attributes(3).color, vec3(.5f));
  EXPECT_EQ(r.log.count("rib-reference"), 1);
  EXPECT_EQ(r.message("rib-reference").where.line, 9);
  // Two Bxdfs and four patterns.
  EXPECT_EQ(r.log.count("rib-substitute"), 2 + 4) << r.codes();
}

TEST(Ris, MetalsMirrorAndGlassRefracts) {
  const Reading r(inWorld("Bxdf \"PxrDisney\" \"m\" \"float metallic\" 1 \"color baseColor\" [1 .5 0] " + kSphere +
                          "Bxdf \"PxrSurface\" \"s\" \"float diffuseGain\" 0 \"color specularEdgeColor\" [.9 .8 .7] " + kSphere +
                          "Bxdf \"PxrGlass\" \"g\" \"float ior\" 1.3 " + kSphere));
  EXPECT_EQ(r.attributes(0).surface->name, "disney");
  EXPECT_EQ(findParam(r.attributes(0).surface->params, "metallic")->number(0), 1);
  EXPECT_EQ(findParam(r.attributes(1).surface->params, "reflections")->number(0), 1);
  EXPECT_EQ(r.attributes(0).color, vec3(1, .5f, 0));
  EXPECT_EQ(r.attributes(1).color, vec3(.9f, .8f, .7f));
  EXPECT_EQ(r.attributes(2).surface->name, "glass");
}

}  // namespace
}  // namespace tomales
