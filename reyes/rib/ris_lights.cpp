// Lights of the RIS era. They shine along +z of their own space; the area lights are a unit square, and shapes of
// diameter one.
#include <cmath>
#include <unordered_map>

#include "reyes/rib/ris_parts.h"

namespace tomales::rib {

ParamList emission(const Request& r) {
  const float intensity = number(r, "intensity", 1) * std::exp2(number(r, "exposure", 0));
  const char* const name = findParam(r.params, "lightcolor") ? "lightcolor" : "lightColor";  // PxrAreaLight's first
  return {param("intensity", ValueType::Float, {intensity}), param("lightcolor", ValueType::Color, color(r, name, 1))};
}

namespace {

// Makes geometry from here on emit light, and otherwise be black and cast no shadow.
void sayEmitter(Script& script, const Request& r) {
  script.say("AreaLightSource", {string("arealight"), string(r.args[1].strings[0])}, emission(r));
  script.say("Surface", {string("constant")}).say("Color", {numbers({0, 0, 0})});
  script.say("Attribute", {string("visibility")}, {param("transmission", ValueType::Float, {0})});
}

// Makes an emitter in a scope of its own, turned about y.
Translation areaLight(const Request& r, const char* shape, std::vector<RibArg> args, float turn_degrees = 0) {
  Script script(r);
  script.say("AttributeBegin");
  sayEmitter(script, r);
  if (turn_degrees != 0) script.say("Rotate", {numbers({turn_degrees, 0, 1, 0})});
  script.say(shape, std::move(args)).say("AttributeEnd");
  return {script.list(), {standsIn(r, "arealight")}};
}

Translation rectLight(const Request& r) { return areaLight(r, "Geometry", {string("rectlight")}); }
Translation sphereLight(const Request& r) { return areaLight(r, "Geometry", {string("spherelight")}); }
Translation diskLight(const Request& r) { return areaLight(r, "Geometry", {string("disklight")}); }
Translation cylinderLight(const Request& r) { return areaLight(r, "Cylinder", {numbers({.5f, -.5f, .5f, 360})}, 90); }

Translation lightSource(const Request& r, const char* shader, const ParamList& more) {
  ParamList params = emission(r);
  params.insert(params.end(), more.begin(), more.end());
  return {Script(r).say("LightSource", {string(shader), string(r.args[1].strings[0])}, params).list(),
          {standsIn(r, shader)}};
}
Translation distantLight(const Request& r) {
  return lightSource(r, "distantlight",
                     {param("from", ValueType::Point, {0, 0, 0}), param("to", ValueType::Point, {0, 0, 1})});
}
Translation domeLight(const Request& r) {
  const std::string map = wordOf(r.params, findParam(r.params, "rman__EnvMap") ? "rman__EnvMap" : "lightColorMap");
  return lightSource(r, "environmentlight",
                     map.empty() ? ParamList{} : ParamList{param("map", map), param("mapspace", "shader")});
}

// The geometry of this light follows in its block.
Translation meshLight(const Request& r) {
  Script script(r);
  sayEmitter(script, r);
  return {script.list(), {standsIn(r, "arealight")}};
}

bool isStdAreaLight(const Request& r) {
  const std::string& name = r.args[0].strings[0];
  return name == "PxrAreaLight" || name.find("PxrStdAreaLight") != std::string::npos;
}

}  // namespace

// Tells lights apart by a part of the name: RenderMan for Maya 19 and 20 name the shader after the light that they
// wrote it for, as "shaders/PxrStdAreaLightShape1_rfm".
Translation stdLight(const Request& r, RisState& state) {
  const auto is = [&](const char* kind) { return r.args[0].strings[0].find(kind) != std::string::npos; };
  state.areaLight = r;
  if (is("PxrStdEnvMapLight")) return domeLight(r);
  if (is("PxrStdEnvDayLight")) return dayLight(r);
  if (isStdAreaLight(r)) return meshLight(r);
  return {{}, {note(r, "is not available and has no substitute: it is dark", Severity::Missing)}};
}

// Skies are not drawn as geometry. The skies of the two other kinds are lights already.
Translation envSphere(const Request& r, const RisState& state) {
  if (!state.areaLight || !isStdAreaLight(*state.areaLight)) return {};
  Translation sky = domeLight(*state.areaLight);
  for (Note& n : sky.notes) {
    n.key += " envsphere";
    n.where = r.where;
  }
  return sky;
}

Translation risLight(const Request& r) {
  static const std::unordered_map<std::string_view, Translation (*)(const Request&)> table = {
      {"PxrRectLight", rectLight},         {"PxrSphereLight", sphereLight},   {"PxrDiskLight", diskLight},
      {"PxrDomeLight", domeLight},         {"PxrDistantLight", distantLight}, {"PxrEnvDayLight", dayLight},
      {"PxrCylinderLight", cylinderLight}, {"PxrMeshLight", meshLight}};
  const auto it = table.find(r.args[0].strings[0]);
  if (it != table.end()) return it->second(r);
  return {{}, {note(r, "is not available and has no substitute: it is dark", Severity::Missing)}};
}

Translation headLamp(const RisState& state) {
  if (!state.bxdf || state.hasIntegrator || state.hasLight || state.areaLight) return {};
  const Request& r = *state.bxdf;
  return {Script(r)
              .say("TransformBegin")
              .say("CoordSysTransform", {string("camera")})
              .say("LightSource", {string("distantlight"), string("PxrDefault")})
              .say("TransformEnd")
              .list(),
          {{"PxrDefault",
            "there is neither a light nor an Integrator that needs one: a distantlight at the eye stands in for the "
            "lamp of PxrDefault",
            r.where, Severity::Warning, "light-none"}}};
}

}  // namespace tomales::rib
