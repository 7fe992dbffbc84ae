// What the renderer knows of shaders and of area lights before it runs them.
#include "reyes/area_lights.h"
#include "reyes/shader.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

void nothing(const TmGrid*) {}
rsl::FloatParam knob("knob", 1, "");
const rsl::Shader plainShader(TM_SURFACE, "plain", "", 0, nothing, {&knob});
const rsl::Shader evenShader(TM_SURFACE, "even", "", TM_EVEN | TM_KEEPS_OPACITY, nothing, {&knob});
const rsl::Shader glowShader(TM_SURFACE, "glow", "", TM_EMITS, nothing, {});
const rsl::Shader traceShader(TM_SURFACE, "trace", "", TM_TRACES, nothing, {});
const rsl::Shader mirrorShader(TM_SURFACE, "mirror", "", TM_TRACES | TM_TRACES_HIGHLIGHTS, nothing, {});
const rsl::Shader cornersShader(TM_SURFACE, "corners", "", TM_TRACES | TM_OCCLUDED, nothing, {});
const rsl::Shader sharedShader(TM_SURFACE, "shared", "", TM_INTERPOLATED, nothing, {});
const rsl::Shader unaskedShader(TM_SURFACE, "unasked", "", TM_INTERPOLATED_UNASKED, nothing, {});
const rsl::Shader slopeShader(TM_SURFACE, "slope", "", TM_DERIVATIVES, nothing, {});

class Traits : public Stage {
 protected:
  Traits() {
    static const TmShader* const shaders[] = {plainShader,   evenShader,   glowShader,    traceShader, mirrorShader,
                                              cornersShader, sharedShader, unaskedShader, slopeShader};
    static const TmShaderLibrary library = rsl::libraryOf(shaders);
    registry.addLibrary(&library, "test");
  }
  GroupTraits of(const std::string& name) {
    scene.objects.clear();
    shading.reset();
    surface(name);
    return system().group(0);
  }
  LightTraits lightOf(const std::string& name, ParamList params = {}, bool area = false) {
    light(name, std::move(params), area);
    return system().light(0);
  }
};

TEST_F(Traits, OfSurfacesAreWhatTheirShadersDeclare) {
  for (const auto& [name, emits, traces, hemispheres, steps] :
       {std::tuple{"plain", false, false, false, false}, std::tuple{"glow", true, false, false, false},
        std::tuple{"trace", false, true, false, false}, std::tuple{"mirror", false, false, false, false},
        std::tuple{"corners", false, false, true, false}, std::tuple{"shared", false, false, false, false},
        std::tuple{"unasked", false, false, true, false}, std::tuple{"slope", false, false, false, true}}) {
    const GroupTraits traits = of(name);
    EXPECT_EQ(traits.emits(), emits) << name;
    EXPECT_EQ(traits.tracesRays(), traces) << name;
    EXPECT_EQ(traits.asksHemispheres(), hemispheres) << name;
    EXPECT_EQ(traits.wantsSteps(), steps) << name;
    EXPECT_FALSE(traits.opaque()) << name;
  }
  attributes.irradianceMaxError = 0.5f;
  EXPECT_TRUE(of("shared").asksHemispheres());
  EXPECT_FALSE(of("plain").asksHemispheres());
  attributes.irradianceMaxError = 0.0f;
  EXPECT_FALSE(of("shared").asksHemispheres());
}

rsl::FloatParam most("most", 0.1f, "", TM_ROLE_MAX_VARIATION);
const rsl::Shader occludedLight(TM_LIGHT, "occluded", "", TM_LIGHT_SOLAR | TM_OCCLUDED, nothing, {&most});
const rsl::Shader sharedLight(TM_LIGHT, "sharedlight", "", TM_LIGHT_SOLAR | TM_INTERPOLATED, nothing, {});
const rsl::Shader unaskedLight(TM_LIGHT, "unaskedlight", "", TM_LIGHT_SOLAR | TM_INTERPOLATED | TM_INTERPOLATED_UNASKED,
                               nothing, {});

TEST_F(Traits, OfLightsThatAskForHemispheresAreThoseOfTheObjectsThatTheyLight) {
  static const TmShader* const shaders[] = {occludedLight, sharedLight, unaskedLight};
  static const TmShaderLibrary library = rsl::libraryOf(shaders);
  registry.addLibrary(&library, "test");
  const auto asks = [&](const char* lamp, ParamList params = {}) {
    scene.lights.clear();
    attributes.lights.clear();
    light("distantlight");
    light(lamp, std::move(params));
    const bool lit = of("plain").asksHemispheres();
    attributes.lights.switchOff(1);
    EXPECT_FALSE(of("plain").asksHemispheres()) << "it is off";
    return lit;
  };
  EXPECT_FALSE(asks("distantlight"));
  EXPECT_TRUE(asks("occluded"));
  EXPECT_FALSE(asks("occluded", {number("most", 0)}));
  EXPECT_FALSE(asks("sharedlight"));
  EXPECT_TRUE(asks("unaskedlight"));
  attributes.irradianceMaxError = 0.5f;
  EXPECT_TRUE(asks("sharedlight"));
  EXPECT_TRUE(asks("occluded", {number("most", -1)}));
}

TEST_F(Traits, TheGroupOfALightIsTheOneItNamesOrItsHandleAndIndirectLightHasNone) {
  light("pointlight", {text("__group", "key")});
  light("distantlight");
  light("indirectlight");
  EXPECT_EQ(system().light(0).group(), "key");
  EXPECT_EQ(system().light(1).group(), "distantlight");
  EXPECT_EQ(system().light(2).group(), "");
}

TEST_F(Traits, AnEvenShaderReflectsEvenlyUnlessAVariableOfTheGeometryChangesIt) {
  EXPECT_TRUE(of("even").reflectsEvenly());
  EXPECT_FALSE(of("plain").reflectsEvenly());
  for (const auto& [name, type] : {std::pair{"Cs", ValueType::Color}, std::pair{"Os", ValueType::Color},
                                   std::pair{"knob", ValueType::Float}, std::pair{"other", ValueType::Float}}) {
    primvars.clear();
    primvar(name, type);
    EXPECT_EQ(of("even").reflectsEvenly(), std::string(name) == "other") << name;
  }
}

TEST_F(Traits, OnlyASurfaceThatKeepsAnOpacityOfOneIsOpaque) {
  EXPECT_TRUE(of("even").opaque());
  attributes.opacity = {1, 1, 0.5f};
  EXPECT_FALSE(of("even").opaque());
  EXPECT_TRUE(of("even").keepsOpacity());
  attributes.opacity = vec3(1);
  primvar("Os", ValueType::Color);
  EXPECT_FALSE(of("even").opaque());
}

TEST_F(Traits, AVolumeStandsOnTheSideThatNamesIt) {
  attributes.interior = std::make_shared<const ShaderCall>(call("fog", {}));
  const GroupTraits traits = of("even");
  EXPECT_TRUE(traits.hasVolume(true));
  EXPECT_FALSE(traits.hasVolume(false));
  EXPECT_EQ(traits.medium(false).scattering, vec3(0));
}

TEST_F(Traits, OfLightsSayTheirKind) {
  EXPECT_EQ(lightOf("ambientlight").kind(), LightKind::Ambient);
  light("pointlight");
  light("distantlight");
  light("arealight", {}, true);
  light("indirectlight");
  light("environmentlight");
  light("pointlight", {number("__nondiffuse", 1)});
  shading.reset();
  scene.objects.clear();
  const LightKind kinds[] = {LightKind::Ambient,  LightKind::Point, LightKind::Distant, LightKind::Area,
                             LightKind::Indirect, LightKind::Sky,   LightKind::None};
  for (int k = 0; k < 7; ++k) EXPECT_EQ(system().light(k).kind(), kinds[k]) << k;
  EXPECT_STREQ(system().light(1).shader()->name, "pointlight");
  EXPECT_TRUE(system().light(5).portals().empty());
}

TEST_F(Traits, TheFactorOfALightIsTheProductOfItsScaleAndItsTint) {
  const LightTraits traits = lightOf("pointlight", {number("intensity", 7)});
  EXPECT_EQ(traits.factor({number("intensity", 3), color("lightcolor", {0.5f, 1, 2})}), vec3(1.5f, 3, 6));
  EXPECT_EQ(traits.factor({color("lightcolor", {0.5f, 1, 2}), point("from", vec3(9))}), vec3(0.5f, 1, 2))
      << "the default of the intensity is 1";
}

// --- Areas of lights

class AreaOfLights : public Traits {
 protected:
  AreaOfLights() {
    scene.options.user["shade:arealight"] = text("arealight", "bmrt");
    light("arealight", {}, true);
    light("pointlight");
  }
  void shape(const PrimPtr& prim, const Motion& place = {}, int lightIndex = 0) {
    Object o;
    Attributes a = attributes;
    a.areaLight = lightIndex;
    o.shapes = {prim};
    o.worldFromObject = place;
    o.attributes = std::make_shared<const Attributes>(a);
    scene.objects.push_back(o);
  }
  /// The area that the first light has been given; 0 if none.
  float measured() {
    scene.freeze();
    measureAreaLights(scene, registry, log);
    const Param* p = findParam(scene.lights[0]->shader.params, "area");
    return p ? p->floats[0] : 0;
  }
  Problems problems;
};

TEST_F(AreaOfLights, IsThatOfAllTheirShapesInTheWorld) {
  const float narrow[] = {1, 2, 3};
  const mat4 scaled = glm::mat4(glm::vec4(narrow[0], 0, 0, 0), glm::vec4(0, narrow[1], 0, 0),
                                glm::vec4(0, 0, narrow[2], 0), glm::vec4(5, 6, 7, 1));
  shape(makeSphere(2, -2, 2, 360, {}, problems));
  shape(makeDisk(1, 1, 360, {}, problems), Motion::still(scaled));
  shape(makeCylinder(1, 0, 1, 360, {}, problems), Motion::still(mat4(1)), 1);
  EXPECT_NEAR(measured(), 16 * kPi + 2 * kPi, 0.3f);
}

TEST_F(AreaOfLights, IsThatOfWhatTrimCurvesLeave) {
  TrimCurve square{{5, 2, {0, 0, 1, 2, 3, 4, 4}, 0, 4}, {}};
  for (const vec2& p :
       {vec2(0.25f, 0.25f), vec2(0.75f, 0.25f), vec2(0.75f, 0.5f), vec2(0.25f, 0.5f), vec2(0.25f, 0.25f)})
    square.controls.emplace_back(p, 1);
  Param P{"P", Storage::Vertex, ValueType::Point, 1, {0, 0, 0, 4, 0, 3, 0, 2, 0, 4, 2, 3}, {}, {}};
  const NurbsDirection line{2, 2, {0, 0, 1, 1}, 0, 1};
  for (const bool inside : {false, true})
    shape(makeNuPatch(line, line, {{{square}}, inside}, {P}, problems), {}, inside);
  EXPECT_NEAR(measured(), 10 * 0.875f, 0.03f);
  EXPECT_TRUE(problems.empty());
}

TEST_F(AreaOfLights, IsLeftToTheSceneThatGivesItOrWasNotMadeForIt) {
  shape(makeSphere(2, -2, 2, 360, {}, problems));
  scene.lights[0] = std::make_shared<LightCall>(*scene.lights[0]);
  scene.lights[0]->shader.params.push_back(number("area", 3));
  EXPECT_EQ(measured(), 3);
  scene.lights[0]->shader.params.clear();
  scene.options.user.clear();
  EXPECT_EQ(measured(), 0);
  scene.options.user["radiosity:steps"] = number("steps", 1);
  EXPECT_NEAR(measured(), 16 * kPi, 0.3f);
  EXPECT_EQ(log.count("scene-bmrt"), 1);
}

}  // namespace
}  // namespace tomales
