#include "reyes/rib/ris.h"

#include <fmt/format.h>

#include <set>
#include <unordered_map>

#include "reyes/rib/ris_parts.h"

namespace tomales::rib {
namespace {

using Translator = Translation (*)(const Request&, RisState&);

// A path of length 1 is direct light alone (maxPathLength of PRMan 19 to 22).
Translation integrator(const Request& r, RisState& state) {
  const std::string& name = r.args[0].strings[0];
  state.hasIntegrator = name != "PxrDefault";  // headLamp() is its other half
  if (name == "PxrDirectLighting" || name == "PxrDefault")
    return {{}, {standsIn(r, "direct light of the scene's own lights")}};
  ParamList params;
  const Param *bounces = findParam(r.params, "maxIndirectBounces"), *length = findParam(r.params, "maxPathLength");
  const float most = bounces ? bounces->number(1) : length ? length->number(2) - 1 : 1;
  if (bounces || length) params.push_back(param("bounces", ValueType::Float, {most}));
  static const std::set<std::string_view> global = {"PxrPathTracer", "PxrVCM", "PxrUPBP", "PxrUnified"};
  const Severity severity = global.contains(name) ? Severity::Warning : Severity::Missing;
  if (most < 1) return {{}, {standsIn(r, "direct light alone", severity)}};
  return {Script(r).say("LightSource", {string("indirectlight"), string("Integrator " + name)}, params).list(),
          {standsIn(r, "indirectlight", severity)}};
}

Translation ignored(const Request& r, RisState&) { return {{}, {note(r, "is not available: ignored")}}; }

Translation light(const Request& r, RisState& state) {
  state.hasLight = true;
  return risLight(r);
}

Translation bxdf(const Request& r, RisState& state) {
  if (!state.bxdf) state.bxdf = r;
  state.bxdfs[r.args[1].strings[0]] = r;
  return risBxdf(r, state);
}

Translation pattern(const Request& r, RisState& state) {
  state.patterns[r.args[1].strings[0]] = r;
  return {};  // the requests that refer to it report what becomes of it
}

Translation camera(const Request& r, RisState&) {
  return {
      {},
      {{"Camera", "Camera: the one camera is that of Projection and WorldBegin; its name and parameters are ignored",
        r.where}}};
}

// A PxrBackground lies behind the picture; other filters change the picture.
Translation displayFilter(const Request& r, RisState& state) {
  if (!r.args[0].strings[0].starts_with("PxrBackground")) return ignored(r, state);
  return {
      Script(r)
          .say("Imager", {string("background")}, {param("bgcolor", ValueType::Color, color(r, "backgroundColor", 0))})
          .list(),
      {standsIn(r, "the imager background")}};
}

const std::unordered_map<std::string_view, Translator>& translators() {
  static const std::unordered_map<std::string_view, Translator> table = {
      {"Bxdf", bxdf},
      {"Light", light},
      {"AreaLightSource", stdLight},
      {"Geometry", [](const Request& r, RisState& state) { return envSphere(r, state); }},
      {"Option", [](const Request& r, RisState&) { return riValues(r); }},
      {"Attribute", [](const Request& r, RisState&) { return riValues(r); }},
      {"Integrator", integrator},
      {"Pattern", pattern},
      {"Camera", camera},
      {"DisplayFilter", displayFilter},
      {"SampleFilter", displayFilter},
      {"LightFilter", ignored},
      {"Displace", ignored}};
  return table;
}

}  // namespace

Note note(const Request& r, const std::string& what, Severity severity) {
  const std::string name = fmt::format("{} \"{}\"", r.name, r.args[0].strings[0]);
  return {name, name + " " + what, r.where, severity};
}

Note standsIn(const Request& r, const std::string& substitute, Severity severity) {
  return note(r, "is not available: " + substitute + " stands in for it", severity);
}

// Requests that are older than RIS belong here if they name something of RIS.
bool isRis(const Request& r) {
  if (r.name == "Option" || r.name == "Attribute") return r.args[0].strings[0] == "Ri";
  if (r.name == "AreaLightSource")
    return r.args[0].strings[0].find("PxrStd") != std::string::npos || r.args[0].strings[0] == "PxrAreaLight";
  if (r.name == "Geometry") return r.args[0].strings[0] == "envsphere";
  return translators().contains(r.name);
}

Translation translateRis(const Request& r, RisState& state) { return translators().at(r.name)(r, state); }

}  // namespace tomales::rib
