// Tests the effect of attributes, shaders and lights on the Scene.
#include <chrono>

#include "rib_test_tools.h"

namespace tomales {
namespace {

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

TEST(Attributes, StringsOfAPrimitiveTakeThePlaceOfThoseOfItsShaders) {
  const Reading r(
      inWorld("Surface \"paintedplastic\" \"string texturename\" [\"a.tx\"]\n"
              "Sphere 1 -1 1 360 \"constant string texturename\" [\"b.tx\"] \"string other\" [\"c\"]\n"
              "Sphere 1 -1 1 360 \"string texturename\" [\"b.tx\"] \"constant string other\" [\"c\"]\n" +
              kSphere));
  const auto texture = [&](int object) {
    return findParam(r.object(static_cast<size_t>(object)).attributes->surface->params, "texturename")->strings;
  };
  EXPECT_EQ(texture(0), std::vector<std::string>{"b.tx"});
  EXPECT_EQ(texture(2), std::vector<std::string>{"a.tx"});
  EXPECT_EQ(r.object(0).attributes, r.object(1).attributes) << "they may be shaded together";
  EXPECT_EQ(r.codes(), "");
}

TEST(Attributes, AreReadFromEveryRequest) {
  const Reading r(inWorld(R"(Color .1 .2 .3 Opacity [.5 .5 .5] TextureCoordinates 0 0 2 0 0 2 2 2 ShadingRate 4
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
  EXPECT_TRUE(a.color == vec3(.1f, .2f, .3f) && a.opacity == vec3(.5f) && a.textureCoordinates[3] == vec2(2, 2));
  EXPECT_TRUE(a.shadingRate == 4 && a.interpolation == ShadingInterpolation::Smooth && a.matte && a.sides == 1);
  EXPECT_TRUE(a.motionFactor == 2 && a.focusFactor == .5f);
  EXPECT_TRUE(a.name == "ball" && a.user.at("user:x").number(0) == 3);
  EXPECT_TRUE(a.displacementBound == 2 && a.displacementBoundSpace == "world");
  const Visibility& v = a.visibility;
  EXPECT_FALSE(v.camera || v.diffuse || v.specular || v.transmission);
  EXPECT_TRUE(a.trace.bias == .1f && a.trace.offset == .2f && a.trace.displacements && a.trace.tessellation == 3);
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
  const Reading r(inWorld("Attribute \"dice\" \"hair\" 0\nAttribute \"dice\" \"hair\" 0\n" + kSphere));
  EXPECT_EQ(r.told("rib-ignored-attribute"), 1);
  EXPECT_EQ(r.attributes(0).user.at("dice:hair").ints[0], 0);
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

TEST(Shaders, OfBeforeTheWorldMoveIntoItsSpace) {
  const Reading r("Translate 0 0 5 Surface \"plastic\" Translate 0 3 0 Displacement \"dented\" Translate 0 0 -1 " +
                  inWorld(kSphere));
  expectNear(transformPoint(r.attributes(0).surface->worldFromShader.at(0), {0, 0, 0}), {0, -3, 1});
  expectNear(transformPoint(r.attributes(0).displacement->worldFromShader.at(0), {0, 0, 0}), {0, 0, 1});
}

TEST(Shaders, NullSurfaceIsSeenByNobodyUntilTheNextSurface) {
  const Reading r(inWorld("AreaLightSource \"arealight\" 1 Surface \"null\" " + kSphere +
                          "Surface \"matte\" Atmosphere \"fog\" \"distance\" 9 " + kSphere + "Atmosphere \"null\" " +
                          kSphere));
  const Visibility& v = r.attributes(0).visibility;
  EXPECT_FALSE(v.camera || v.diffuse || v.specular || v.transmission);
  EXPECT_EQ(r.attributes(0).areaLight, 0);
  EXPECT_TRUE(r.attributes(1).visibility.camera && r.attributes(1).surface->name == "matte");
  ASSERT_TRUE(r.attributes(1).atmosphere);
  EXPECT_EQ(r.attributes(1).atmosphere->name, "fog");
  EXPECT_FALSE(r.attributes(2).atmosphere);
}

TEST(Shaders, NullSurfaceIsThereWhereDepthAloneIsShown) {
  const auto seen = [](const std::string& displays) {
    const Reading r(displays + inWorld("Surface \"null\" " + kSphere));
    return r.attributes(0).visibility.camera;
  };
  EXPECT_TRUE(seen("Display \"a\" \"zfile\" \"z\""));
  EXPECT_TRUE(seen("Display \"a.exr\" \"openexr\" \"z\""));
  EXPECT_FALSE(seen("Display \"a.exr\" \"openexr\" \"rgba\""));
  EXPECT_FALSE(seen("Display \"a\" \"zfile\" \"z\" Display \"+b.exr\" \"openexr\" \"rgba\""));
  EXPECT_FALSE(seen(""));
}

TEST(Attributes, BoundDisplacementIsTheDisplacementBoundOfOldScenes) {
  const Reading r(inWorld("Attribute \"bound\" \"displacement\" [0.25] " + kSphere));
  EXPECT_EQ(r.codes(), "");
  EXPECT_EQ(r.attributes(0).displacementBound, 0.25f);
}

TEST(ShadingRate, IsMultipliedByRelativeRatesDownTheBlocks) {
  const Reading r(
      inWorld("ShadingRate 2 Attribute \"shade\" \"float relativeshadingrate\" 3 Sphere 1 -1 1 360\n"
              "AttributeBegin ShadingRate 5 Attribute \"shade\" \"float relativeshadingrate\" 2 Sphere 1 -1 1 360 "
              "AttributeEnd\n"
              "Attribute \"shade\" \"float resetrelativeshadingrate\" .5 Sphere 1 -1 1 360\n"
              "Attribute \"shade\" \"float relativeshadingrate\" 0 Sphere 1 -1 1 360"));
  EXPECT_EQ(r.attributes(0).shadingRate, 6);
  EXPECT_EQ(r.attributes(1).shadingRate, 30);
  EXPECT_EQ(r.attributes(2).shadingRate, 1);
  EXPECT_EQ(r.attributes(3).shadingRate, 1);
  EXPECT_EQ(r.codes(), "rib-attribute@5 ");
}

TEST(ShadingRate, OfInfinityIsTheCoarsest) {
  const Reading r(inWorld("ShadingRate 1e99 " + kSphere + "ShadingRate 1e-9 " + kSphere));
  EXPECT_EQ(r.attributes(0).shadingRate, 1e8f);
  EXPECT_EQ(r.attributes(1).shadingRate, 1e-3f);
  EXPECT_EQ(r.codes(), "rib-clamped@2 rib-clamped@3 ");
}

TEST(Scene, ShadowLightsOfOldListingsFindTheirMap) {
  const Reading r(
      inWorld("LightSource \"shadowspot\" 1 \"string shadowfile\" \"a.shd\" LightSource \"shadowspot\" 2 \"string "
              "shadowfile\" \"b\" "
              "\"string shadowname\" \"c\" LightSource \"mine\" 3 \"string shadowfile\" \"d\"" +
              std::string(" Sphere 1 -1 1 360")));
  const auto map = [&](size_t light, const char* name) {
    return findParam(r.scene().lights.at(light)->shader.params, name);
  };
  EXPECT_EQ(map(0, "shadowname")->strings[0], "a.shd");
  EXPECT_EQ(map(1, "shadowname")->strings[0], "c");
  EXPECT_EQ(map(2, "shadowname"), nullptr) << "a shader of one's own may mean what it likes";
}

TEST(Scene, CastsShadowsOfBmrtIsWhatShadowRaysSee) {
  const std::string casts = "Attribute \"render\" \"string casts_shadows\" ", sphere = " Sphere 1 -1 1 360\n";
  const Reading r(inWorld(casts + "\"none\"" + sphere + casts + "\"Os\"" + sphere + casts + "\"shade\"" + sphere));
  EXPECT_FALSE(r.attributes(0).visibility.transmission);
  EXPECT_TRUE(r.attributes(0).visibility.camera);
  EXPECT_TRUE(r.attributes(1).visibility.transmission);
  EXPECT_EQ(r.attributes(1).transmissionHitMode, HitMode::Primitive);
  EXPECT_EQ(r.attributes(2).transmissionHitMode, HitMode::Shader);
  EXPECT_TRUE(r.log.entries().empty()) << r.codes();
}

TEST(Visibility, UnderstandsTheNamesOfOldScenes) {
  const Reading r(
      inWorld("Attribute \"visibility\" \"int trace\" 0 \"string transmission\" \"transparent\" Sphere 1 -1 1 360\n"
              "Attribute \"visibility\" \"string transmission\" \"Os\" Sphere 1 -1 1 360\n"
              "Attribute \"visibility\" \"string transmission\" \"shader\" Sphere 1 -1 1 360"));
  EXPECT_FALSE(r.attributes(0).visibility.diffuse || r.attributes(0).visibility.specular ||
               r.attributes(0).visibility.transmission);
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
  const Reading r(inWorld(
      "EditBegin \"attribute\" Color 1 0 0 EditAttributeBegin \"x\" Color 0 1 0 EditAttributeEnd Color 0 0 1 EditEnd\n"
      "Sphere 1 -1 1 360 EditWorldEnd"));
  EXPECT_EQ(r.attributes(0).color, vec3(1));
  EXPECT_EQ(r.log.count("rib-unsupported"), 2) << r.codes();
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
  const Reading r("Translate 0 0 5 Resource \"c\" \"attributes\" \"string operation\" \"save\"" +
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

TEST(Interning, ManyObjectsThatDifferInTheirPlaceAloneAreGroupedInTime) {
  // Compared with all of those before, they took ten minutes.
  std::string text;
  for (int i = 0; i < 200000; ++i) text += "Translate 1 0 0 Sphere 1 -1 1 360\n";
  const auto start = std::chrono::steady_clock::now();
  const Reading r(inWorld(text));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  EXPECT_EQ(r.scene().groups.size(), 200000u);
}

TEST(EmptyMesh, IsAWarningOnly) {
  const Reading r(
      inWorld("PointsPolygons [] [] \"P\" []\nPointsGeneralPolygons [] [] [] \"P\" []\n"
              "SubdivisionMesh \"catmull-clark\" [] [] \"P\" []\n"
              "HierarchicalSubdivisionMesh \"catmull-clark\" [] [] [] [] [] [] [] \"P\" []\n"
              "Points \"P\" []\nPoints \"Pw\" []\nCurves \"linear\" [] \"nonperiodic\" \"P\" []\n" +
              kSphere));
  EXPECT_EQ(r.scene().objects.size(), 1u);
  EXPECT_EQ(r.log.count("rib-empty-mesh"), 7) << r.codes();
  EXPECT_EQ(r.log.worst(), Severity::Warning);
}

TEST(Shaders, BeforeTheWorldKeepTheSpaceInWhichTheyWereNamed) {
  const Reading r(
      "Translate 0 0 5 Surface \"matte\" Displacement \"dented\" Atmosphere \"fog\" Interior \"a\" Exterior \"b\" "
      "Imager \"background\"" +
      inWorld(kSphere));
  const Attributes& a = r.attributes(0);
  for (const auto& call : {a.displacement, a.atmosphere, a.interior, a.exterior})
    EXPECT_EQ(call->worldFromShader, a.surface->worldFromShader) << call->name;
  EXPECT_EQ(r.scene().options.imager->worldFromShader, a.surface->worldFromShader);
  EXPECT_EQ(r.scene().cameraFromWorld * a.surface->worldFromShader, r.scene().cameraFromWorld);
}

TEST(Resource, OfShadingHoldsTheAtmosphere) {
  const Reading r(inWorld(
      "AttributeBegin Atmosphere \"fog\" Resource \"r\" \"attributes\" \"string operation\" \"save\" AttributeEnd "
      "Resource \"r\" \"attributes\" \"string operation\" \"restore\" \"string subset\" \"shading\" " +
      kSphere));
  ASSERT_TRUE(r.attributes(0).atmosphere);
}

}  // namespace
}  // namespace tomales
