// What the requests of well-formed RIB leave in the Scene.
#include "rib_test_tools.h"

namespace tomales {
namespace {

const std::string kSphere = "Sphere 1 -1 1 360\n";

vec3 inWorldSpace(const Object& o, const vec3& p) { return transformPoint(o.worldFromObject.at(0), p); }

void expectNear(const vec3& a, const vec3& b, float tolerance = 1e-5f) {
  EXPECT_LT(glm::length(a - b), tolerance)
      << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

TEST(Attributes, OfRaysAreRead) {
  const Reading r(R"(
    Option "trace" "int maxdepth" [3]
    WorldBegin
      Attribute "grouping" "string membership" ["a,b"]
      Attribute "grouping" "string membership" ["+c"]
      Attribute "grouping" "string membership" ["-a"]
      Attribute "grouping" "string tracesubset" ["b"]
      Attribute "trace" "int maxdiffusedepth" [4] "int maxspeculardepth" [5]
      Attribute "shade" "string diffusehitmode" ["primitive"] "string transmissionhitmode" ["shader"]
      Sphere 1 -1 1 360
    WorldEnd)");
  const Attributes& a = r.attributes(0);
  EXPECT_EQ(r.scene().options.maxRayDepth, 3);
  EXPECT_EQ(a.membership, (std::set<std::string>{"b", "c"}));
  EXPECT_TRUE(a.trace.subset == "b" && a.trace.maxDiffuseDepth == 4 && a.trace.maxSpecularDepth == 5);
  EXPECT_TRUE(a.diffuseHitMode == HitMode::Primitive && a.transmissionHitMode == HitMode::Shader);
  EXPECT_EQ(r.codes(), "");
}

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
  EXPECT_TRUE(o.nearClip == 1 && o.farClip == 100 && o.shutterClose == .5f && o.xSamples == 3 &&
              o.ySamples == 4);
  EXPECT_TRUE(o.filter == "box" && o.yFilterWidth == 2 && o.exposureGain == 2 && o.exposureGamma == 2.2f);
  EXPECT_TRUE(o.rgbaQuantize.one == 1023 && o.quantizeGiven && !o.jitter && o.bucketWidth == 8 &&
              o.bucketHeight == 4);
  EXPECT_TRUE(o.gridSize == 64 && o.searchPaths.at("shader") == "a:b" && o.user.at("user:x").number(0) == 3);
  EXPECT_TRUE(o.imager && o.imager->name == "background" && o.projection == ProjectionKind::Perspective);
  EXPECT_TRUE(o.fov_degrees == 45 && o.frame == 7);
}

TEST(Options, DisplayChannelsAreTypedByTheirNameAndHidersHaveDepthFilters) {
  const Reading r(R"(DisplayChannel "varying color diffuse" DisplayChannel "varying normal Nn" "string source" "N" "string filter" "zmin"
    Hider "hidden" "string depthfilter" "midpoint" Option "limits" "color zthreshold" [0.5 0.5 0.5])" + inWorld(""));
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
    Hider "hidden" "string depthfilter" "median")" + inWorld(""));
  EXPECT_EQ(r.scene().options.channels.size(), 1u);
  EXPECT_EQ(r.log.entries().size(), 3u);
}

TEST(Options, DisplaysAddUpWithAPlusAndStartAnewWithout) {
  const Reading r(
      "Display \"a\" \"file\" \"rgb\" Display \"b\" \"tiff\" \"rgba\" Display \"+c\" \"file\" \"z\"" +
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
  const Reading r("Translate 9 9 9 Projection \"perspective\" Translate 0 0 5" +
                  inWorld("Translate 1 0 0 " + kSphere));
  expectNear(transformPoint(r.scene().cameraFromWorldAtOpen(), {0, 0, 0}), {0, 0, 5});
  expectNear(inWorldSpace(r.object(0), {0, 0, 0}), {1, 0, 0});
  expectNear(transformPoint(r.object(0).cameraFromObject.at(0), {0, 0, 0}), {1, 0, 5});
}

TEST(Camera, MayMove) {
  const Reading r("Shutter 0 1 MotionBegin [0 1] Translate 0 0 1 Translate 0 0 3 MotionEnd" +
                  inWorld(kSphere));
  expectNear(transformPoint(r.scene().cameraFromWorld.at(.5f), {0, 0, 0}), {0, 0, 2});
  EXPECT_EQ(r.object(0).keyTimes.size(), 2u);
}

TEST(Transformations, ApplyTheLastOneFirst) {
  const Reading r(inWorld("Translate 1 2 3 Rotate 90 0 0 1 Scale 2 2 2 " + kSphere));
  expectNear(inWorldSpace(r.object(0), {1, 0, 0}), {1, 4, 3});
}

TEST(Transformations, ReadMatricesAsRowVectorsDo) {
  const Reading r(inWorld("Translate 5 5 5 Transform [2 0 0 0 0 1 0 0 0 0 1 0 7 8 9 1] " + kSphere +
                          "ConcatTransform 0 1 0 0  -1 0 0 0  0 0 1 0  0 0 0 1 " + kSphere + "Identity " +
                          kSphere));
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
  const Reading r(inWorld(
      "AttributeBegin Translate 1 0 0 ScopedCoordinateSystem \"a\" Identity CoordSysTransform \"a\" " +
      kSphere + "AttributeEnd"));
  expectNear(inWorldSpace(r.object(0), {0, 0, 0}), {1, 0, 0});
}

TEST(Attributes, AreReadFromEveryRequest) {
  const Reading r(
      inWorld(R"(Color .1 .2 .3 Opacity [.5 .5 .5] TextureCoordinates 0 0 2 0 0 2 2 2 ShadingRate 4
    GeometricApproximation "motionfactor" 2 GeometricApproximation "focusfactor" .5
    ShadingInterpolation "smooth" Matte 1 Sides 1 Attribute "identifier" "name" "ball" Attribute "user" "float x" 3
    Attribute "displacementbound" "sphere" 2 "coordinatesystem" "world"
    Attribute "visibility" "camera" 0 "diffuse" 0 "specular" 0 "transmission" 0
    Attribute "trace" "bias" .1 "offset" .2 "displacements" 1 "tessellation" 3
    Attribute "indirect" "receive" 0 "gain" 2 "bleeding" 3 "bleedingcolor" [1 0 0] "surface" "simple"
    Attribute "irradiance" "maxerror" .3 "maxpixeldist" 9 Attribute "dice" "rasterorient" 0 )" +
              kSphere));
  EXPECT_EQ(r.codes(), "");
  const Attributes& a = r.attributes(0);
  EXPECT_TRUE(a.color == vec3(.1f, .2f, .3f) && a.opacity == vec3(.5f) &&
              a.textureCoordinates[3] == vec2(2, 2));
  EXPECT_TRUE(a.shadingRate == 4 && a.interpolation == ShadingInterpolation::Smooth && a.matte &&
              a.sides == 1);
  EXPECT_TRUE(a.motionFactor == 2 && a.focusFactor == .5f);
  EXPECT_TRUE(a.name == "ball" && a.user.at("user:x").number(0) == 3);
  EXPECT_TRUE(a.displacementBound == 2 && a.displacementBoundSpace == "world");
  const Visibility& v = a.visibility;
  EXPECT_FALSE(v.camera || v.diffuse || v.specular || v.transmission);
  EXPECT_TRUE(a.trace.bias == .1f && a.trace.offset == .2f && a.trace.displacements &&
              a.trace.tessellation == 3);
  EXPECT_TRUE(!a.indirect.receive && a.indirect.gain == 2 && a.indirect.bleeding == 3);
  EXPECT_TRUE(a.indirect.bleedingColor == vec3(1, 0, 0) && a.indirect.surface == "simple");
  EXPECT_TRUE(a.irradianceMaxError == .3f && a.irradianceMaxPixelDist == 9 && !a.rasterOrient);
}

TEST(Attributes, AreSharedByConsecutivePrimitivesOnly) {
  const Reading r(inWorld(kSphere + "Translate 1 0 0 " + kSphere + "Color 1 0 0 " + kSphere));
  EXPECT_EQ(r.object(0).attributes, r.object(1).attributes);
  EXPECT_NE(r.object(1).attributes, r.object(2).attributes);
  EXPECT_EQ(r.attributes(0).color, vec3(1));
}

TEST(Attributes, UnknownOnesAreNamedOnceAndKept) {
  const Reading r(inWorld("Attribute \"cull\" \"hidden\" 0\nAttribute \"cull\" \"hidden\" 0\n" + kSphere));
  EXPECT_EQ(r.log.count("rib-unknown-attribute"), 1);
  EXPECT_EQ(r.attributes(0).user.at("cull:hidden").ints[0], 0);
}

TEST(Orientation, ComparesHandednessWithTheCurrentSpace) {
  const Reading r(inWorld("Orientation \"rh\" " + kSphere + "Scale 1 1 -1 Orientation \"rh\" " + kSphere +
                          "ReverseOrientation " + kSphere + "Orientation \"outside\" " + kSphere +
                          "Orientation \"inside\" " + kSphere));
  const bool expected[] = {true, false, true, false, true};
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(r.attributes(i).insideOut, expected[i]) << i;
}

TEST(Shaders, RememberTheirSpaceInTheWorld) {
  const Reading r("Translate 0 0 5 Surface \"plastic\" \"Ks\" .3 " +
                  inWorld(kSphere + "Translate 1 0 0 Displacement \"dented\" Translate 1 0 0 " + kSphere));
  const ShaderCall& surface = *r.attributes(0).surface;
  EXPECT_EQ(surface.name, "plastic");
  EXPECT_FLOAT_EQ(findParam(surface.params, "Ks")->number(0), .3f);
  expectNear(transformPoint(surface.worldFromShader.at(0), {0, 0, 0}), {0, 0, 0});
  expectNear(transformPoint(r.attributes(1).displacement->worldFromShader.at(0), {0, 0, 0}), {1, 0, 0});
}

TEST(Lights, OutsideTheWorldKeepTheirPlace) {
  const Reading r("LightSource \"pointlight\" 1 Translate 0 0 5 " +
                  inWorld("Translate 0 2 0 LightSource \"spotlight\" 2 " + kSphere));
  ASSERT_EQ(r.scene().lights.size(), 2u);
  expectNear(transformPoint(r.scene().lights[0]->shader.worldFromShader.at(0), {0, 0, 0}), {0, 0, -5});
  expectNear(transformPoint(r.scene().lights[1]->shader.worldFromShader.at(0), {0, 0, 0}), {0, 2, 0});
  EXPECT_EQ(r.attributes(0).lights, (std::vector<int>{0, 1}));
  EXPECT_EQ(r.scene().lights[1]->index, 1);
}

TEST(Lights, AreSwitchedByIlluminateWithinTheScope) {
  const Reading r(inWorld(
      "LightSource \"pointlight\" 1 AttributeBegin LightSource \"pointlight\" \"key\" Illuminate 1 0 " +
      kSphere + "AttributeEnd " + kSphere + "Illuminate \"key\" 1 " + kSphere));
  EXPECT_EQ(r.attributes(0).lights, std::vector<int>{1});
  EXPECT_EQ(r.attributes(1).lights, std::vector<int>{0});
  EXPECT_EQ(r.attributes(2).lights, (std::vector<int>{0, 1}));
}

TEST(Lights, CastShadowsWhenAskedTo) {
  const Reading r(inWorld(
      R"(LightSource "spotlight" 1 "shadowname" "raytrace" LightSource "spotlight" 2 "shadowname" "a.shad"
    AttributeBegin Attribute "light" "shadows" "on" LightSource "pointlight" 3 AttributeEnd LightSource "pointlight" 4)"));
  const bool expected[] = {true, false, true, false};
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(r.scene().lights.at(i)->castsShadows, expected[i]) << i;
}

TEST(Shaders, NullSurfaceIsSeenByNobodyUntilTheNextSurface) {
  const Reading r(inWorld("AreaLightSource \"arealight\" 1 Surface \"null\" " + kSphere +
                          "Surface \"matte\" Atmosphere \"fog\" \"distance\" 9 " + kSphere +
                          "Atmosphere \"null\" " + kSphere));
  const Visibility& v = r.attributes(0).visibility;
  EXPECT_FALSE(v.camera || v.diffuse || v.specular || v.transmission);
  EXPECT_EQ(r.attributes(0).areaLight, 0);
  EXPECT_TRUE(r.attributes(1).visibility.camera && r.attributes(1).surface->name == "matte");
  ASSERT_TRUE(r.attributes(1).atmosphere);
  EXPECT_EQ(r.attributes(1).atmosphere->name, "fog");
  EXPECT_FALSE(r.attributes(2).atmosphere);
}

TEST(Lights, OfAreaBelongToTheGeometryThatFollows) {
  const Reading r(inWorld(kSphere + "AttributeBegin AreaLightSource \"arealight\" 3 \"intensity\" 2 " +
                          kSphere + "AttributeEnd " + kSphere));
  ASSERT_EQ(r.scene().lights.size(), 1u);
  EXPECT_TRUE(r.scene().lights[0]->area && r.scene().lights[0]->castsShadows);
  EXPECT_EQ(r.attributes(0).areaLight, -1);
  EXPECT_EQ(r.attributes(1).areaLight, 0);
  EXPECT_EQ(r.attributes(1).lights, std::vector<int>{0});
  EXPECT_EQ(r.attributes(2).areaLight, -1);
}

TEST(ShadingRate, IsMultipliedByRelativeRatesDownTheBlocks) {
  const Reading r(inWorld("ShadingRate 2 Attribute \"shade\" \"float relativeshadingrate\" 3 Sphere 1 -1 1 360\n"
                          "AttributeBegin ShadingRate 5 Attribute \"shade\" \"float relativeshadingrate\" 2 Sphere 1 -1 1 360 AttributeEnd\n"
                          "Attribute \"shade\" \"float resetrelativeshadingrate\" .5 Sphere 1 -1 1 360\n"
                          "Attribute \"shade\" \"float relativeshadingrate\" 0 Sphere 1 -1 1 360"));
  EXPECT_EQ(r.attributes(0).shadingRate, 6);
  EXPECT_EQ(r.attributes(1).shadingRate, 30);
  EXPECT_EQ(r.attributes(2).shadingRate, 1);
  EXPECT_EQ(r.attributes(3).shadingRate, 1);
  EXPECT_EQ(r.codes(), "rib-attribute@5 ");
}

TEST(Visibility, UnderstandsTheNamesOfOldScenes) {
  const Reading r(inWorld("Attribute \"visibility\" \"int trace\" 0 \"string transmission\" \"transparent\" Sphere 1 -1 1 360\n"
                          "Attribute \"visibility\" \"string transmission\" \"Os\" Sphere 1 -1 1 360\n"
                          "Attribute \"visibility\" \"string transmission\" \"shader\" Sphere 1 -1 1 360"));
  EXPECT_FALSE(r.attributes(0).visibility.diffuse || r.attributes(0).visibility.specular || r.attributes(0).visibility.transmission);
  EXPECT_TRUE(r.attributes(1).visibility.transmission);
  EXPECT_EQ(r.attributes(1).transmissionHitMode, HitMode::Primitive);
  EXPECT_EQ(r.attributes(2).transmissionHitMode, HitMode::Shader);
  EXPECT_TRUE(r.log.entries().empty()) << r.codes();
}

TEST(ColorSamples, MakeRedGreenAndBlueOfOtherColors) {
  const Reading r("ColorSamples [1 0 0  0 .5 .5] [1 0 0  0 1 1]\n" +
                  inWorld("Color .25 .5 Surface \"plastic\" \"color specularcolor\" [0 1]\n"
                          "Polygon \"P\" [0 0 0 1 0 0 0 1 0] \"Cs\" [1 0 0 1 1 1]\n"
                          "ColorSamples [] [] Color 1 2 3 Sphere 1 -1 1 360\nColorSamples [1] [1]"));
  EXPECT_EQ(r.attributes(0).color, vec3(.25f, .25f, .25f));
  EXPECT_EQ(findParam(r.attributes(0).surface->params, "specularcolor")->floats, (std::vector<float>{0, .5f, .5f}));
  std::vector<float> corners = r.object(0).shape().primvars().at(0).values;
  corners.resize(9);  // those of points that triangles are cut at follow
  EXPECT_EQ(corners, (std::vector<float>{1, 0, 0, 0, .5f, .5f, 1, .5f, .5f}));
  EXPECT_EQ(r.attributes(1).color, vec3(1, 2, 3));
  EXPECT_EQ(r.codes(), "rib-option@6 ");
}

TEST(Edits, AreLeftOutAsAWhole) {
  const Reading r(inWorld("EditBegin \"attribute\" Color 1 0 0 EditAttributeBegin \"x\" Color 0 1 0 EditAttributeEnd Color 0 0 1 EditEnd\n"
                          "Sphere 1 -1 1 360 EditWorldEnd"));
  EXPECT_EQ(r.attributes(0).color, vec3(1));
  EXPECT_EQ(r.log.count("rib-unsupported"), 2) << r.codes();
}

TEST(Display, MayDeclareWhatItShowsAndQuantizeMayNameIt) {
  const Reading r("Quantize \"mask\" 100 0 100 .25 Display \"a.tif\" \"tiff\" \"varying float mask\" Display \"+b.tif\" \"tiff\" \"Ci\"" +
                  inWorld(""));
  const Options& o = r.scene().options;
  EXPECT_EQ(o.displays[0].mode, "mask");
  EXPECT_EQ(o.channels.at("mask").type, ValueType::Float);
  EXPECT_EQ(findParam(o.displays[0].params, "quantize")->floats, (std::vector<float>{0, 100, 0, 100}));
  EXPECT_EQ(findParam(o.displays[0].params, "dither")->floats, std::vector<float>{.25f});
  EXPECT_TRUE(o.displays[1].params.empty());
}

}  // namespace
}  // namespace tomales
