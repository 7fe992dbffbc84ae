// The standard shaders as tables of the RenderMan Interface have them: names, kinds, parameters, types and defaults.
#include "reyes/shader_api.h"
#include "tests/unit/shade/stage.h"

namespace tomales {
namespace {

struct Parameter {
  const char* name;
  TmType type;
  std::vector<float> value;  ///< Empty: of a string, which is "".
};
struct StandardShader {
  const char* name;
  TmKind kind;
  std::vector<Parameter> parameters;
};

const std::vector<float> kOne{1, 1, 1}, kOrigin{0, 0, 0}, kAhead{0, 0, 1};

// From the table, not from the shaders. What shaders have beyond it is theirs.
std::vector<StandardShader> table() {
  const Parameter Ka{"Ka", TM_FLOAT, {1}}, Ks{"Ks", TM_FLOAT, {1}}, roughness{"roughness", TM_FLOAT, {.1f}},
      texturename{"texturename", TM_STRING, {}};
  const Parameter intensity{"intensity", TM_FLOAT, {1}}, lightcolor{"lightcolor", TM_COLOR, kOne},
      from{"from", TM_POINT, kOrigin}, to{"to", TM_POINT, kAhead};
  const std::vector<Parameter> plastic{
      Ka, {"Kd", TM_FLOAT, {.5f}}, {"Ks", TM_FLOAT, {.5f}}, roughness, {"specularcolor", TM_COLOR, kOne}};
  const std::vector<Parameter> spot{intensity,
                                    lightcolor,
                                    from,
                                    to,
                                    {"coneangle", TM_FLOAT, {float(M_PI / 6)}},
                                    {"conedeltaangle", TM_FLOAT, {float(M_PI / 36)}},
                                    {"beamdistribution", TM_FLOAT, {2}}};
  const std::vector<Parameter> shadow{
      {"shadowname", TM_STRING, {}}, {"width", TM_FLOAT, {1}}, {"samples", TM_FLOAT, {16}}};
  const auto with = [](std::vector<Parameter> some, const std::vector<Parameter>& more) {
    some.insert(some.end(), more.begin(), more.end());
    return some;
  };
  return {
      {"constant", TM_SURFACE, {}},
      {"matte", TM_SURFACE, {Ka, {"Kd", TM_FLOAT, {1}}}},
      {"metal", TM_SURFACE, {Ka, Ks, roughness}},
      {"shinymetal", TM_SURFACE, {Ka, Ks, {"Kr", TM_FLOAT, {1}}, roughness, texturename}},
      {"plastic", TM_SURFACE, plastic},
      {"paintedplastic", TM_SURFACE, with(plastic, {texturename})},
      {"defaultsurface", TM_SURFACE, {{"Kd", TM_FLOAT, {.8f}}, {"Ka", TM_FLOAT, {.2f}}}},
      {"ambientlight", TM_LIGHT, {intensity, lightcolor}},
      {"distantlight", TM_LIGHT, {intensity, lightcolor, from, to}},
      {"pointlight", TM_LIGHT, {intensity, lightcolor, from}},
      {"spotlight", TM_LIGHT, spot},
      {"shadowspot", TM_LIGHT, with(spot, shadow)},
      {"shadowdistant", TM_LIGHT, with({intensity, lightcolor, from, to}, shadow)},
      {"depthcue",
       TM_VOLUME,
       {{"mindistance", TM_FLOAT, {0}}, {"maxdistance", TM_FLOAT, {1}}, {"background", TM_COLOR, kOrigin}}},
      {"fog", TM_VOLUME, {{"distance", TM_FLOAT, {1}}, {"background", TM_COLOR, kOrigin}}},
      {"bumpy", TM_DISPLACEMENT, {{"Km", TM_FLOAT, {1}}, {"amplitude", TM_FLOAT, {1}}, texturename}},
      {"background", TM_IMAGER, {{"background", TM_COLOR, kOne}, {"bgcolor", TM_COLOR, kOne}}},
      {"clamptoalpha", TM_IMAGER, {}},
  };
}

using StandardParameters = Stage;

TEST_F(StandardParameters, AreThoseOfTheTable) {
  for (const StandardShader& standard : table()) {
    const TmShader* shader = registry.find(standard.name, standard.kind, "/nowhere");
    ASSERT_TRUE(shader) << standard.name;
    const std::span<const TmParamDecl> declared(shader->params, static_cast<size_t>(shader->paramCount));
    for (const Parameter& p : standard.parameters) {
      const std::string what = std::string(standard.name) + " " + p.name;
      const auto it = std::find_if(declared.begin(), declared.end(),
                                   [&](const TmParamDecl& d) { return std::string(d.name) == p.name; });
      ASSERT_NE(it, declared.end()) << what;
      EXPECT_EQ(TM_TYPE_OF(it->type), p.type) << what;
      EXPECT_EQ(it->type & TM_OUTPUT, 0) << what;
      EXPECT_EQ(it->arrayLength, 1) << what;
      for (size_t k = 0; k < p.value.size(); ++k)
        EXPECT_FLOAT_EQ(it->floats ? it->floats[k] : 0, p.value[k]) << what << " " << k;
      EXPECT_STREQ(p.type == TM_STRING && it->strings ? it->strings[0] : "", "") << what;
    }
  }
}

}  // namespace
}  // namespace tomales
