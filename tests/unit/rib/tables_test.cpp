// Tests the rows of the tables of options and attributes: the last value that is taken, the first that is not, and what
// is said of it.
#include "reyes/base/deep_stack.h"
#include "rib_test_tools.h"

namespace tomales {
namespace {

struct OptionRow {
  const char* text;
  std::string codes;
  std::function<bool(const Options&)> is;
};

Options optionsOf(const std::string& text) { return Reading(text + inWorld("")).scene().options; }

void expectOptions(const std::vector<OptionRow>& rows) {
  for (const OptionRow& row : rows) {
    const Reading r(row.text + inWorld(""));
    EXPECT_EQ(r.codes(), row.codes) << row.text;
    EXPECT_TRUE(row.is(r.scene().options)) << row.text;
  }
}

TEST(OptionTable, HasLimits) {
  const Options plain = optionsOf("");
  const std::string clamped = "rib-clamped@1 ", refused = "rib-option@1 ";
  expectOptions({
      {"Format 32768 32768 1", "", [](const Options& o) { return o.xResolution == 32768 && o.yResolution == 32768; }},
      {"Format 32769 7 1", refused, [&](const Options& o) { return o.xResolution == plain.xResolution; }},
      {"Format 7 32769 1", refused, [&](const Options& o) { return o.yResolution == plain.yResolution; }},
      {"Format 0.5 0.5 2", "", [](const Options& o) { return o.xResolution == 1 && o.yResolution == 1; }},
      {"Format 0 9 0", "",
       [&](const Options& o) {
         return o.xResolution == plain.xResolution && o.yResolution == 9 && o.pixelAspect == plain.pixelAspect;
       }},
      {"Format 9 0 -1", "", [&](const Options& o) { return o.yResolution == plain.yResolution && o.xResolution == 9; }},
      {"Format 9 9 1e-4", clamped, [](const Options& o) { return o.pixelAspect == 1e-3f; }},
      {"Format 9 9 1e4", clamped, [](const Options& o) { return o.pixelAspect == 1e3f; }},
      {"FrameAspectRatio 1e-4", refused, [](const Options& o) { return !o.frameAspect; }},
      {"FrameAspectRatio 1e4", refused, [](const Options& o) { return !o.frameAspect; }},
      {"FrameAspectRatio 1.1e-4", "", [](const Options& o) { return o.frameAspect == 1.1e-4f; }},
      {"ScreenWindow 1 1 0 2", refused, [](const Options& o) { return !o.screenWindow; }},
      {"ScreenWindow 0 2 1 1", refused, [](const Options& o) { return !o.screenWindow; }},
      {"ScreenWindow 1 -1 2 3", "",
       [](const Options& o) {
         return o.screenWindow == std::array<float, 4>{1, -1, 2, 3};
       }},
      {"CropWindow .5 .5 0 1", refused, [&](const Options& o) { return o.cropWindow == plain.cropWindow; }},
      {"CropWindow 0 1 .5 .5", refused, [&](const Options& o) { return o.cropWindow == plain.cropWindow; }},
      {"CropWindow -1 .5 .25 2", clamped + clamped,
       [](const Options& o) {
         return o.cropWindow == std::array<float, 4>{0, .5f, .25f, 1};
       }},
      {"Clipping 1 1", refused, [&](const Options& o) { return o.nearClip == plain.nearClip; }},
      {"Clipping 0 1e40", clamped, [](const Options& o) { return o.nearClip == 1e-6f && o.farClip == 1e30f; }},
      {"RelativeDetail -.1", refused, [](const Options& o) { return o.relativeDetail == 1; }},
      {"RelativeDetail 0", "", [](const Options& o) { return o.relativeDetail == 0; }},
      {"DepthOfField 2 3 4", "",
       [](const Options& o) { return o.fStop == 2 && o.focalLength == 3 && o.focalDistance == 4; }},
      {"DepthOfField 0 3 4", refused, [](const Options& o) { return o.fStop == kInfinity; }},
      {"DepthOfField 2 0 4", refused, [](const Options& o) { return o.fStop == kInfinity; }},
      {"DepthOfField 2 3 0", refused, [](const Options& o) { return o.fStop == kInfinity; }},
      {"DepthOfField 2 3 4 DepthOfField", "", [](const Options& o) { return o.fStop == kInfinity; }},
      {"Shutter 1 1", "", [](const Options& o) { return o.shutterOpen == 1 && o.shutterClose == 1; }},
      {"Shutter 1 .9", refused, [](const Options& o) { return o.shutterOpen == 0; }},
      {"PixelSamples 256 1", "", [](const Options& o) { return o.xSamples == 256 && o.ySamples == 1; }},
      {"PixelSamples 0 257", clamped + clamped, [](const Options& o) { return o.xSamples == 1 && o.ySamples == 256; }},
      {"PixelFilter \"box\" 0 1", refused, [&](const Options& o) { return o.filter == plain.filter; }},
      {"PixelFilter \"box\" 1 0", refused, [&](const Options& o) { return o.filter == plain.filter; }},
      {"PixelFilter \"box\" 1e-4 65", clamped + clamped,
       [](const Options& o) { return o.xFilterWidth == 1 && o.yFilterWidth == 32; }},
      {"Exposure 2 0", refused, [](const Options& o) { return o.exposureGain == 1; }},
      {"Option \"limits\" \"bucketsize\" [0 4097]", clamped + clamped,
       [](const Options& o) { return o.bucketWidth == 1 && o.bucketHeight == 4096; }},
      {"Option \"limits\" \"bucketsize\" [7]", "rib-unknown-option@1 ",
       [&](const Options& o) { return o.bucketWidth == plain.bucketWidth; }},
      {"Option \"limits\" \"gridsize\" [0]", clamped, [](const Options& o) { return o.gridSize == 1; }},
      {"Option \"limits\" \"gridsize\" [65537]", clamped, [](const Options& o) { return o.gridSize == 65536; }},
      {"Option \"trace\" \"int maxdepth\" [-1]", clamped, [](const Options& o) { return o.maxRayDepth == 0; }},
      {"Option \"trace\" \"int maxdepth\" [3]", "", [](const Options& o) { return o.maxRayDepth == 3; }},
      {"Option \"limits\" \"color othreshold\" [.1 .2 .3]", "",
       [](const Options& o) { return o.opaqueThreshold == vec3(.1f, .2f, .3f); }},
      {"Option \"limits\" \"color zthreshold\" [.1 .2 .3]", "",
       [](const Options& o) { return o.depthThreshold == vec3(.1f, .2f, .3f); }},
      {"Option \"bucket\" \"string order\" \"circle\"", "", [](const Options& o) { return o.bucketOrder == "spiral"; }},
      {"Option \"bucket\" \"string order\" \"zigzag-y\"", "",
       [](const Options& o) { return o.bucketOrder == "zigzag-y"; }},
      {"Option \"bucket\" \"string order\" \"none\"", "rib-bucket-order@1 ",
       [&](const Options& o) { return o.bucketOrder == plain.bucketOrder; }},
      {"Hider \"hidden\" \"float dofaspect\" 0.001", clamped, [](const Options& o) { return o.dofAspect == 0.01f; }},
      {"Hider \"hidden\" \"float dofaspect\" 101", clamped, [](const Options& o) { return o.dofAspect == 100; }},
      {"Hider \"hidden\" \"float dofaspect\" 0", "rib-unsupported@1 ",
       [](const Options& o) { return o.dofAspect == 1; }},
      {"Hider \"hidden\" \"float[4] aperture\" [65 1 2 -2]", clamped + clamped + clamped,
       [](const Options& o) {
         return o.aperture.sides == 64 && o.aperture.roundness == 1 && o.aperture.density == -1;
       }},
      {"Hider \"stochastic\" \"int jitter\" 1", "", [](const Options& o) { return o.jitter; }},
      {"Hider \"raytrace\" \"int maxsamples\" 10", "rib-unsupported@1 ",
       [](const Options& o) { return o.xSamples == 4 && o.ySamples == 4; }},
      {"Hider \"hidden\" \"int maxsamples\" 10", "rib-unsupported@1 ",
       [&](const Options& o) { return o.xSamples == plain.xSamples; }},
      {"Hider \"raytrace\" \"int maxsamples\" 0", "rib-unsupported@1 rib-unsupported@1 ",
       [&](const Options& o) { return o.xSamples == plain.xSamples; }},
      {"Hider \"hidden\" \"float dofaspect\" 0", "rib-unsupported@1 ",
       [&](const Options& o) { return o.dofAspect == plain.dofAspect; }},
      {"Hider \"hidden\" \"float[3] aperture\" [5 1 0]", "rib-unsupported@1 ",
       [&](const Options& o) { return o.aperture.sides == plain.aperture.sides; }},
      {"Hider \"hidden\" \"string sorting\" \"max\"", "rib-unsupported@1 ",
       [&](const Options& o) { return o.depthFilter == plain.depthFilter; }},
      {"Hider \"hidden\" \"float depthfilter\" 1", "rib-unsupported@1 ",
       [&](const Options& o) { return o.depthFilter == plain.depthFilter; }},
      {"Hider \"hidden\" \"string depthfilter\" \"max\"", "",
       [](const Options& o) { return o.depthFilter == DepthFilter::Max; }},
      {"Hider \"hidden\" \"string depthfilter\" \"average\"", "",
       [](const Options& o) { return o.depthFilter == DepthFilter::Average; }},
      {"Hider \"hidden\" \"string depthfilter\" \"max\" Hider \"hidden\" \"string depthfilter\" \"min\"", "",
       [](const Options& o) { return o.depthFilter == DepthFilter::Min; }},
      {"Quantize \"rgb\" 255 1 254 .25", "",
       [](const Options& o) {
         return o.quantizeGiven && o.rgbaQuantize.min == 1 && o.rgbaQuantize.max == 254 &&
                o.rgbaQuantize.dither == .25f;
       }},
      {"Quantize \"z\" 9 1 8 .5", "",
       [](const Options& o) {
         return !o.quantizeGiven && o.depthQuantize.one == 9 && o.depthQuantize.min == 1 && o.depthQuantize.max == 8 &&
                o.depthQuantize.dither == .5f;
       }},
  });
}

TEST(OptionTable, KnowsWhatOthersReadAndNamesTheRest) {
  for (const char* known : {"\"user\" \"float x\" 1", "\"shadow\" \"float bias0\" 1", "\"shadow\" \"float bias\" 1",
                            "\"shade\" \"string specular\" \"x\"", "\"shade\" \"string arealight\" \"x\"",
                            "\"render\" \"int prmanspecular\" 1", "\"texture\" \"string width\" \"x\"",
                            "\"texture\" \"string filter\" \"x\"", "\"limits\" \"int texturememory\" 1",
                            "\"limits\" \"int geocachememory\" 1", "\"ribparse\" \"string varsubst\" \"$\""})
    EXPECT_EQ(Reading(std::string("Option ") + known + inWorld("")).codes(), "") << known;
  EXPECT_EQ(Reading("Option \"limits\" \"float nothing\" 1" + inWorld("")).codes(), "rib-unknown-option@1 ");
}

TEST(ProjectionTable, HasTheWordsOfBothErasAndRefusesOtherFields) {
  const auto kind = [](const std::string& word) { return optionsOf("Projection \"" + word + "\" ").projection; };
  for (const char* word : {"perspective", "PxrPerspective", "PxrCamera"})
    EXPECT_EQ(kind(word), ProjectionKind::Perspective) << word;
  EXPECT_EQ(optionsOf("Projection \"perspective\" Projection \"PxrOrthographic\"").projection,
            ProjectionKind::Orthographic);
  EXPECT_EQ(optionsOf("Projection \"perspective\" Projection \"orthographic\"").projection,
            ProjectionKind::Orthographic);
  EXPECT_EQ(kind("null"), ProjectionKind::Null);
  EXPECT_EQ(Reading("Projection \"fish\"" + inWorld("")).codes(), "rib-option@1 ");
  const auto field = [](const std::string& degrees, const char* codes) {
    const Reading r("Projection \"perspective\" \"fov\" " + degrees + inWorld(""));
    EXPECT_EQ(r.codes(), codes) << degrees;
    return r.scene().options.fov_degrees;
  };
  EXPECT_EQ(field("179", ""), 179);
  EXPECT_EQ(field("180", "rib-option@1 "), 90);
  EXPECT_EQ(field("0", "rib-option@1 "), 90);
  EXPECT_EQ(Reading("Projection \"perspective\" \"float x\" 1" + inWorld("")).codes(), "rib-unsupported@1 ");
  const Reading late(inWorld("Translate 1 0 0 Projection \"perspective\" " + kSphere));
  EXPECT_EQ(late.scene().options.projection, ProjectionKind::Orthographic);
  expectNear(vec3(late.object(0).worldFromObject.at(0)[3]), {1, 0, 0});
}

TEST(ProjectionTable, LensesOfPxrCameraNeedAllOfTheirThreeValues) {
  const std::string stop = "\"float fStop\" 8 ", length = "\"float focalLength\" .05 ",
                    distance = "\"float focalDistance\" 3 ";
  const Reading r("Projection \"PxrCamera\" " + stop + length + distance + inWorld(""));
  const Options& o = r.scene().options;
  EXPECT_TRUE(o.fStop == 8 && o.focalLength == .05f && o.focalDistance == 3);
  EXPECT_EQ(r.codes(), "");
  for (const std::string& some :
       {stop + length, stop + distance, length + distance, "\"float fStop\" 0 " + length + distance,
        "\"float fStop\" 1e31 " + length + distance, "\"float fStop\" -1 " + length + distance})
    EXPECT_EQ(optionsOf("Projection \"PxrCamera\" " + some).fStop, kInfinity) << some;
}

TEST(ClippingPlanes, CutWhatTheirNormalsPointToInTheSpaceOfTheRequest) {
  const Reading r("Translate 1 0 2 Scale 2 1 1 ClippingPlane 3 0 0 2 0 0 ClippingPlane 0 0 0 0 0 0 " + inWorld(""));
  EXPECT_EQ(r.codes(), "rib-option@1 ");
  ASSERT_EQ(r.scene().options.clippingPlanes.size(), 1u);
  const vec4 plane = r.scene().options.clippingPlanes[0];
  expectNear(vec3(plane), {1, 0, 0});
  EXPECT_FLOAT_EQ(plane.w, -7) << "the point is at 7 in the camera's space";
}

struct AttributeRow {
  const char* text;
  std::string codes;
  std::function<bool(const Attributes&)> is;
};

void expectAttributes(const std::vector<AttributeRow>& rows) {
  for (const AttributeRow& row : rows) {
    const Reading r("WorldBegin " + std::string(row.text) + " " + kSphere + "WorldEnd");
    EXPECT_EQ(r.codes(), row.codes) << row.text;
    EXPECT_TRUE(row.is(r.attributes(0))) << row.text;
  }
}

TEST(AttributeTable, HasLimits) {
  const std::string refused = "rib-attribute@1 ", unknown = "rib-unknown-attribute@1 ";
  expectAttributes({
      {"ShadingRate 0", refused, [](const Attributes& a) { return a.shadingRate == 1; }},
      {"GeometricApproximation \"motionfactor\" 0", "", [](const Attributes& a) { return a.motionFactor == 0; }},
      {"GeometricApproximation \"motionfactor\" -1", refused, [](const Attributes& a) { return a.motionFactor == 0; }},
      {"GeometricApproximation \"focusfactor\" 3", "", [](const Attributes& a) { return a.focusFactor == 3; }},
      {"GeometricApproximation \"flatness\" 3", "rib-unsupported@1 ",
       [](const Attributes& a) { return a.focusFactor == 1 && a.motionFactor == 0; }},
      {"ShadingInterpolation \"smooth\" ShadingInterpolation \"constant\"", "",
       [](const Attributes& a) { return a.interpolation == ShadingInterpolation::Constant; }},
      {"ShadingInterpolation \"rough\"", refused, [](const Attributes&) { return true; }},
      {"Sides 1 Sides 2", "", [](const Attributes& a) { return a.sides == 2; }},
      {"Sides 1 Sides 3", refused, [](const Attributes& a) { return a.sides == 1; }},
      {"Sides 1 Sides 0", refused, [](const Attributes& a) { return a.sides == 1; }},
      {"Orientation \"up\"", refused, [](const Attributes& a) { return !a.insideOut; }},
      {"Matte 2 Matte 0", "", [](const Attributes& a) { return !a.matte; }},
      {"TextureCoordinates 1 2 3 4 5 6 7 8", "",
       [](const Attributes& a) {
         return a.textureCoordinates[0] == vec2(1, 2) && a.textureCoordinates[1] == vec2(3, 4) &&
                a.textureCoordinates[2] == vec2(5, 6) && a.textureCoordinates[3] == vec2(7, 8);
       }},
      {"Basis \"bezier\" 0 \"bezier\" 1", refused, [](const Attributes&) { return true; }},
      {"Basis \"bezier\" 1 \"bezier\" 5", refused, [](const Attributes&) { return true; }},
      {"Basis \"bezier\" 4 \"bezier\" 4", "", [](const Attributes&) { return true; }},
      {"Basis \"none\" 1 \"bezier\" 1", refused, [](const Attributes&) { return true; }},
      {"Attribute \"displacementbound\" \"sphere\" -1", "",
       [](const Attributes& a) { return a.displacementBound == 0; }},
      {"Attribute \"bound\" \"displacement\" [-1]", "", [](const Attributes& a) { return a.displacementBound == 0; }},
      {"Attribute \"visibility\" \"int trace\" 0", "",
       [](const Attributes& a) {
         const Visibility& v = a.visibility;
         return !v.diffuse && !v.specular && v.camera && v.transmission && v.photon;
       }},
      {"Attribute \"visibility\" \"int indirect\" 0", "",
       [](const Attributes& a) { return !a.visibility.diffuse && !a.visibility.specular && a.visibility.camera; }},
      {"Attribute \"visibility\" \"int photon\" 0", "", [](const Attributes& a) { return !a.visibility.photon; }},
      {"Attribute \"visibility\" \"int camera\" 0 \"int diffuse\" 0 \"int specular\" 0 \"int transmission\" 0 "
       "Attribute \"visibility\" \"int camera\" 1 \"int diffuse\" 1 \"int specular\" 1 \"int transmission\" 1",
       "",
       [](const Attributes& a) {
         const Visibility& v = a.visibility;
         return v.camera && v.diffuse && v.specular && v.transmission;
       }},
      {"Attribute \"trace\" \"int maxdiffusedepth\" -1 \"int maxspeculardepth\" 1000000", "",
       [](const Attributes& a) { return a.trace.maxDiffuseDepth == 0 && a.trace.maxSpecularDepth == kMostBounces; }},
      {"Attribute \"trace\" \"int maxdiffusedepth\" 1000000 \"int maxspeculardepth\" -1", "",
       [](const Attributes& a) { return a.trace.maxDiffuseDepth == kMostBounces && a.trace.maxSpecularDepth == 0; }},
      {"Attribute \"trace\" \"int displacements\" 0 \"int samplemotion\" 0", "",
       [](const Attributes& a) {
         return !a.trace.displacements && a.trace.displacementsGiven && !a.trace.sampleMotion;
       }},
      {"", "", [](const Attributes& a) { return !a.trace.displacementsGiven && a.trace.sampleMotion; }},
      {"Attribute \"trace\" \"string tessellationmode\" \"full\"", "",
       [](const Attributes& a) { return a.trace.rate == TessellationMode::Full; }},
      {"Attribute \"trace\" \"string tessellationmode\" \"multiresolution\"", "",
       [](const Attributes& a) { return a.trace.rate == TessellationMode::Multiresolution; }},
      {"Attribute \"trace\" \"string tessellationmode\" \"x\"", unknown,
       [](const Attributes& a) { return a.trace.rate == TessellationMode::Fixed; }},
      {"Attribute \"radiosity\" \"float screentexels\" 3", "",
       [](const Attributes& a) { return a.radiosity.screen && a.radiosity.texelSize == 3; }},
      {"Attribute \"radiosity\" \"float worldtexels\" 4", "",
       [](const Attributes& a) { return !a.radiosity.screen && a.radiosity.texelSize == 4; }},
      {"Attribute \"dice\" \"int binary\" 1", "", [](const Attributes& a) { return a.binaryDice; }},
      {"Attribute \"dice\" \"int rasterorient\" 1", "", [](const Attributes& a) { return a.rasterOrient; }},
      {"Attribute \"cull\" \"int hidden\" 0", "",
       [](const Attributes& a) { return !a.cull.hidden && a.cull.backfacing; }},
      {"Attribute \"cull\" \"int backfacing\" 0", "",
       [](const Attributes& a) { return a.cull.hidden && !a.cull.backfacing; }},
      {"Attribute \"photon\" \"string globalmap\" \"g\" \"string causticmap\" \"c\" \"string shadingmodel\" \"glass\"",
       "",
       [](const Attributes& a) {
         return a.photon.globalMap == "g" && a.photon.causticMap == "c" && a.photon.shadingModel == "glass";
       }},
      {"Attribute \"grouping\" \"string membership\" \"a, b\" Attribute \"grouping\" \"string membership\" \"+c\" "
       "Attribute \"grouping\" \"string membership\" \"-a\"",
       "",
       [](const Attributes& a) {
         return a.membership == std::set<std::string>{"b", "c"};
       }},
      {"Attribute \"grouping\" \"string membership\" \"a\" Attribute \"grouping\" \"string membership\" \"d,e\"", "",
       [](const Attributes& a) {
         return a.membership == std::set<std::string>{"d", "e"};
       }},
      {"Attribute \"grouping\" \"string tracesubset\" \"s\"", "",
       [](const Attributes& a) { return a.trace.subset == "s"; }},
      {"Attribute \"shade\" \"string diffusehitmode\" \"primitive\"", "",
       [](const Attributes& a) {
         return a.diffuseHitMode == HitMode::Primitive && a.specularHitMode == HitMode::Shader;
       }},
      {"Attribute \"shade\" \"string specularhitmode\" \"primitive\"", "",
       [](const Attributes& a) {
         return a.specularHitMode == HitMode::Primitive && a.diffuseHitMode == HitMode::Shader;
       }},
      {"Attribute \"shade\" \"string transmissionhitmode\" \"primitive\"", "",
       [](const Attributes& a) { return a.transmissionHitMode == HitMode::Primitive; }},
      {"Attribute \"shade\" \"string transmissionhitmode\" \"cache\" \"string diffusehitmode\" \"x\"", unknown,
       [](const Attributes& a) {
         return a.transmissionHitMode == HitMode::Shader && a.diffuseHitMode == HitMode::Shader;
       }},
      {"Attribute \"shade\" \"float relativeshadingrate\" -1", refused,
       [](const Attributes& a) { return a.shadingRate == 1; }},
      {"Attribute \"shade\" \"float relativeshadingrate\" 1e9 ShadingRate 2", "",
       [](const Attributes& a) { return a.shadingRate == 2e4f; }},
      {"Attribute \"user\" \"int[] none\" []", refused, [](const Attributes&) { return true; }},
      {"Attribute \"render\" \"float x\" 1", "rib-ignored-attribute@1 ",
       [](const Attributes& a) { return a.user.contains("render:x"); }},
      {"Attribute \"identifier\" \"string shadinggroup\" \"x\"", "",
       [](const Attributes& a) { return a.user.contains("identifier:shadinggroup"); }},
  });
}

}  // namespace
}  // namespace tomales
