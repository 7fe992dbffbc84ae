#include "reyes/shade/substitute.h"

#include <algorithm>
#include <cmath>

#include "reyes/base/text.h"
#include "reyes/shader/params.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

void shadeSubstitute(const TmGrid* g) {
  for (int i = 0; i < g->count; ++i) {
    if (!g->active[i]) continue;
    const float parity = std::fmod(std::floor(g->u[i] * 8) + std::floor(g->v[i] * 8), 2.0f);
    const float bright = parity == 0.0f ? 1.0f : 0.1f;
    g->Ci.x[i] = bright;
    g->Ci.y[i] = 0;
    g->Ci.z[i] = bright;
    g->Oi.x[i] = g->Oi.y[i] = g->Oi.z[i] = 1;
  }
}

}  // namespace

const TmShader& substituteSurface() {
  static const rsl::Shader shader(TM_SURFACE, "(missing shader)", "stands in for a missing surface shader", 0,
                                  shadeSubstitute, {});
  return *shader;
}

const char* standardLightFor(const ShaderCall& call, bool area) {
  static constexpr struct {
    const char *part, *light;
  } kNames[] = {{"caustic", ""},
                {"indirect", ""},
                {"photon", ""},
                {"bake", ""},
                {"ambient", "ambientlight"},
                {"occlusion", "ambientlight"},
                {"sky", "ambientlight"},
                {"environment", "ambientlight"},
                {"spot", "spotlight"},
                {"distant", "distantlight"},
                {"sun", "distantlight"},
                {"point", "pointlight"}};
  const std::string name = lowerCase(call.name);
  for (const auto& [part, light] : kNames)
    if (name.find(part) != name.npos) return area && *light ? "arealight" : light;
  if (area) return "arealight";
  const auto gives = [&](const char* parameter) { return findParam(call.params, parameter) != nullptr; };
  if (gives("coneangle") || gives("conedeltaangle") || gives("beamdistribution")) return "spotlight";
  if (gives("to")) return "distantlight";
  const bool placed = call.worldFromShader != Motion{};
  return gives("from") || placed ? "pointlight" : "ambientlight";
}

ShaderCall callFor(const TmShader& shader, const ShaderCall& call) {
  const std::span<const TmParamDecl> own(shader.params, static_cast<size_t>(shader.paramCount)),
      standard = standardParams(static_cast<TmKind>(shader.kind));
  const auto has = [](std::span<const TmParamDecl> list, const std::string& name) {
    return std::any_of(list.begin(), list.end(), [&](const TmParamDecl& d) { return d.name == name; });
  };
  ShaderCall out = call;
  std::erase_if(out.params, [&](const Param& p) { return !has(own, p.name) && !has(standard, p.name); });
  return out;
}

}  // namespace tomales
