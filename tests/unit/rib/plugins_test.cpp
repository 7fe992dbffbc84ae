// Procedural "DynamicLoad", with a plugin of these tests (plugin/spheres.cpp).
#include <fmt/format.h>

#include "places.h"
#include "rib_test_tools.h"

namespace tomales {
namespace {

const std::string kFolder = TOMALES_BUILD_DIR "/tests";

struct Called {
  Log log{Log::Verbosity::Quiet};
  std::vector<Scene> scenes;

  explicit Called(const std::string& world, const std::string& before = "", const std::string& pluginPath = kFolder) {
    RibSettings settings;
    settings.trust.pluginPath = pluginPath;
    settings.onScene = [this](Scene&& s) { scenes.push_back(opened(std::move(s))); };
    readRibText(before + inWorld(world), "test.rib", settings, log);
  }
  std::vector<float> radii() const {
    std::vector<float> out;
    for (const Object& o : scenes.at(0).objects) out.push_back(std::round(o.shape().bound(0, {}).hi.z));
    return out;
  }
  std::string said() const {
    std::string out;
    for (const LogEntry& e : log.entries()) out += e.code + ": " + e.message + "\n";
    return out;
  }
};

std::string call(const std::string& text, const std::string& name = "spheres") {
  return "Procedural \"DynamicLoad\" [\"" + name + "\" \"" + text + "\"] [-0.5 0.5 -0.25 0.25 1 2]\n";
}

TEST(PluginsOfProcedurals, GetTheirTextAndTheAreaOfTheirBoundInPixels) {
  const Called c(call("12d"), "Format 100 100 1 ScreenWindow -1 1 -1 1 Projection \"orthographic\"");
  EXPECT_EQ(c.radii(), (std::vector<float>{1, 2, 1250}));
  EXPECT_EQ(c.said(), "");
}

TEST(PluginsOfProcedurals, AreReadWhereTheyAreCalled) {
  const Called c("Color [1 0 0]\n" + call("1") + call("34") + "Color [0 1 0] " + kSphere);
  ASSERT_EQ(c.radii(), (std::vector<float>{1, 1, 3, 4}));
  EXPECT_EQ(c.scenes[0].objects[3].attributes->color, vec3(1, 0, 0));
}

TEST(PluginsOfProcedurals, KeepWhatTheyCalledBeforeTheyFailed) {
  const Called c(call("12!3"));
  EXPECT_EQ(c.radii(), (std::vector<float>{1, 2}));
  EXPECT_EQ(c.said(),
            "rib-plugin: Procedural: plugin \"spheres\" failed: out of twigs; what it called before is used\n");
}

TEST(PluginsOfProcedurals, WarnIfTheyCallNothing) {
  EXPECT_EQ(Called(call("")).said(), "rib-plugin: Procedural: plugin \"spheres\" called nothing\n");
}

TEST(PluginsOfProcedurals, AreNamedIfTheyCannotBeUsed) {
  const auto said = [](const Called& c) {
    EXPECT_EQ(c.scenes.at(0).objects.size(), 0u);
    return c.said();
  };
  EXPECT_EQ(said(Called(call("1", "cubes"))),
            "rib-plugin: Procedural: plugin \"cubes\" is not found (--plugin-path, Option \"searchpath\" "
            "\"procedural\"); nothing is "
            "drawn in its place\n");
  EXPECT_EQ(said(Called(call("1", "libtomales_zip"), "", TOMALES_BUILD_DIR)),
            "rib-plugin: Procedural: plugin \"libtomales_zip\" has no function ConvertParameters, Subdivide, Free; "
            "nothing is drawn "
            "in its place\n");
  EXPECT_EQ(said(Called(call("1", kFolder + "/spheres.so"), "", "")),
            fmt::format("rib-plugin: Procedural: plugin \"{}/spheres.so\" {}; nothing is drawn in its place\n", kFolder,
                        kPluginRefusal));
}

}  // namespace
}  // namespace tomales
