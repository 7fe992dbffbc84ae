// Tests what requests of the RIS era are translated to.
#include "rib_test_tools.h"

namespace tomales {
namespace {

TEST(Ris, BxdfsBecomeStandardShaders) {
  const Reading r(
      inWorld("Bxdf \"PxrDiffuse\" \"d\" \"color diffuseColor\" [.1 .2 .3] " + kSphere + "Bxdf \"PxrDiffuse\" \"e\" " +
              kSphere + "Bxdf \"PxrDisney\" \"f\" \"color baseColor\" [.4 .5 .6] \"float roughness\" .25 " + kSphere));
  EXPECT_EQ(r.attributes(0).surface->name, "matte");
  EXPECT_EQ(r.attributes(0).color, vec3(.1f, .2f, .3f));
  EXPECT_EQ(r.attributes(2).surface->name, "disney");
  EXPECT_EQ(findParam(r.attributes(2).surface->params, "roughness")->number(0), .25f);
  EXPECT_EQ(r.told("rib-substitute"), 2) << "once a name";
}

TEST(Ris, AreaLightsEmitAlongTheirZAndStaySwitchedOn) {
  for (const char* kind : {"PxrRectLight", "PxrDiskLight", "PxrSphereLight"}) {
    const Reading r(
        inWorld("Attribute \"visibility\" \"int camera\" 0 \"int indirect\" 0 Light \"" + std::string(kind) +
                "\" \"key\" \"float intensity\" 3 \"float exposure\" 2 \"__instanceid\" [\"k\"]\n" + kSphere));
    ASSERT_EQ(r.scene().lights.size(), 1u) << kind;
    EXPECT_TRUE(r.scene().lights[0]->area);
    EXPECT_EQ(findParam(r.scene().lights[0]->shader.params, "intensity")->number(0), 12);
    EXPECT_EQ(r.attributes(0).areaLight, 0);
    EXPECT_FALSE(r.attributes(0).visibility.camera || r.attributes(0).visibility.transmission ||
                 r.attributes(0).visibility.diffuse);
    EXPECT_EQ(r.attributes(1).areaLight, -1);
    EXPECT_TRUE(r.attributes(1).visibility.transmission);
    EXPECT_EQ(r.attributes(1).lights, LightList{0});
    if (kind == std::string("PxrSphereLight")) continue;
    std::vector<float> x(12);
    const float half = .5f;
    r.object(0).shape().evaluate(
        0, 1, &half, &half, {&x[0], &x[1], &x[2], &x[3], &x[4], &x[5], &x[6], &x[7], &x[8], &x[9], &x[10], &x[11]});
    EXPECT_GT(x[11], 0) << kind;
  }
}

TEST(Ris, LightsOutlastTheirBlock) {
  const Reading r(inWorld("AttributeBegin AttributeBegin Light \"PxrDistantLight\" \"sun\" " + kSphere +
                          "AttributeEnd " + kSphere + "Illuminate \"sun\" 0 " + kSphere + "AttributeEnd " + kSphere));
  for (const size_t i : {0u, 1u, 3u}) EXPECT_EQ(r.attributes(i).lights, LightList{0}) << i;
  EXPECT_TRUE(r.attributes(2).lights.empty());
}

TEST(Ris, LightsShineOnObjectsBeforeThemToo) {
  const Reading r(inWorld(kSphere + "AttributeBegin Light \"PxrDomeLight\" \"sky\" AttributeEnd\n" + kSphere +
                          "Illuminate \"sky\" 0\n" + kSphere + "Light \"PxrDistantLight\" \"sun\"\n" + kSphere));
  EXPECT_EQ(r.attributes(0).lights, (LightList{0, 1}));
  EXPECT_EQ(r.attributes(1).lights, (LightList{0, 1}));
  EXPECT_EQ(r.attributes(2).lights, LightList{1}) << "what Illuminate has switched off stays off";
  EXPECT_EQ(r.attributes(3).lights, LightList{1});
}

TEST(Ris, LightsShineOnProceduralsBeforeThemToo) {
  const Reading r("ArchiveBegin \"inner\" " + kSphere + "ArchiveEnd ArchiveBegin \"outer\" " + kSphere +
                  "Procedural \"DelayedReadArchive\" [\"inner\"] [-1 1 -1 1 -1 1] ArchiveEnd\n" +
                  inWorld("Procedural \"DelayedReadArchive\" [\"outer\"] [-1 1 -1 1 -1 1]\n"
                          "Light \"PxrDistantLight\" \"sun\"\n"));
  ASSERT_EQ(r.scene().objects.size(), 2u);
  for (const size_t i : {0u, 1u}) EXPECT_EQ(r.attributes(i).lights, LightList{0}) << i;
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
  const Reading path("Integrator \"PxrPathTracer\" \"i\"" +
                     inWorld("Light \"PxrDomeLight\" \"sky\" \"string lightColorMap\" \"sky.exr\" " + kSphere));
  ASSERT_EQ(path.scene().lights.size(), 2u);
  EXPECT_EQ(path.scene().lights[0]->shader.name, "indirectlight");
  EXPECT_EQ(path.scene().lights[1]->shader.name, "environmentlight");
  EXPECT_TRUE(Reading("Integrator \"PxrDirectLighting\" \"i\"" + inWorld(kSphere)).scene().lights.empty());
  EXPECT_EQ(
      Reading("Hider \"raytrace\" \"int maxsamples\" 256 \"int incremental\" 1" + inWorld("")).scene().options.xSamples,
      8);
}

TEST(Ris, ReferencesAreFollowedToPatternsThatHaveASubstitute) {
  const Reading r(
      inWorld("Pattern \"PxrTexture\" \"wood\" \"string filename\" \"wood.tif\" Pattern \"PxrChecker\" \"board\" "
              "\"color colorA\" [1 0 0] \"reference struct manifold\" [\"noise:result\"]\n"
              "Pattern \"PxrPrimvar\" \"own\" \"string varname\" \"Cs\"\nPattern \"PxrFractal\" \"noise\"\n"
              "Bxdf \"PxrDiffuse\" \"a\" \"reference color diffuseColor\" \"wood:resultRGB\" " +
              kSphere + "Bxdf \"PxrDisney\" \"b\" \"reference color baseColor\" [\"board:resultRGB\"] \"int[] x\" [] " +
              kSphere + "Color .2 .3 .4 Bxdf \"PxrDiffuse\" \"c\" \"reference color diffuseColor\" \"own:resultRGB\" " +
              kSphere + "Bxdf \"PxrDiffuse\" \"d\" \"reference color diffuseColor\" \"noise:resultRGB\" " + kSphere +
              "Bxdf \"PxrDiffuse\" \"e\" \"reference color diffuseColor\" \"nowhere:resultRGB\" " + kSphere));
  EXPECT_EQ(r.attributes(0).surface->name, "paintedplastic");
  EXPECT_EQ(findParam(r.attributes(0).surface->params, "texturename")->strings[0], "wood.tif");
  EXPECT_EQ(r.attributes(1).color, vec3(.5f, 0, 0));
  EXPECT_EQ(r.attributes(2).color, vec3(.2f, .3f, .4f));
  EXPECT_EQ(r.attributes(3).color, vec3(.5f));
  EXPECT_EQ(r.log.count("rib-undeclared"), 0) << "references to manifolds are those of PRMan";
  EXPECT_EQ(r.log.count("rib-reference"), 1);
  EXPECT_EQ(r.message("rib-reference").where.line, 9);
  // Two Bxdfs and four patterns.
  EXPECT_EQ(r.told("rib-substitute"), 2 + 4) << r.codes();
}

TEST(Ris, MetalsMirrorAndGlassRefracts) {
  const Reading r(inWorld("Bxdf \"PxrDisney\" \"m\" \"float metallic\" 1 \"color baseColor\" [1 .5 0] " + kSphere +
                          "Bxdf \"PxrSurface\" \"s\" \"float diffuseGain\" 0 \"color specularEdgeColor\" [.9 .8 .7] " +
                          kSphere + "Bxdf \"PxrGlass\" \"g\" \"float ior\" 1.3 " + kSphere));
  EXPECT_EQ(r.attributes(0).surface->name, "disney");
  EXPECT_EQ(findParam(r.attributes(0).surface->params, "metallic")->number(0), 1);
  EXPECT_EQ(findParam(r.attributes(1).surface->params, "reflections")->number(0), 4);
  EXPECT_EQ(r.attributes(0).color, vec3(1, .5f, 0));
  EXPECT_EQ(r.attributes(1).color, vec3(.9f, .8f, .7f));
  EXPECT_EQ(r.attributes(2).surface->name, "glass");
}

TEST(Ris, SurfacesThatRefractAreGlass) {
  const Reading r(
      inWorld("Bxdf \"PxrSurface\" \"g\" \"float diffuseGain\" 0 \"float refractionGain\" 1 \"float glassIor\" 1.7 "
              "\"color refractionColor\" [0 .9 0] " +
              kSphere + "Bxdf \"PxrSurface\" \"o\" \"float glassIor\" 1.7 " + kSphere +
              "Bxdf \"LamaDielectric\" \"l\" \"float IOR\" 1.3 " + kSphere));
  EXPECT_EQ(r.attributes(0).surface->name, "glass");
  EXPECT_EQ(findParam(r.attributes(0).surface->params, "eta")->number(0), 1.7f);
  EXPECT_EQ(findParam(r.attributes(0).surface->params, "transmitcolor")->floats, (std::vector<float>{0, .9f, 0}));
  EXPECT_EQ(r.attributes(1).surface->name, "disney") << "it refracts nothing";
  EXPECT_EQ(findParam(r.attributes(2).surface->params, "eta")->number(0), 1.3f);
}

TEST(Ris, MetalsHaveTheColorOfTheirIndexOrOfTheArtist) {
  const std::string gold = "\"float diffuseGain\" 0 \"color specularEdgeColor\" [1 1 .5] ";
  const Reading r(
      inWorld("Bxdf \"PxrSurface\" \"p\" \"int specularFresnelMode\" 1 \"color specularIor\" [1 2 3] "
              "\"color specularExtinctionCoeff\" [0 1 0] " +
              gold + kSphere + "Bxdf \"PxrSurface\" \"a\" \"color specularFaceColor\" [.9 .6 .2] " + gold + kSphere +
              "Bxdf \"LamaConductor\" \"l\" \"color reflectivity\" [.9 .7 .3] " + kSphere +
              "Bxdf \"PxrLMMetal\" \"m\" \"color eta\" [3 3 3] \"color kappa\" [0 0 0] " + kSphere));
  // ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2)
  const vec3 physical = r.attributes(0).color, lm = r.attributes(3).color;
  EXPECT_NEAR(physical.x, 0, 1e-6f);
  EXPECT_NEAR(physical.y, .2f, 1e-6f);
  EXPECT_NEAR(physical.z, .125f, 1e-6f);
  EXPECT_EQ(r.attributes(1).color, vec3(.9f, .6f, .2f));
  EXPECT_EQ(r.attributes(2).color, vec3(.9f, .7f, .3f));
  EXPECT_NEAR(lm.x, .25f, 1e-6f);
  EXPECT_EQ(findParam(r.attributes(2).surface->params, "metallic")->number(0), 1);
  EXPECT_EQ(r.told("rib-substitute"), 3) << r.codes();
}

TEST(Ris, LightsOfPRMan20ShineFromTheGeometryThatFollows) {
  for (const char* light :
       {"AreaLightSource \"PxrStdAreaLight\" \"a\"", "AreaLightSource \"PxrAreaLight\" \"a\"",
        "AreaLightSource \"shaders/PxrStdAreaLightShape1_rfm\" \"a\"", "Light \"PxrMeshLight\" \"a\""})
    for (const char* shape :
         {"Geometry \"rectlight\"", "Geometry \"spherelight\"", "Geometry \"disklight\"", "Sphere 1 -1 1 360"}) {
      const Reading r(inWorld("AttributeBegin " + std::string(light) + " \"float intensity\" 3 \"float exposure\" 1\n" +
                              shape + "\nAttributeEnd " + kSphere));
      ASSERT_EQ(r.scene().lights.size(), 1u) << light << shape;
      EXPECT_EQ(findParam(r.scene().lights[0]->shader.params, "intensity")->number(0), 6);
      EXPECT_EQ(r.attributes(0).areaLight, 0);
      EXPECT_EQ(r.attributes(1).lights, LightList{0}) << "it shines beyond its block";
      EXPECT_EQ(r.codes(), "rib-substitute@2 ");
    }
}

TEST(Ris, SkiesOfPRMan20AreDomes) {
  const Reading map(
      inWorld("AreaLightSource \"x/PxrStdEnvMapLightShape1_rfm\" \"sky\" \"string rman__EnvMap\" [\"sky.tx\"] Geometry "
              "\"envsphere\" \"constant float[2] resolution\" [8 4] " +
              kSphere));
  ASSERT_EQ(map.scene().lights.size(), 1u);
  EXPECT_EQ(findParam(map.scene().lights[0]->shader.params, "map")->strings[0], "sky.tx");
  EXPECT_EQ(map.scene().objects.size(), 1u) << "it is not drawn";
  const Reading area(
      inWorld("AttributeBegin AreaLightSource \"PxrStdAreaLight\" \"sky\" \"float intensity\" 3 Geometry \"envsphere\" "
              "AttributeEnd " +
              kSphere));
  EXPECT_EQ(area.scene().lights.back()->shader.name, "environmentlight");
  EXPECT_EQ(findParam(area.scene().lights.back()->shader.params, "intensity")->number(0), 3);
}

TEST(Ris, LightsInObjectsShineFromEachInstance) {
  const Reading r(
      inWorld("ObjectBegin \"lamp\" Scale 1 1 -1 Light \"PxrRectLight\" \"l\" ObjectEnd "
              "AttributeBegin Translate 0 0 5 ObjectInstance \"lamp\" AttributeEnd ObjectInstance \"lamp\" " +
              kSphere));
  EXPECT_EQ(r.scene().lights.size(), 2u);
  EXPECT_EQ(r.attributes(2).lights, (LightList{0, 1}));
}

TEST(Ris, OptionsAndAttributesOfTheCategoryRiAreTheRequestsOfThatName) {
  const Reading r(
      "Option \"Ri\" \"int[2] FormatResolution\" [64 36] \"float FormatPixelAspectRatio\" [2] \"string "
      "PixelFilterName\" [\"gaussian\"]\n"
      "\"float[2] PixelFilterWidth\" [3 4] \"float[2] Clipping\" [0.1 100] \"float[4] ScreenWindow\" [-1 1 -0.5 0.5]\n"
      "\"float[4] CropWindow\" [0 .5 0 1] \"float[2] Shutter\" [0 .25] \"float Wisdom\" 1" +
      inWorld(
          "Attribute \"Ri\" \"int Sides\" 1 \"int Matte\" 1 \"float ShadingRate\" 4 \"string Orientation\" \"inside\" "
          "\"color Color\" [1 0 0] " +
          kSphere +
          "Attribute \"Ri\" \"int ReverseOrientation\" 1 \"string Basis\" \"b-spline\" \"color Opacity\" [.5 .5 .5]\n"
          "Curves \"cubic\" [5] \"nonperiodic\" \"P\" [0 0 0 1 0 0 2 0 0 3 0 0 4 0 0]"));
  const Options& o = r.scene().options;
  EXPECT_EQ(o.xResolution, 64);
  EXPECT_EQ(o.yResolution, 36);
  EXPECT_EQ(o.pixelAspect, 2);
  EXPECT_EQ(o.filter, "gaussian");
  EXPECT_EQ(o.xFilterWidth, 3);
  EXPECT_EQ(o.yFilterWidth, 4);
  EXPECT_EQ(o.nearClip, .1f);
  EXPECT_EQ(o.farClip, 100);
  EXPECT_EQ(o.shutterClose, .25f);
  EXPECT_EQ(o.screenWindow.value()[3], .5f);
  EXPECT_EQ(o.cropWindow[1], .5f);
  const Attributes &first = r.attributes(0), &second = r.attributes(1);
  EXPECT_EQ(first.sides, 1);
  EXPECT_TRUE(first.matte);
  EXPECT_EQ(first.shadingRate, 4);
  EXPECT_TRUE(first.insideOut);
  EXPECT_EQ(first.color, vec3(1, 0, 0));
  EXPECT_EQ(second.opacity, vec3(.5f));
  EXPECT_FALSE(second.insideOut);
  EXPECT_EQ(r.codes(), "rib-unknown-option@1 ") << "Wisdom alone; the curve of five points fits a b-spline";
}

TEST(Ris, PxrCameraHasALens) {
  const std::string lens = "\"float focalLength\" [.5] \"float focalDistance\" [7] ";
  const Reading sharp("Projection \"PxrCamera\" \"float fov\" 30 \"float fStop\" [1e38] " + lens + inWorld(kSphere));
  EXPECT_EQ(sharp.scene().options.fStop, kInfinity);
  const Reading r("Projection \"PxrCamera\" \"float fov\" 30 \"float fStop\" [2] " + lens + inWorld(kSphere));
  EXPECT_EQ(r.scene().options.fStop, 2);
  EXPECT_EQ(r.scene().options.focalLength, .5f);
  EXPECT_EQ(r.scene().options.focalDistance, 7);
  EXPECT_EQ(r.scene().options.fov_degrees, 30);
  EXPECT_EQ(r.codes(), "");
}

TEST(Ris, IntegratorsOfGlobalLightLackNothing) {
  for (const std::string name : {"PxrVCM", "PxrDefault"})
    EXPECT_EQ(Reading("Integrator \"" + name + "\" \"i\"" + inWorld(kSphere)).message("rib-substitute").severity,
              Severity::Warning);
  EXPECT_EQ(Reading("Integrator \"PxrVisualizer\" \"i\"" + inWorld(kSphere)).message("rib-substitute").severity,
            Severity::Missing);
}

TEST(Ris, WorldsWithoutLightsAndIntegratorHaveALampAtTheEye) {
  const std::string bxdf = "Bxdf \"PxrDiffuse\" \"d\" ";
  for (const std::string integrator : {"", "Integrator \"PxrDefault\" \"i\" "}) {
    const Reading r(integrator + "Translate 0 0 9 " +
                    inWorld("AttributeBegin " + bxdf + "Rotate 90 0 1 0 " + kSphere + "AttributeEnd " + kSphere));
    ASSERT_EQ(r.scene().lights.size(), 1u);
    const ShaderCall& lamp = r.scene().lights[0]->shader;
    EXPECT_EQ(lamp.name, "distantlight");
    expectNear(vec3(lamp.worldFromShader.at(0) * vec4(0, 0, 0, 1)), {0, 0, -9});
    expectNear(vec3(lamp.worldFromShader.at(0) * vec4(0, 0, 1, 0)), {0, 0, 1});
    for (const size_t i : {0u, 1u}) EXPECT_EQ(r.attributes(i).lights, LightList{0}) << "it comes after them";
  }
  const auto lights = [](const std::string& rib) { return Reading(rib).scene().lights.size(); };
  EXPECT_EQ(lights(inWorld(kSphere)), 0u) << "a world of shaders in RSL";
  EXPECT_EQ(lights("Integrator \"PxrDirectLighting\" \"i\" " + inWorld(bxdf + kSphere)), 0u);
  EXPECT_EQ(lights(inWorld(bxdf + kSphere + "Light \"PxrDomeLight\" \"sky\"")), 1u);
  EXPECT_EQ(lights(inWorld(bxdf + kSphere + "Light \"PxrFancyLight\" \"f\"")), 0u) << "it has one, which is missing";
}

TEST(Ris, SourcesOfChannelsLoseTheirTypeAndPathsBecomeOutputs) {
  const auto source = [](const std::string& theirs) {
    const Reading r("DisplayChannel \"color c\" \"string source\" [\"" + theirs + "\"]" + inWorld(kSphere));
    return findParam(r.scene().options.channels.at("c").params, "source")->strings[0];
  };
  EXPECT_EQ(source("color Ci"), "Ci");
  EXPECT_EQ(source("normal Nn"), "normal");
  EXPECT_EQ(source("float zfiltered"), "z");
  EXPECT_EQ(source("color lpe:C<RD>[<L.>O]"), "diffuse");
  EXPECT_EQ(source("lpe:C<RS>[DS]+[<L.>O]"), "reflection");
  EXPECT_EQ(source("color lpe:nothruput;noclamp;unoccluded;overwrite;C(U2L)|O"), "albedo");
  EXPECT_EQ(source("color lpe:C<TD>[DS]*[<L.>O]"), "lpe:C<TD>[DS]*[<L.>O]") << "nobody answers it, which is said";
  EXPECT_EQ(source("lightgroup:key light"), "lightgroup:key light");
}

TEST(Ris, DomesTurnTheirMapWithTheirSpace) {
  const Reading r(inWorld("Light \"PxrDomeLight\" \"sky\" \"string lightColorMap\" \"sky.exr\" " + kSphere));
  EXPECT_EQ(findParam(r.scene().lights.at(0)->shader.params, "mapspace")->strings.at(0), "shader");
}

TEST(Ris, DaylightIsASunAndASkyWithTheirOwnTints) {
  const Reading r(
      inWorld("Light \"PxrEnvDayLight\" \"day\" \"float exposure\" [1] \"color sunTint\" [1 0 0] \"vector "
              "sunDirection\" [0.6 0.8 0] \"float haziness\" [4] " +
              kSphere));
  ASSERT_EQ(r.scene().lights.size(), 2u);
  const ParamList &sun = r.scene().lights[0]->shader.params, &sky = r.scene().lights[1]->shader.params;
  EXPECT_EQ(r.scene().lights[0]->shader.name, "sunlight");
  EXPECT_EQ(r.scene().lights[1]->shader.name, "daylight");
  EXPECT_EQ(findParam(sun, "lightcolor")->floats, (std::vector<float>{1, 0, 0}));
  EXPECT_EQ(findParam(sky, "lightcolor")->floats, (std::vector<float>{1, 1, 1}));
  for (const ParamList* params : {&sun, &sky}) {
    EXPECT_EQ(findParam(*params, "sundirection")->floats, (std::vector<float>{0.6f, 0.8f, 0}));
    EXPECT_EQ(findParam(*params, "turbidity")->floats[0], 4);
    EXPECT_EQ(findParam(*params, "intensity")->floats[0], 2);
  }
}

/// Height over the horizon and azimuth from north over east, of the sun of a place and time.
vec2 sunOf(float month, float day, float hour, float zone, float latitude, float longitude) {
  const Reading r(inWorld("Light \"PxrEnvDayLight\" \"day\" \"float month\" [" + std::to_string(month) +
                          "] \"float day\" [" + std::to_string(day) + "] \"float hour\" [" + std::to_string(hour) +
                          "] \"float zone\" [" + std::to_string(zone) + "] \"float latitude\" [" +
                          std::to_string(latitude) + "] \"float longitude\" [" + std::to_string(longitude) + "] " +
                          kSphere));
  const std::vector<float> d = findParam(r.scene().lights.at(0)->shader.params, "sundirection")->floats;
  return {glm::degrees(std::asin(d[1])), glm::degrees(std::atan2(d[0], d[2]))};
}

// An almanac's: the sun's declination is 23.4 at the solstices and 0 at the equinoxes; clocks are up to 16 minutes off.
TEST(Ris, TheSunOfADateAndAPlaceStandsWhereAlmanacsSay) {
  EXPECT_GT(sunOf(3, 21, 12.12f, 0, 0, 0).x, 89);  // overhead on the equator
  EXPECT_NEAR(sunOf(6, 21, 12.03f, 0, 48, 0).x, 90 - 48 + 23.4f, 0.5f);
  EXPECT_NEAR(std::abs(sunOf(6, 21, 12.03f, 0, 48, 0).y), 180, 1);  // in the south
  EXPECT_NEAR(sunOf(12, 21, 11.97f, 0, 48, 0).x, 90 - 48 - 23.4f, 0.5f);
  EXPECT_NEAR(sunOf(3, 21, 6.12f, 0, 48, 0).x, 0, 1);  // rises in the east at six
  EXPECT_NEAR(sunOf(3, 21, 6.12f, 0, 48, 0).y, 90, 1);
  EXPECT_NEAR(std::abs(sunOf(6, 21, 13.03f, 1, -30, 0).y), 0, 1);  // in the north, an hour later by a clock of zone 1
}

TEST(Ris, NightIsDarkAndSaysSo) {
  const Reading r(inWorld("Light \"PxrEnvDayLight\" \"day\" \"vector sunDirection\" [0 -0.1 1] " + kSphere));
  EXPECT_EQ(r.told("rib-substitute"), 2);
}

}  // namespace
}  // namespace tomales
