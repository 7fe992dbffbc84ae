// Shaders and lights (RISpec 3.2 sections 4.2.3 to 4.2.6).
#include "reyes/rib/handlers.h"

namespace tomales::rib {
namespace {

// "shadowfile" is what listings of the 1990s call the map of those lights of PRMan whose names begin with "shadow".
void nameShadowMap(ShaderCall& light) {
  if (!light.name.starts_with("shadow") || findParam(light.params, "shadowname")) return;
  for (Param& p : light.params)
    if (p.name == "shadowfile") p.name = "shadowname";
}

int addLight(GraphicsState& s, const Request& r, bool area) {
  auto light = std::make_shared<LightCall>();
  light->shader = makeShaderCall(s, r);
  nameShadowMap(light->shader);
  light->handle = r.args[1].strings[0];
  light->area = area;
  light->castsShadows = area || s.scope.lightsCastShadows;
  light->index = static_cast<int>(s.globals.lights.size());
  s.globals.lights.push_back(light);
  s.scope.edit().lights.switchOn(light->index);
  return light->index;
}

void areaLightSource(GraphicsState& s, const Request& r) {
  const std::string& name = r.args[0].strings[0];
  const bool ends = name.empty() || name == "null";
  const int index = ends ? -1 : addLight(s, r, true);
  s.scope.edit().areaLight = index;
}

// Finds the latest light with that handle, because RIB writers restart their numbers in every frame.
void illuminate(GraphicsState& s, const Request& r) {
  const auto& lights = s.globals.lights;
  const auto it = std::find_if(lights.rbegin(), lights.rend(),
                               [&](const auto& light) { return light->handle == r.args[0].strings[0]; });
  if (it == lights.rend()) {
    s.warn(r, "rib-unknown-light", "no light has the handle \"" + r.args[0].strings[0] + "\"; ignored");
    return;
  }
  LightList& on = s.scope.edit().lights;
  if (r.args[1].number() != 0)
    on.switchOn((*it)->index);
  else
    on.switchOff((*it)->index);
}

std::shared_ptr<const ShaderCall> shaderOrNone(const GraphicsState& s, const Request& r) {
  const std::string& name = r.args[0].strings[0];
  if (name.empty() || name == "null") return nullptr;
  return std::make_shared<const ShaderCall>(makeShaderCall(s, r));
}

}  // namespace

ShaderCall makeShaderCall(const GraphicsState& s, const Request& r) {
  return {r.args[0].strings[0], r.params, s.scope.ctm, r.where};
}

const HandlerTable& shaderHandlers() {
  static const HandlerTable table = {
      {"Surface",
       [](GraphicsState& s, const Request& r) {
         s.scope.edit().surface = s.shaderInterner(std::make_shared<const ShaderCall>(makeShaderCall(s, r)));
       }},
      {"Displacement", [](GraphicsState& s, const Request& r) { s.scope.edit().displacement = shaderOrNone(s, r); }},
      {"Atmosphere", [](GraphicsState& s, const Request& r) { s.scope.edit().atmosphere = shaderOrNone(s, r); }},
      {"Interior", [](GraphicsState& s, const Request& r) { s.scope.edit().interior = shaderOrNone(s, r); }},
      {"Exterior", [](GraphicsState& s, const Request& r) { s.scope.edit().exterior = shaderOrNone(s, r); }},
      {"LightSource", [](GraphicsState& s, const Request& r) { addLight(s, r, false); }},
      {"AreaLightSource", areaLightSource},
      {"Illuminate", illuminate},
  };
  return table;
}

}  // namespace tomales::rib
