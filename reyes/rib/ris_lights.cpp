// Lights of the RIS era. They shine along +z of their own space; the area lights are a unit square, and shapes of diameter one.
#include <cmath>
#include <unordered_map>

#include "reyes/rib/ris_parts.h"

namespace tomales::rib {

ParamList emission(const Request& r) {
  const float intensity = number(r, "intensity", 1) * std::exp2(number(r, "exposure", 0));
  return {param("intensity", ValueType::Float, {intensity}), param("lightcolor", ValueType::Color, color(r, "lightColor", 1))};
}

namespace {

// An emitter in a scope of its own, black but for what it emits, which casts no shadow; turned about y.
Translation areaLight(const Request& r, const char* shape, std::vector<RibArg> args, ParamList params, float turn_degrees = 0) {
  const RibArg handle = string(r.args[1].strings[0]);
  Script script(r);
  script.say("AttributeBegin").say("AreaLightSource", {string("arealight"), handle}, emission(r));
  script.say("Surface", {string("constant")}).say("Color", {numbers({0, 0, 0})});
  script.say("Attribute", {string("visibility")}, {param("transmission", ValueType::Float, {0})});
  if (turn_degrees != 0) script.say("Rotate", {numbers({turn_degrees, 0, 1, 0})});
  script.say(shape, std::move(args), std::move(params)).say("AttributeEnd");
  return {script.list(), {standsIn(r, "arealight")}};
}

Translation rectLight(const Request& r) {
  Param p = param("P", ValueType::Point, {-.5f, -.5f, 0, .5f, -.5f, 0, -.5f, .5f, 0, .5f, .5f, 0});
  p.storage = Storage::Vertex;
  return areaLight(r, "Patch", {string("bilinear")}, {p});
}
Translation sphereLight(const Request& r) { return areaLight(r, "Sphere", {numbers({.5f, -.5f, .5f, 360})}, {}); }
Translation diskLight(const Request& r) { return areaLight(r, "Disk", {numbers({0, .5f, 360})}, {}); }

Translation cylinderLight(const Request& r) { return areaLight(r, "Cylinder", {numbers({.5f, -.5f, .5f, 360})}, {}, 90); }

Translation lightSource(const Request& r, const char* shader, const ParamList& more) {
  ParamList params = emission(r);
  params.insert(params.end(), more.begin(), more.end());
  return {Script(r).say("LightSource", {string(shader), string(r.args[1].strings[0])}, params).list(), {standsIn(r, shader)}};
}
Translation distantLight(const Request& r) {
  return lightSource(r, "distantlight", {param("from", ValueType::Point, {0, 0, 0}), param("to", ValueType::Point, {0, 0, 1})});
}
Translation domeLight(const Request& r) {
  const std::string map = text(r, "lightColorMap");
  return lightSource(r, "environmentlight", map.empty() ? ParamList{} : ParamList{param("map", map), param("mapspace", "shader")});
}

}  // namespace

Translation risLight(const Request& r) {
  static const std::unordered_map<std::string_view, Translation (*)(const Request&)> table = {
      {"PxrRectLight", rectLight}, {"PxrSphereLight", sphereLight},   {"PxrDiskLight", diskLight},
      {"PxrDomeLight", domeLight}, {"PxrDistantLight", distantLight}, {"PxrEnvDayLight", dayLight},
      {"PxrCylinderLight", cylinderLight}};
  const auto it = table.find(r.args[0].strings[0]);
  if (it != table.end()) return it->second(r);
  return {{}, {note(r, "is not available and has no substitute: it is dark", Severity::Missing)}};
}

}  // namespace tomales::rib
