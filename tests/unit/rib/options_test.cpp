// Tests the effect of options, the camera and transformations on the Scene.
#include <fmt/format.h>

#include "reyes/base/rng.h"
#include "rib_test_tools.h"

namespace tomales {
namespace {

vec3 inWorldSpace(const Object& o, const vec3& p) { return transformPoint(o.worldFromObject.at(0), p); }

TEST(Options, OfTheHiderShapeTheLensAndTheOffsetShiftsMotion) {
  const Reading r(R"(
    Shutter 10 11 Option "shutter" "float offset" [10]
    Hider "hidden" "float[4] aperture" [6 15 0.5 -0.25] "float dofaspect" [2] "int samplemotion" [0]
    WorldBegin
      MotionBegin [0 1] Translate 0 0 0 Translate 1 0 0 MotionEnd
      Attribute "trace" "int samplemotion" [1]
      Sphere 1 -1 1 360
    WorldEnd)");
  const Options& o = r.scenes.at(0).options;
  EXPECT_TRUE(o.aperture.sides == 6 && o.aperture.angle_degrees == 15 && o.aperture.roundness == 0.5f &&
              o.aperture.density == -0.25f && o.dofAspect == 2 && !o.sampleMotion);
  EXPECT_EQ(r.scenes[0].objects[0].worldFromObject.times, (std::vector<float>{10, 11}));
  EXPECT_TRUE(r.scenes[0].objects[0].attributes->trace.sampleMotion);
}

TEST(Scene, HasTheDefaultsOfRISpec) {
  const Reading r(inWorld(""));
  ASSERT_EQ(r.scenes.size(), 1u);
  const Options& o = r.scene().options;
  EXPECT_EQ(o.projection, ProjectionKind::Orthographic);
  EXPECT_EQ(o.xSamples, 2);
  EXPECT_TRUE(o.displays.empty());
}

TEST(Options, AreReadFromEveryRequest) {
  const Reading r(
      R"(Format 320 200 1.5 FrameAspectRatio 2 ScreenWindow -1 1 -2 2 CropWindow 0.25 .5 0 1 Clipping 1 100
    Shutter 0 .5 PixelSamples 3 4 PixelFilter "box" 1 2 Exposure 2 2.2 Quantize "rgba" 1023 0 1023 0 Hider "hidden" "jitter" 0
    Option "limits" "bucketsize" [8 4] "gridsize" 64 Option "searchpath" "shader" "a:b" Option "user" "float x" 3
    Imager "background" "color" [1 0 0] Projection "perspective" "fov" 45 FrameBegin 7)" +
      inWorld("") + "FrameEnd");
  const Options& o = r.scene().options;
  EXPECT_EQ(r.codes(), "");
  EXPECT_TRUE(o.xResolution == 320 && o.yResolution == 200 && o.pixelAspect == 1.5f && o.frameAspect == 2.0f);
  EXPECT_EQ(o.screenWindow, (std::array<float, 4>{-1, 1, -2, 2}));
  EXPECT_EQ(o.cropWindow, (std::array<float, 4>{.25f, .5f, 0, 1}));
  EXPECT_TRUE(o.nearClip == 1 && o.farClip == 100 && o.shutterClose == .5f && o.xSamples == 3 && o.ySamples == 4);
  EXPECT_TRUE(o.filter == "box" && o.yFilterWidth == 2 && o.exposureGain == 2 && o.exposureGamma == 2.2f);
  EXPECT_TRUE(o.rgbaQuantize.one == 1023 && o.quantizeGiven && !o.jitter && o.bucketWidth == 8 && o.bucketHeight == 4);
  EXPECT_TRUE(o.gridSize == 64 && o.searchPaths.at("shader") == "a:b" && o.user.at("user:x").number(0) == 3);
  EXPECT_TRUE(o.imager && o.imager->name == "background" && o.projection == ProjectionKind::Perspective);
  EXPECT_TRUE(o.fov_degrees == 45 && o.frame == 7);
}

TEST(Options, ADisplayChannelWithoutATypeHasThatOfDeclareOrOfTheRenderer) {
  const Reading r(R"(Declare "depth" "varying float" DisplayChannel "depth" DisplayChannel "N" DisplayChannel "s")" +
                  inWorld(""));
  const auto& channels = r.scene().options.channels;
  EXPECT_EQ(channels.at("depth").type, ValueType::Float);
  EXPECT_EQ(channels.at("N").type, ValueType::Normal);
  EXPECT_EQ(channels.at("s").type, ValueType::Float);
  EXPECT_EQ(r.codes(), "");
}

TEST(Options, DisplayChannelsAreTypedByTheirNameAndHidersHaveDepthFilters) {
  const Reading r(
      R"(DisplayChannel "varying color diffuse" DisplayChannel "varying normal Nn" "string source" "N" "string filter" "zmin"
    Hider "hidden" "string depthfilter" "midpoint" Option "limits" "color zthreshold" [0.5 0.5 0.5])" +
      inWorld(""));
  const Options& o = r.scene().options;
  EXPECT_EQ(r.codes(), "");
  EXPECT_EQ(o.channels.at("diffuse").type, ValueType::Color);
  EXPECT_EQ(o.channels.at("Nn").type, ValueType::Normal);
  EXPECT_EQ(o.channels.at("Nn").params.size(), 2u);
  EXPECT_EQ(o.depthFilter, DepthFilter::Midpoint);
  EXPECT_EQ(o.depthThreshold, vec3(0.5f));
}

TEST(Options, WhatNoPictureHoldsIsNoChannel) {
  const Reading r(R"(DisplayChannel "varying matrix m"
    DisplayChannel "plain"
    Hider "hidden" "string depthfilter" "median")" +
                  inWorld(""));
  EXPECT_EQ(r.scene().options.channels.size(), 1u);
  EXPECT_EQ(r.log.entries().size(), 3u);
}

TEST(Options, DisplaysAddUpWithAPlusAndStartAnewWithout) {
  const Reading r("Display \"a\" \"file\" \"rgb\" Display \"b\" \"tiff\" \"rgba\" Display \"+c\" \"file\" \"z\"" +
                  inWorld(""));
  const auto& d = r.scene().options.displays;
  ASSERT_EQ(d.size(), 2u);
  EXPECT_TRUE(d[0].name == "b" && d[1].name == "c" && d[1].mode == "z");
}

TEST(Options, SearchPathsKeepThePreviousValueForAnAmpersand) {
  const Reading r("Option \"searchpath\" \"texture\" [\"a\"] Option \"searchpath\" \"texture\" [\"b:&:@\"]" +
                  inWorld(""));
  EXPECT_EQ(r.scene().options.searchPaths.at("texture"), "b:a");
}

TEST(SearchPaths, CountRelativeFoldersFromTheWorkingFolderAndThenFromTheFile) {
  Log log(Log::Verbosity::Quiet);
  std::string path;
  RibSettings settings;
  settings.onScene = [&](Scene&& s) { path = s.options.searchPaths.at("shader"); };
  readRibText("Option \"searchpath\" \"shader\" [\"mine:.:/abs\"]\n" + inWorld(kSphere), "shots/far/test.rib", settings,
              log);
  EXPECT_EQ(path, "mine:shots/far/mine:.:/abs");
}

TEST(Options, FrameEndRestoresOptionsAndAttributes) {
  const Reading r("Format 10 10 1 FrameBegin 1 Format 20 20 1 Color 1 0 0 LightSource \"ambientlight\" 1 " +
                  inWorld(kSphere) + "FrameEnd " + inWorld(kSphere));
  ASSERT_EQ(r.scenes.size(), 2u);
  EXPECT_EQ(r.scenes[0].options.xResolution, 20);
  EXPECT_EQ(r.scenes[1].options.xResolution, 10);
  EXPECT_EQ(r.scenes[1].objects[0].attributes->color, vec3(1));
  EXPECT_EQ(r.scenes[0].lights.size(), 1u);
  EXPECT_TRUE(r.scenes[1].lights.empty());
}

TEST(Camera, IsTheTransformationBetweenProjectionAndWorldBegin) {
  const Reading r("Translate 9 9 9 Projection \"perspective\" Translate 0 0 5" + inWorld("Translate 1 0 0 " + kSphere));
  expectNear(transformPoint(r.scene().cameraFromWorldAtOpen(), {0, 0, 0}), {0, 0, 5});
  expectNear(inWorldSpace(r.object(0), {0, 0, 0}), {1, 0, 0});
  expectNear(transformPoint(r.object(0).cameraFromObject.at(0), {0, 0, 0}), {1, 0, 5});
}

TEST(Camera, MayMove) {
  const Reading r("Shutter 0 1 MotionBegin [0 1] Translate 0 0 1 Translate 0 0 3 MotionEnd" + inWorld(kSphere));
  expectNear(transformPoint(r.scene().cameraFromWorld.at(.5f), {0, 0, 0}), {0, 0, 2});
  EXPECT_EQ(r.object(0).keyTimes.size(), 2u);
}

TEST(Camera, FitsAFrameOfAnotherAspectIntoTheUpperLeftOfTheDisplay) {
  const auto of = [](const std::string& options) {
    return Camera(Reading(options + " Projection \"perspective\" " + inWorld(kSphere)).scene().options);
  };
  const auto expectFrame = [](const Camera& camera, const vec2& corner, const std::array<int, 4>& pixels) {
    expectNear(vec3(camera.raster({0, 0, 1}), 0),
               vec3(0.5f * corner, 0));  // fov 90: the smaller side spans -1..1 at z = 1
    const vec2 side = camera.raster({1, -1, 1}) - camera.raster({-1, 1, 1});
    EXPECT_NEAR(std::max(side.x, side.y), std::min(corner.x, corner.y), 1e-3f);
    EXPECT_EQ((std::array<int, 4>{camera.crop().x0, camera.crop().y0, camera.crop().x1, camera.crop().y1}), pixels);
  };
  expectFrame(of("Format 200 100 1"), {200, 100}, {0, 0, 200, 100});
  expectFrame(of("Format 200 100 1 FrameAspectRatio 1"), {100, 100}, {0, 0, 100, 100});
  expectFrame(of("Format 100 100 1 FrameAspectRatio 2"), {100, 50}, {0, 0, 100, 50});
  expectFrame(of("Format 100 100 1 FrameAspectRatio 2 CropWindow 0.5 1 0.5 1"), {100, 50}, {50, 25, 100, 50});
  const Camera rounded = of("Format 640 480 1 FrameAspectRatio 1.3333");
  EXPECT_EQ(rounded.crop().width(), 640);
  EXPECT_EQ(rounded.crop().height(), 480);
  // Pixels twice as wide as high: a square frame has half as many columns as rows.
  const Camera wide = of("Format 100 100 2 FrameAspectRatio 1");
  EXPECT_EQ(wide.crop().width(), 50);
  EXPECT_EQ(wide.crop().height(), 100);
}

TEST(Transformations, ApplyTheLastOneFirst) {
  const Reading r(inWorld("Translate 1 2 3 Rotate 90 0 0 1 Scale 2 2 2 " + kSphere));
  expectNear(inWorldSpace(r.object(0), {1, 0, 0}), {1, 4, 3});
}

TEST(Transformations, ReadMatricesAsRowVectorsDo) {
  const Reading r(inWorld("Translate 5 5 5 Transform [2 0 0 0 0 1 0 0 0 0 1 0 7 8 9 1] " + kSphere +
                          "ConcatTransform 0 1 0 0  -1 0 0 0  0 0 1 0  0 0 0 1 " + kSphere + "Identity " + kSphere));
  expectNear(inWorldSpace(r.object(0), {1, 1, 1}), {9, 9, 10});
  expectNear(inWorldSpace(r.object(1), {1, 0, 0}), {7, 9, 9});
  expectNear(inWorldSpace(r.object(2), {1, 2, 3}), {1, 2, 3});
}

TEST(Transformations, SkewTurnsTheFirstAxisTowardsTheSecondByTheAngle) {
  const Reading r(inWorld("Skew 30 0 1 0 1 0 0 " + kSphere));
  const vec3 y = inWorldSpace(r.object(0), {0, 1, 0});
  expectNear(y, {std::tan(glm::radians(30.0f)), 1, 0});
  expectNear(inWorldSpace(r.object(0), {1, 0, 0}), {1, 0, 0});
}

TEST(Transformations, PerspectiveKeepsTheEdgeOfTheFieldAtOne) {
  const Reading r(inWorld("Perspective 90 " + kSphere));
  expectNear(inWorldSpace(r.object(0), {4, -4, 4}), {1, -1, .75f});
}

TEST(Transformations, GoWithTransformEndAndAttributeEnd) {
  const Reading r(inWorld("TransformBegin Translate 1 0 0 Color 1 0 0 TransformEnd " + kSphere +
                          "AttributeBegin Translate 1 0 0 Color 0 1 0 AttributeEnd " + kSphere));
  for (const size_t i : {0, 1}) {
    expectNear(inWorldSpace(r.object(i), {0, 0, 0}), {0, 0, 0});
    EXPECT_EQ(r.attributes(i).color, vec3(1, 0, 0));
  }
}

TEST(Transformations, InAnyNumberAndOrderAreTheProductOfTheirMatrices) {
  const auto number = [](uint32_t i, uint32_t axis, float least, float most) {
    return lerp(least, most, unitFloat(hashCombine(i, axis, 9)));
  };
  for (uint32_t scene = 0; scene < 50; ++scene) {
    std::string text;
    glm::dmat4 product(1);
    for (uint32_t step = 0; step < 1 + scene % 7; ++step) {
      const uint32_t i = hashCombine(scene, step);
      const float x = number(i, 0, -2, 2), y = number(i, 1, -2, 2), z = number(i, 2, 0.5f, 2);
      glm::dmat4 m(1);  // columns; what RIB has as rows
      if (i % 4 == 0) {
        m[3] = {x, y, z, 1};
        text += fmt::format("Translate {} {} {} ", x, y, z);
      } else if (i % 4 == 1) {
        m[0][0] = x;
        m[1][1] = y;
        m[2][2] = z;
        text += fmt::format("Scale {} {} {} ", x, y, z);
      } else if (i % 4 == 2) {
        const double c = std::cos(x), s = std::sin(x);
        m[0] = {c, s, 0, 0};
        m[1] = {-s, c, 0, 0};
        text += fmt::format("Rotate {} 0 0 {} ", x * 180 / kPi, z);
      } else {
        m[1][0] = std::tan(0.5);
        text += fmt::format("Skew {} 0 {} 0 {} 0 0 ", 0.5 * 180 / kPi, z, z);
      }
      product *= m;
      if (step == 3) text += "TransformBegin Translate 9 9 9 Rotate 9 1 2 3 TransformEnd ";
    }
    const Reading r(inWorld(text + kSphere));
    ASSERT_EQ(r.scene().objects.size(), 1u) << text << r.codes();
    for (const vec3& p : {vec3(0), vec3(1, 0, 0), vec3(0.3f, -2, 0.7f)})
      EXPECT_LT(glm::length(inWorldSpace(r.object(0), p) - vec3(product * glm::dvec4(p, 1))),
                1e-4f * (1 + 9 * glm::length(p)))
          << text;
  }
}

TEST(CoordinateSystems, AreGlobalAndRelativeToTheWorld) {
  const Reading r("Translate 0 0 5 CoordinateSystem \"eye\" " +
                  inWorld("AttributeBegin Translate 1 2 3 CoordinateSystem \"here\" AttributeEnd "
                          "CoordSysTransform \"here\" " +
                          kSphere + "CoordSysTransform \"camera\" " + kSphere));
  expectNear(inWorldSpace(r.object(0), {0, 0, 0}), {1, 2, 3});
  expectNear(inWorldSpace(r.object(1), {0, 0, 0}), {0, 0, -5});
  expectNear(transformPoint(r.scene().worldFromNamed.at("here"), {0, 0, 0}), {1, 2, 3});
  expectNear(transformPoint(r.scene().worldFromNamed.at("eye"), {0, 0, 5}), {0, 0, 5});
}

TEST(CoordinateSystems, ThatAreScopedEndWithTheirScope) {
  const Reading r(
      inWorld("AttributeBegin Translate 1 0 0 ScopedCoordinateSystem \"a\" Identity CoordSysTransform \"a\" " +
              kSphere + "AttributeEnd"));
  expectNear(inWorldSpace(r.object(0), {0, 0, 0}), {1, 0, 0});
}

TEST(Display, MayDeclareWhatItShowsAndQuantizeMayNameIt) {
  const Reading r(
      "Quantize \"mask\" 100 0 100 .25 Display \"a.tif\" \"tiff\" \"varying float mask\" Display \"+b.tif\" \"tiff\" "
      "\"Ci\"" +
      inWorld(""));
  const Options& o = r.scene().options;
  EXPECT_EQ(o.displays[0].mode, "mask");
  EXPECT_EQ(o.channels.at("mask").type, ValueType::Float);
  EXPECT_EQ(findParam(o.displays[0].params, "quantize")->floats, (std::vector<float>{0, 100, 0, 100}));
  EXPECT_EQ(findParam(o.displays[0].params, "dither")->floats, std::vector<float>{.25f});
  EXPECT_TRUE(o.displays[1].params.empty());
}

TEST(Display, ShowsWhatDeclareDeclares) {
  const Reading r(
      "Declare \"mask\" \"varying float\" Declare \"N\" \"varying color\" Declare \"label\" \"uniform string\" "
      "Display \"a.tif\" \"tiff\" \"mask\" Display \"+b.tif\" \"tiff\" \"Ci,N,label\"" +
      inWorld(""));
  const Options& o = r.scene().options;
  EXPECT_EQ(o.channels.at("mask").type, ValueType::Float);
  EXPECT_EQ(o.channels.size(), 1u)
      << "what surfaces have by themselves needs no declaration, and pictures hold no text";
  const Reading parameter("Declare \"rgb\" \"uniform color\" Display \"a.tif\" \"tiff\" \"rgb\"" + inWorld(""));
  EXPECT_TRUE(parameter.scene().options.channels.empty()) << "the letters stay letters";
  const Reading frames("FrameBegin 1 Declare \"mask\" \"varying float\"" + inWorld("") +
                       "FrameEnd FrameBegin 2 Display \"a.tif\" \"tiff\" \"mask\"" + inWorld("") + "FrameEnd");
  EXPECT_TRUE(frames.scenes.at(1).options.channels.contains("mask")) << "declarations outlive frames";
}

TEST(DisplacementBounds, GrowWithTheObjectInAllSpaces) {
  for (const char* space : {"object", "world", "shader"}) {
    const Reading r("Shutter 0 1" +
                    inWorld(std::string("Displacement \"bumpy\" Attribute \"displacementbound\" "
                                        "\"sphere\" [0.1] \"coordinatesystem\" [\"") +
                            space + "\"] MotionBegin [0 1] Scale 1 1 1 Scale 3 3 3 MotionEnd " + kSphere));
    EXPECT_NEAR(r.object(0).displacementBound, 0.3f, 1e-5f) << space;
  }
}

TEST(Projection, WhoseFieldOfViewHasNoNumberHasThatOfTheSpecification) {
  const Reading r("Projection \"perspective\" \"uniform string fov\" [\"wide\"]" + inWorld(""));
  EXPECT_EQ(r.scene().options.fov_degrees, 90);
}

TEST(Projection, BeginsAnew) {
  const Reading r("Projection \"perspective\" \"fov\" 40 Projection \"perspective\"" + inWorld(""));
  EXPECT_EQ(r.scene().options.fov_degrees, 90);
}

TEST(Projection, ThatIsUnknownLeavesTheCameraAsItIs) {
  const Reading r("Projection \"perspective\" \"fov\" 40 Translate 0 0 5 Projection \"fisheye\"" + inWorld(kSphere));
  EXPECT_EQ(r.scene().options.fov_degrees, 40);
  EXPECT_EQ(r.scene().cameraFromWorldAtOpen()[3].z, 5);
}

}  // namespace
}  // namespace tomales
