// The tables of materials and lights of the RIS era, row by row.
#include "rib_test_tools.h"

namespace tomales {
namespace ris_materials {
namespace {

Reading withBxdf(const std::string& name, const std::string& params) {
  return Reading(inWorld("Bxdf \"" + name + "\" \"b\" " + params + " " + kSphere));
}
float number(const Reading& r, const char* name, float absent = -1) {
  const Param* p = findParam(r.attributes(0).surface->params, name);
  return p ? p->number(absent) : absent;
}

struct Row {
  const char *name, *color;
  float grey;  ///< The default of that colour.
  const char *shader, *roughness;
  bool metal;
};
const Row kRows[] = {{"PxrDiffuse", "diffuseColor", .5f, "matte", "", false},
                     {"PxrLMDiffuse", "frontColor", .5f, "matte", "", false},
                     {"PxrConstant", "emitColor", 1, "constant", "", false},
                     {"PxrDisney", "baseColor", .5f, "disney", "roughness", false},
                     {"PxrDisneyBsdf", "baseColor", .5f, "disney", "roughness", false},
                     {"PxrSurface", "diffuseColor", .18f, "disney", "specularRoughness", false},
                     {"PxrLayerSurface", "diffuseColor", .18f, "disney", "specularRoughness", false},
                     {"PxrLMPlastic", "diffuseColor", .18f, "disney", "roughness", false},
                     {"PxrLMMetal", "specularColor", 1, "disney", "roughness", true},
                     {"PxrMarschnerHair", "diffuseColor", .5f, "matte", "", false},
                     {"PxrBlack", "diffuseColor", 0, "constant", "", false},
                     {"PxrLightEmission", "diffuseColor", 0, "constant", "", false},
                     {"LamaDiffuse", "color", .5f, "matte", "", false},
                     {"LamaSSS", "color", .5f, "matte", "", false},
                     {"LamaTranslucent", "color", .5f, "matte", "", false},
                     {"LamaEmission", "color", 1, "constant", "", false},
                     {"LamaConductor", "reflectivity", 1, "disney", "roughness", true},
                     {"PxrFancyBxdf", "diffuseColor", .5f, "matte", "", false}};

TEST(RisMaterials, HaveTheShaderTheColorAndTheDefaultOfTheirRow) {
  for (const Row& row : kRows) {
    const Reading plain = withBxdf(row.name, ""),
                  colored = withBxdf(row.name, "\"color " + std::string(row.color) + "\" [.1 .2 .3]");
    EXPECT_EQ(plain.attributes(0).surface->name, row.shader) << row.name;
    EXPECT_EQ(plain.attributes(0).color, vec3(row.grey)) << row.name;
    if (row.grey > 0) {
      EXPECT_EQ(colored.attributes(0).color, vec3(.1f, .2f, .3f)) << row.name;
    }
    EXPECT_EQ(number(plain, "reflections"), row.metal ? 4 : -1) << row.name;
    EXPECT_EQ(number(plain, "metallic"), row.metal ? 1 : -1) << row.name;
    const bool known = row.name != std::string("PxrFancyBxdf");
    EXPECT_EQ(plain.message("rib-substitute").severity, known ? Severity::Warning : Severity::Missing) << row.name;
  }
}

TEST(RisMaterials, AreAsRoughAsTheirRowSaysWithinLimits) {
  for (const Row& row : kRows) {
    EXPECT_EQ(number(withBxdf(row.name, ""), "roughness"), -1) << row.name;
    if (*row.roughness == 0) continue;
    const auto roughness = [&](const std::string& value) {
      return number(withBxdf(row.name, "\"float " + std::string(row.roughness) + "\" " + value), "roughness");
    };
    EXPECT_EQ(roughness(".25"), .25f) << row.name;
    EXPECT_EQ(roughness("0"), .001f) << row.name;
    EXPECT_EQ(roughness("2"), 1) << row.name;
  }
}

TEST(RisMaterials, OfDisneyKeepTheParametersOfTheirNamesake) {
  const std::pair<const char*, const char*> same[] = {{"specular", "specular"},   {"specularTint", "speculartint"},
                                                      {"sheen", "sheen"},         {"sheenTint", "sheentint"},
                                                      {"clearcoat", "clearcoat"}, {"clearcoatGloss", "clearcoatgloss"}};
  const Reading plain = withBxdf("PxrDisney", "");
  for (const auto& [theirs, ours] : same) {
    EXPECT_EQ(number(plain, ours), -1) << theirs;
    EXPECT_EQ(number(withBxdf("PxrDisney", "\"float " + std::string(theirs) + "\" .375"), ours), .375f) << theirs;
  }
  EXPECT_EQ(number(withBxdf("PxrDisney", "\"float clearcoat\" .1"), "reflections"), 4);
  EXPECT_EQ(number(withBxdf("PxrDisney", "\"float clearcoat\" 0"), "reflections"), -1);
}

TEST(RisMaterials, AreMetalWhereMetallicIsMoreThanHalfOrNothingIsDiffuse) {
  const auto reflections = [](const char* name, const std::string& params) {
    return number(withBxdf(name, params), "reflections");
  };
  EXPECT_EQ(reflections("PxrDisney", "\"float metallic\" .5"), -1);
  EXPECT_EQ(reflections("PxrDisney", "\"float metallic\" .51"), 4);
  EXPECT_EQ(number(withBxdf("PxrDisney", "\"float metallic\" .5"), "metallic"), .5f);
  EXPECT_EQ(reflections("PxrSurface", "\"float diffuseGain\" .01"), -1);
  EXPECT_EQ(reflections("PxrSurface", "\"float diffuseGain\" 0"), 4);
  EXPECT_EQ(reflections("PxrSurface", "\"float diffuseGain\" -1"), 4);
}

TEST(RisMaterials, MirrorAsMuchAsTheirFaceSays) {
  const Reading r = withBxdf("PxrSurface", "\"color specularFaceColor\" [.1 .2 .06]");
  EXPECT_NEAR(number(r, "specular"), .36f / (3 * .08f), 1e-6f);
  EXPECT_EQ(number(withBxdf("PxrSurface", ""), "specular"), -1);
}

TEST(RisMaterials, ThatRefractHaveTheIndexOfTheirRow) {
  const std::pair<const char*, const char*> rows[] = {{"PxrGlass", "ior"},
                                                      {"PxrLMGlass", "eta"},
                                                      {"LamaDielectric", "IOR"},
                                                      {"PxrSurface", "glassIor"},
                                                      {"PxrLayerSurface", "glassIor"}};
  for (const auto& [name, index] : rows) {
    const std::string gain = index == std::string("glassIor") ? "\"float refractionGain\" .51 " : "";
    EXPECT_EQ(withBxdf(name, gain).attributes(0).surface->name, "glass") << name;
    EXPECT_EQ(number(withBxdf(name, gain), "eta"), 1.5f) << name;
    EXPECT_EQ(number(withBxdf(name, gain + "\"float " + index + "\" 1.25"), "eta"), 1.25f) << name;
    if (!gain.empty()) {
      EXPECT_EQ(withBxdf(name, "\"float refractionGain\" .5").attributes(0).surface->name, "disney") << name;
    }
  }
}

TEST(RisMaterials, ThatConsistOfOthersAreTheOneThatIsMostOfThem) {
  const std::string red = "Bxdf \"LamaDiffuse\" \"red\" \"color color\" [1 0 0] ",
                    metal = "Bxdf \"LamaConductor\" \"metal\" ";
  const auto whole = [&](const std::string& name, const std::string& parts) {
    return Reading(inWorld(red + metal + "Bxdf \"" + name + "\" \"whole\" " + parts + kSphere));
  };
  const auto part = [](const std::string& name, const std::string& handle) {
    return "\"reference bxdf " + name + "\" [\"" + handle + "\"] ";
  };
  for (const Reading& r : {whole("LamaSurface", part("materialBack", "metal") + part("materialFront", "red")),
                           whole("LamaLayer", part("materialTop", "metal") + part("materialBase", "red")),
                           whole("LamaMix", part("material1", "red") + part("material2", "metal")),
                           whole("LamaAdd", part("material1", "red") + part("material2", "metal"))}) {
    EXPECT_EQ(r.attributes(0).surface->name, "matte");
    EXPECT_EQ(r.attributes(0).color, vec3(1, 0, 0));
    EXPECT_EQ(r.log.worst(), Severity::Warning);
  }
  const Reading nested(inWorld(red + "Bxdf \"LamaLayer\" \"inner\" " + part("materialBase", "red") +
                               "Bxdf \"LamaSurface\" \"outer\" " + part("materialFront", "inner") + kSphere));
  EXPECT_EQ(nested.attributes(0).color, vec3(1, 0, 0));
}

TEST(RisMaterials, WithoutThePartsThatTheyConsistOfAreMissing) {
  const std::string endless =
      "Bxdf \"LamaMix\" \"a\" \"reference bxdf material1\" \"b\" Bxdf \"LamaMix\" \"b\" \"reference bxdf material1\" "
      "\"a\" ";
  for (const std::string& bxdfs :
       {std::string("Bxdf \"LamaSurface\" \"s\" "),
        std::string("Bxdf \"LamaSurface\" \"s\" \"reference bxdf materialFront\" \"no\" "), endless}) {
    const Reading r(inWorld(bxdfs + kSphere));
    EXPECT_EQ(r.attributes(0).surface->name, "matte");
    EXPECT_EQ(r.log.worst(), Severity::Missing);
  }
}

TEST(RisMaterials, TintWhatTheyTransmit) {
  for (const auto& [name, tint] : {std::pair("PxrGlass", "refractionColor"), {"LamaDielectric", "transmissionTint"}}) {
    const Reading r = withBxdf(name, "\"color " + std::string(tint) + "\" [.5 1 .5]");
    EXPECT_EQ(findParam(r.attributes(0).surface->params, "transmitcolor")->floats, (std::vector<float>{.5f, 1, .5f}));
  }
}

TEST(RisMaterials, ThatMirrorAPictureKeepTheirShader) {
  const auto textured = [](const std::string& name, const std::string& color) {
    return Reading(inWorld("Pattern \"PxrTexture\" \"t\" \"string filename\" \"t.tif\" Bxdf \"" + name +
                           "\" \"b\" \"reference color " + color + "\" [\"t:resultRGB\"] " + kSphere));
  };
  const Reading shiny = textured("PxrDisney", "baseColor"), matte = textured("PxrDiffuse", "diffuseColor");
  EXPECT_EQ(shiny.attributes(0).surface->name, "disney");
  EXPECT_EQ(matte.attributes(0).surface->name, "paintedplastic");
  EXPECT_EQ(number(matte, "Ks"), 0);
  EXPECT_EQ(number(matte, "Kd"), 1);
  for (const Reading* r : {&shiny, &matte}) {
    EXPECT_EQ(r->attributes(0).color, vec3(1));
    EXPECT_EQ(findParam(r->attributes(0).surface->params, "texturename")->strings.at(0), "t.tif");
  }
}

TEST(RisMaterials, FollowTheVariablesOfPrimitivesByAnyOfTheirNames) {
  const auto color = [](const std::string& pattern) {
    return Reading(inWorld("Color .2 .3 .4 Pattern " + pattern +
                           " Bxdf \"PxrDiffuse\" \"b\" \"reference color diffuseColor\" [\"v:resultRGB\"] " + kSphere))
        .attributes(0)
        .color;
  };
  const vec3 own(.2f, .3f, .4f), grey(.5f);
  EXPECT_EQ(color("\"PxrPrimvar\" \"v\" \"string varname\" \"Cs\""), own);
  EXPECT_EQ(color("\"PxrPrimvar\" \"v\" \"string varname\" \"Ci\""), own);
  EXPECT_EQ(color("\"PxrVariable\" \"v\" \"string variable\" \"Cs\""), own);
  EXPECT_EQ(color("\"PxrPrimvar\" \"v\" \"string varname\" \"st\""), grey);
  EXPECT_EQ(color("\"PxrFractal\" \"v\" \"string varname\" \"Cs\""), grey);
  EXPECT_EQ(color("\"PxrTexture\" \"v\""), grey) << "it names no file";
  expectNear(color("\"PxrChecker\" \"v\" \"color colorA\" [.2 .4 .6] \"color colorB\" [.4 .8 1]"), {.3f, .6f, .8f});
}

TEST(RisLights, HaveTheShaderOfTheirRow) {
  const auto light = [](const std::string& name, const std::string& params = "") {
    return Reading(inWorld("Light \"" + name + "\" \"l\" \"float intensity\" 3 \"float exposure\" 1 " + params));
  };
  const std::pair<const char*, const char*> rows[] = {
      {"PxrRectLight", "arealight"},     {"PxrSphereLight", "arealight"},      {"PxrDiskLight", "arealight"},
      {"PxrCylinderLight", "arealight"}, {"PxrDomeLight", "environmentlight"}, {"PxrDistantLight", "distantlight"}};
  for (const auto& [name, shader] : rows) {
    const Reading r = light(name);
    ASSERT_EQ(r.scene().lights.size(), 1u) << name;
    const ShaderCall& call = r.scene().lights[0]->shader;
    EXPECT_EQ(call.name, shader) << name;
    EXPECT_EQ(findParam(call.params, "intensity")->number(0), 6) << name;
    EXPECT_EQ(r.scene().lights[0]->handle, "l") << name;
    EXPECT_EQ(r.scene().objects.size(), shader == std::string("arealight") ? 1u : 0u) << name;
  }
  for (const char* color : {"lightColor", "lightcolor"}) {
    const Reading r = light("PxrDistantLight", "\"color " + std::string(color) + "\" [1 .5 .25]");
    EXPECT_EQ(findParam(r.scene().lights[0]->shader.params, "lightcolor")->floats, (std::vector<float>{1, .5f, .25f}));
  }
  EXPECT_EQ(light("PxrFancyLight").message("rib-substitute").severity, Severity::Missing);
}

TEST(RisLights, AreBlackAndCastNoShadowAndTheirSizeIsOne) {
  for (const char* name : {"PxrRectLight", "PxrSphereLight", "PxrDiskLight", "PxrCylinderLight"}) {
    const Reading r(inWorld("Light \"" + std::string(name) + "\" \"l\" " + kSphere));
    EXPECT_EQ(r.attributes(0).color, vec3(0)) << name;
    EXPECT_EQ(r.attributes(0).surface->name, "constant") << name;
    EXPECT_FALSE(r.attributes(0).visibility.transmission) << name;
    Bound3 bound;
    for (uint32_t patch = 0; patch < r.object(0).shape().patchCount(); ++patch)
      bound.extend(transformBound(r.object(0).worldFromObject.at(0), r.object(0).shape().bound(patch, {})));
    const bool flat = name == std::string("PxrRectLight") || name == std::string("PxrDiskLight");
    expectNear(bound.lo, {-.5f, -.5f, flat ? 0 : -.5f}, 1e-3f);
    expectNear(bound.hi, {.5f, .5f, flat ? 0 : .5f}, 1e-3f);
  }
}

TEST(RisLights, OfACylinderLieAlongX) {
  const Reading r(inWorld("Light \"PxrCylinderLight\" \"l\""));
  expectNear(vec3(r.object(0).worldFromObject.at(0) * vec4(0, 0, 1, 0)), {1, 0, 0});
}

TEST(RisFilters, BackgroundsAreImagersAndOthersAreIgnored) {
  for (const char* request : {"DisplayFilter", "SampleFilter"}) {
    const Reading r(std::string(request) +
                    " \"PxrBackgroundDisplayFilter\" \"f\" \"color backgroundColor\" [.1 .2 .3]" + inWorld(kSphere));
    ASSERT_TRUE(r.scene().options.imager) << request;
    EXPECT_EQ(r.scene().options.imager->name, "background");
    EXPECT_EQ(findParam(r.scene().options.imager->params, "bgcolor")->floats, (std::vector<float>{.1f, .2f, .3f}));
    const Reading other(std::string(request) + " \"PxrGradeDisplayFilter\" \"f\"" + inWorld(kSphere));
    EXPECT_FALSE(other.scene().options.imager);
    EXPECT_EQ(other.told("rib-substitute"), 1);
  }
}

}  // namespace
}  // namespace ris_materials
}  // namespace tomales
