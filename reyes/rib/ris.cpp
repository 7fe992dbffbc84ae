#include "reyes/rib/ris.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace tomales::rib {
namespace {

RibArg numbers(std::vector<float> n) { return {RibArg::Kind::Numbers, std::move(n)}; }
RibArg string(const std::string& s) { return {RibArg::Kind::String, {}, {s}}; }

Param param(const std::string& name, ValueType type, std::vector<float> floats) {
  Param p;
  p.name = name, p.type = type, p.floats = std::move(floats);
  return p;
}
Param param(const std::string& name, const std::string& value) {
  Param p;
  p.name = name, p.type = ValueType::String, p.strings = {value};
  return p;
}

float number(const Request& r, const char* name, float fallback) {
  const Param* p = findParam(r.params, name);
  return p ? p->number(fallback) : fallback;
}
std::vector<float> color(const Request& r, const char* name, float grey) {
  const Param* p = findParam(r.params, name);
  return p && p->floats.size() == 3 ? p->floats : std::vector<float>(3, grey);
}

/// Requests at the place of `from`.
class Script {
 public:
  explicit Script(const Request& from) : from_(from) {}
  Script& say(const char* name, std::vector<RibArg> args = {}, ParamList params = {}) {
    list_.push_back({name, std::move(args), std::move(params), from_.where});
    return *this;
  }
  std::vector<Request> list() { return std::move(list_); }

 private:
  const Request& from_;
  std::vector<Request> list_;
};

std::string standsIn(const Request& r, const std::string& substitute) {
  return fmt::format("{} \"{}\" is not available: {} stands in for it", r.name, r.args[0].strings[0],
                     substitute);
}

struct Bxdf {
  const char *shader, *color;
  float grey;             ///< The default of that colour,
  const char* roughness;  ///< Null: none.
};

constexpr float kReflections = 1;  // RIS mirrors the scene in everything

void addDisney(const Request& r, ParamList& params) {
  static constexpr std::pair<const char*, const char*> names[] = {
      {"metallic", "metallic"}, {"specular", "specular"}, {"specularTint", "speculartint"}, {"sheen", "sheen"},
      {"sheenTint", "sheentint"}, {"clearcoat", "clearcoat"}, {"clearcoatGloss", "clearcoatgloss"}};
  for (const auto& [theirs, ours] : names)
    if (findParam(r.params, theirs)) params.push_back(param(ours, ValueType::Float, {number(r, theirs, 0)}));
  if (findParam(r.params, "emitColor")) params.push_back(param("emission", ValueType::Color, color(r, "emitColor", 0)));
  params.push_back(param("reflections", ValueType::Float, {kReflections}));
}

/// Its specular lobe is given by the colour that it reflects at normal incidence: a bright one is a metal's.
void addPxrSurface(const Request& r, std::vector<float>& base, ParamList& params) {
  const auto mean = [](const std::vector<float>& c) { return (c[0] + c[1] + c[2]) / 3; };
  const std::vector<float> face = color(r, "specularFaceColor", 0), glow = color(r, "glowColor", 1);
  const float diffuse = number(r, "diffuseGain", 1), reflected = mean(face), coat = mean(color(r, "clearcoatFaceColor", 0));
  constexpr float kMetal = 0.3f, kUnit = 0.08f;  // disney's specular 1 reflects kUnit
  const bool metal = reflected > kMetal;
  for (size_t k = 0; k < 3; ++k) base[k] = metal ? face[k] : diffuse * base[k];
  params.push_back(param("metallic", ValueType::Float, {metal ? 1.0f : 0.0f}));
  params.push_back(param("specular", ValueType::Float, {metal ? 0.0f : reflected / kUnit}));
  if (coat > 0) params.push_back(param("clearcoat", ValueType::Float, {std::min(1.0f, coat / 0.04f)}));
  if (const float gain = number(r, "glowGain", 0); gain > 0)
    params.push_back(param("emission", ValueType::Color, {gain * glow[0], gain * glow[1], gain * glow[2]}));
  if (reflected > 0 || coat > 0) params.push_back(param("reflections", ValueType::Float, {kReflections}));
}

Translation bxdf(const Request& r) {
  static const std::unordered_map<std::string_view, Bxdf> table = {
      {"PxrDiffuse", {"matte", "diffuseColor", 0.5f, nullptr}},
      {"PxrLMDiffuse", {"matte", "frontColor", 0.5f, nullptr}},
      {"PxrConstant", {"constant", "emitColor", 1, nullptr}},
      {"PxrDisney", {"disney", "baseColor", 0.5f, "roughness"}},
      {"PxrSurface", {"disney", "diffuseColor", 0.5f, "specularRoughness"}},
      {"PxrLayerSurface", {"disney", "diffuseColor", 0.5f, "specularRoughness"}}};
  const auto it = table.find(r.args[0].strings[0]);
  const bool known = it != table.end();
  const Bxdf b = known ? it->second : Bxdf{"matte", "diffuseColor", 0.5f, nullptr};
  const char* named = findParam(r.params, b.color) ? b.color : "diffuseColor";
  ParamList params;
  if (b.roughness && findParam(r.params, b.roughness))
    params.push_back(
        param("roughness", ValueType::Float, {std::clamp(number(r, b.roughness, 0.1f), 0.001f, 1.0f)}));
  std::vector<float> base = color(r, named, b.grey);
  if (r.args[0].strings[0] == "PxrDisney")
    addDisney(r, params);
  else if (std::string_view(b.shader) == "disney")
    addPxrSurface(r, base, params);
  return {Script(r)
              .say("Color", {numbers(base)})
              .say("Surface", {string(b.shader)}, params)
              .list(),
          standsIn(r, b.shader), known ? Severity::Warning : Severity::Missing};
}

ParamList emission(const Request& r) {
  const float intensity = number(r, "intensity", 1) * std::exp2(number(r, "exposure", 0));
  return {param("intensity", ValueType::Float, {intensity}),
          param("lightcolor", ValueType::Color, color(r, "lightColor", 1))};
}

// A black emitter in a scope of its own, which leaves its light switched on.
Translation areaLight(const Request& r, const char* shape, std::vector<RibArg> args, ParamList params) {
  const RibArg handle = string(r.args[1].strings[0]);
  Script script(r);
  script.say("AttributeBegin").say("AreaLightSource", {string("arealight"), handle}, emission(r));
  script.say("Surface", {string("constant")}).say("Color", {numbers({0, 0, 0})});
  script.say(shape, std::move(args), std::move(params)).say("AttributeEnd");
  script.say("Illuminate", {handle, {RibArg::Kind::Number, {1}, {}}});
  return {script.list(), standsIn(r, "arealight")};
}

// They all shine along -z, so the normals of the shapes do. A unit square, and diameters of one.
Translation rectLight(const Request& r) {
  const std::vector<float> corners{.5f, -.5f, 0, -.5f, -.5f, 0, .5f, .5f, 0, -.5f, .5f, 0};
  Param p = param("P", ValueType::Point, corners);
  p.storage = Storage::Vertex;
  return areaLight(r, "Patch", {string("bilinear")}, {p});
}
Translation sphereLight(const Request& r) {
  return areaLight(r, "Sphere", {numbers({.5f, -.5f, .5f, 360})}, {});
}
Translation diskLight(const Request& r) { return areaLight(r, "Disk", {numbers({0, .5f, -360})}, {}); }

Translation lightSource(const Request& r, const char* shader, ParamList more) {
  ParamList params = emission(r);
  params.insert(params.end(), more.begin(), more.end());
  return {Script(r).say("LightSource", {string(shader), string(r.args[1].strings[0])}, params).list(),
          standsIn(r, shader)};
}
Translation distantLight(const Request& r) {
  return lightSource(r, "distantlight",
                     {param("from", ValueType::Point, {0, 0, 0}), param("to", ValueType::Point, {0, 0, -1})});
}
Translation domeLight(const Request& r) {
  const Param* map = findParam(r.params, "lightColorMap");
  const bool mapped = map && !map->strings.empty() && !map->strings[0].empty();
  return lightSource(r, "environmentlight", mapped ? ParamList{param("map", map->strings[0])} : ParamList{});
}

Translation light(const Request& r) {
  static const std::unordered_map<std::string_view, Translation (*)(const Request&)> table = {
      {"PxrRectLight", rectLight}, {"PxrSphereLight", sphereLight},   {"PxrDiskLight", diskLight},
      {"PxrDomeLight", domeLight}, {"PxrDistantLight", distantLight}, {"PxrEnvDayLight", domeLight}};
  const auto it = table.find(r.args[0].strings[0]);
  if (it != table.end()) return it->second(r);
  return {
      {},
      fmt::format("Light \"{}\" is not available and has no substitute: it is dark", r.args[0].strings[0]),
      Severity::Missing};
}

Translation integrator(const Request& r) {
  const std::string& name = r.args[0].strings[0];
  if (name == "PxrDirectLighting") return {{}, standsIn(r, "direct light of the scene's own lights")};
  ParamList params;
  if (const Param* bounces = findParam(r.params, "maxIndirectBounces"))
    params.push_back(param("bounces", ValueType::Float, {bounces->number(1)}));
  return {
      Script(r).say("LightSource", {string("indirectlight"), string("Integrator " + name)}, params).list(),
      standsIn(r, "indirectlight"), name == "PxrPathTracer" ? Severity::Warning : Severity::Missing};
}

Translation ignored(const Request& r) {
  return {{}, fmt::format("{} \"{}\" is not available: ignored", r.name, r.args[0].strings[0])};
}
Translation pattern(const Request& r) {
  return {{},
          fmt::format("Pattern \"{}\" is not available: what is connected to it keeps its default",
                      r.args[0].strings[0])};
}
Translation camera(const Request&) {
  return {{},
          "Camera: the one camera is that of Projection and WorldBegin; its name and parameters are ignored"};
}

const std::unordered_map<std::string_view, Translation (*)(const Request&)>& translators() {
  static const std::unordered_map<std::string_view, Translation (*)(const Request&)> table = {
      {"Bxdf", bxdf},       {"Light", light},           {"Integrator", integrator}, {"Pattern", pattern},
      {"Camera", camera},   {"DisplayFilter", ignored}, {"SampleFilter", ignored},  {"LightFilter", ignored},
      {"Displace", ignored}};
  return table;
}

}  // namespace

bool isRis(std::string_view name) { return translators().contains(name); }

Translation translateRis(const Request& r) { return translators().at(r.name)(r); }

}  // namespace tomales::rib
