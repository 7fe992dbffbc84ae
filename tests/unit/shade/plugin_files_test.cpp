// Plugins in folders: shaders and functions of the plugin of these tests (plugin/weave.cpp).
#include <fstream>

#include "places.h"
#include "reyes/base/trust.h"
#include "reyes/shader.h"
#include "tests/unit/shade/stage.h"
#include "tests/unit/temporary.h"

namespace tomales {
namespace {

const std::string kFolder = TOMALES_BUILD_DIR "/tests/shade_plugins", kFile = kFolder + "/weave.so";

struct PluginFolders : testing::Test {
  Log log{Log::Verbosity::Quiet};
  std::string said() const {
    std::string out;
    for (const LogEntry& e : log.entries()) out += e.code + ": " + e.message + "\n";
    return out;
  }
};

TEST_F(PluginFolders, ThatTheUserTrustsGiveShaders) {
  ShaderRegistry registry(log, {.folders = kFolder});
  const TmShader* weave = registry.find("weave", TM_SURFACE, "");
  ASSERT_TRUE(weave);
  EXPECT_EQ(registry.originOf(*weave), kFile);
  EXPECT_EQ(registry.filesOf(*weave), std::vector<std::string>{kFile});
  EXPECT_EQ(registry.all().size(), 2u) << "the other one came with it";
  EXPECT_TRUE(registry.find("bend", TM_DISPLACEMENT, ""));
  EXPECT_EQ(said(), "");
  EXPECT_TRUE(registry.loadPlugin(kFile));
}

TEST_F(PluginFolders, AreNamedWithWhatThePluginHoldsInsteadOfTheKindAskedFor) {
  ShaderRegistry registry(log, {.folders = kFolder});
  EXPECT_FALSE(registry.find("weave", TM_LIGHT, ""));
  EXPECT_EQ(said(), "shader-plugin: has no light \"weave\", but surface \"weave\", displacement \"bend\"\n");
}

TEST_F(PluginFolders, OfTheSceneAreTrustedIfTheUserSaysSo) {
  ShaderRegistry careful(log);
  for (int k = 0; k < 2; ++k) EXPECT_FALSE(careful.find("weave", k == 0 ? TM_SURFACE : TM_LIGHT, kFolder));
  ASSERT_EQ(log.entries().size(), 1u) << "each plugin is refused once";
  EXPECT_EQ(log.entries()[0].message, kPluginRefusal);
  EXPECT_TRUE(careful.functions(kFolder)->named("twice").empty());
  ShaderRegistry trusting(log, {.sceneFolders = true});
  EXPECT_TRUE(trusting.find("weave", TM_SURFACE, kFolder));
  EXPECT_EQ(trusting.functions(kFolder)->named("twice").size(), 2u);
}

TEST_F(PluginFolders, MayHoldFilesThatAreNoPlugins) {
  const std::string folder = test::temporary("no_plugins");
  std::filesystem::create_directories(folder + "/folder.so");
  std::ofstream(folder + "/text.so") << "not a library";
  ShaderRegistry registry(log, {.folders = folder});
  EXPECT_FALSE(registry.find("text", TM_SURFACE, ""));
  EXPECT_NE(said().find("cannot be loaded"), std::string::npos) << said();
  const int before = log.count("shader-plugin");
  EXPECT_TRUE(registry.functions("")->named("any").empty());
  EXPECT_GT(log.count("shader-plugin"), before) << "a folder has no functions";
  EXPECT_FALSE(registry.loadPlugin(folder + "/absent.so"));
  EXPECT_FALSE(registry.loadPlugin(TOMALES_BUILD_DIR "/libtomales_zip.so"));
  EXPECT_NE(said().find("is not a shader plugin: it does not export tomales_shaders"), std::string::npos) << said();
}

TEST_F(PluginFolders, HaveFunctionsInTheOrderOfTheirListsAndNameThoseThatCannotBeCalled) {
  ShaderRegistry registry(log, {.folders = kFolder + ":" + kFolder + "/.:/nowhere"});
  const std::unique_ptr<const RslFunctions> functions = registry.functions("");
  const std::vector<const TmFunction*> twice = functions->named("twice");
  ASSERT_EQ(twice.size(), 4u);
  EXPECT_STREQ(twice[0]->prototype, "float twice(float)");
  EXPECT_STREQ(twice[1]->prototype, "color twice(color)");
  EXPECT_TRUE(functions->named("broken").empty());
  EXPECT_EQ(log.count("shader-plugin"), 2) << "once for each folder";
  EXPECT_NE(said().find("a shader cannot call \"matrix broken(float)\""), std::string::npos) << said();
}

class PluginFunctions : public Stage {};

TEST_F(PluginFunctions, AreCalledByTextsOfTheLanguage) {
  const std::string folder = test::temporary("calls");
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/calls.sl") << "surface calls() { Oi = 1; float x = twice(u + 0.25); Ci = x; }";
  ShaderRegistry own(log, {.folders = kFolder});
  const TmShader* calls = own.find("calls", TM_SURFACE, folder);
  ASSERT_TRUE(calls);
  const TmShader* const list[] = {calls};
  const TmShaderLibrary library = rsl::libraryOf(list);
  registry.addLibrary(&library, "test");
  surface("calls");
  const ShadedPoints out = shade(points({vec3(0, 0, 5), vec3(0, 0, 5)}));
  expectColor(out.color(0), vec3(0.5f));
  expectColor(out.color(1), vec3(1.5f));
}

}  // namespace
}  // namespace tomales
