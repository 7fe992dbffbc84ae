#include "reyes/app/frame/overrides.h"

#include <gtest/gtest.h>

#include "reyes/app/frame/light_sources.h"
#include "reyes/rib.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

const char* const kTwoSpheres =
    "Display \"first.tif\" \"tiff\" \"rgba\"\n"
    "Display \"+second.exr\" \"openexr\" \"rgb\"\n"
    "WorldBegin\n"
    "LightSource \"ambientlight\" 1\n"
    "ShadingRate 2\nSphere 1 -1 1 360\nSphere 2 -2 2 360\n"
    "ShadingRate 8\nSphere 1 -1 1 360\n"
    "WorldEnd\n";

Scene sceneOf(const std::string& rib) {
  Log log(Log::Verbosity::Quiet);
  Scene out;
  RibSettings settings;
  settings.onScene = [&](Scene&& scene) { out = std::move(scene); };
  EXPECT_TRUE(readRibText(rib, "test.rib", settings, log));
  return out;
}

TEST(Overrides, ShadingRateReachesEveryObjectAndSharingStays) {
  Scene scene = sceneOf(kTwoSpheres);
  ASSERT_EQ(scene.objects.size(), 3u);
  RenderSettings settings;
  settings.picture.shadingRate = 4.0f;
  applyOverrides(scene, settings);
  for (const Object& object : scene.objects) {
    EXPECT_EQ(object.attributes->shadingRate, 4);
    ASSERT_LT(static_cast<size_t>(object.group), scene.groups.size());
    EXPECT_EQ(scene.groups[static_cast<size_t>(object.group)].attributes, object.attributes);
  }
  EXPECT_EQ(scene.objects[0].attributes, scene.objects[1].attributes);
}

/// The mode that a scene with these requests in its world has under this choice of --gi.
GiMode modeOf(const std::string& lights, const char* choice) {
  const Scene scene = sceneOf("WorldBegin\n" + lights + "Sphere 1 -1 1 360\nWorldEnd\n");
  Log log(Log::Verbosity::Quiet);
  Stats stats;
  ShaderRegistry registry(log);
  registry.addLibrary(tomales_builtin_shaders(), "built-in");
  RenderSettings settings;
  settings.light.gi = giMethodNamed(choice);
  return methodOf(settings, ShadingSystem(scene, registry, nullptr, log, stats)).mode;
}

TEST(Overrides, TheGiModeIsThatOfTheCommandLineOrElseOfTheIndirectLight) {
  const std::string none, gather = "LightSource \"indirectlight\" 1\n",
                          atlas = "LightSource \"indirectlight\" 1 \"string radiance\" \"atlas\"\n",
                          points = "LightSource \"indirectlight\" 1 \"string radiance\" \"points\"\n",
                          radiosity = "LightSource \"indirectlight\" 1 \"string radiance\" \"radiosity\"\n";
  EXPECT_EQ(modeOf(none, "scene"), GiMode::None);
  EXPECT_EQ(modeOf(gather, "scene"), GiMode::Gather);
  EXPECT_EQ(modeOf(atlas, "scene"), GiMode::Atlas);
  EXPECT_EQ(modeOf(points, "scene"), GiMode::Atlas);
  EXPECT_EQ(modeOf(radiosity, "scene"), GiMode::Radiosity);
  EXPECT_EQ(modeOf(gather + atlas, "scene"), GiMode::Atlas) << "one of several that asks";
  EXPECT_EQ(modeOf(atlas, "none"), GiMode::None);
  EXPECT_EQ(modeOf(atlas, "gather"), GiMode::Gather);
  EXPECT_EQ(modeOf(none, "points"), GiMode::Atlas);
}

TEST(Overrides, AGiModeAsksForAnIndirectLight) {
  Scene scene = sceneOf(kTwoSpheres);
  RenderSettings settings;
  applyOverrides(scene, settings);
  EXPECT_FALSE(scene.options.wantsIndirect);
  settings.light.gi = giMethodNamed("gather");
  applyOverrides(scene, settings);
  EXPECT_TRUE(scene.options.wantsIndirect);
  EXPECT_EQ(scene.lights.size(), 1u) << "it is added where lights are bound";
}

TEST(Overrides, ADraftIsCoarseButForWhatIsAskedBesides) {
  Scene scene = sceneOf(
      "PixelSamples 4 4\nWorldBegin\nLightSource \"indirectlight\" 1 \"samples\" [600]\nShadingRate 0.5\nDisplacement "
      "\"bumpy\"\nSphere 1 -1 1 360\nWorldEnd\n");
  RenderSettings settings;
  settings.picture.draft = true;
  settings.picture.pixelSamples = {{3, 5}};
  applyOverrides(scene, settings);
  EXPECT_EQ(scene.objects[0].attributes->shadingRate, 8);
  EXPECT_EQ(scene.objects[0].attributes->displacement, nullptr);
  EXPECT_EQ(scene.options.xSamples, 3);
  EXPECT_EQ(scene.options.indirectSamples, 50);
}

TEST(Overrides, AFrameOfMapsKeepsItsSizeAndAllOfItsView) {
  Scene scene = sceneOf("Display \"lamp.z\" \"shadow\" \"z\" Format 64 64 1 WorldBegin\nSphere 1 -1 1 360\nWorldEnd\n");
  RenderSettings settings;
  settings.picture.format = {{320, 200}};
  settings.picture.crop = {{0.25f, 0.5f, 0, 1}};
  applyOverrides(scene, settings);
  EXPECT_EQ(scene.options.xResolution, 64);
  EXPECT_EQ(scene.options.cropWindow[1], 1.0f);
}

TEST(Overrides, PictureSizesComeFromTheCommandLine) {
  Scene scene = sceneOf(kTwoSpheres);
  RenderSettings settings;
  settings.picture.format = {{320, 200}};
  settings.picture.crop = {{0.25f, 0.5f, 0, 1}};
  settings.picture.pixelSamples = {{3, 5}};
  settings.resources.bucketSize = 7;
  applyOverrides(scene, settings);
  EXPECT_EQ(scene.options.xResolution, 320);
  EXPECT_EQ(scene.options.cropWindow[1], 0.5f);
  EXPECT_EQ(scene.options.ySamples, 5);
  EXPECT_EQ(scene.options.bucketHeight, 7);
}

}  // namespace
}  // namespace tomales
