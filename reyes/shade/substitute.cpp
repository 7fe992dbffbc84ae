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

/// Splits "myPointLight2_key" into "my", "point", "light" and "key".
std::vector<std::string> wordsOf(const std::string& name) {
  std::vector<std::string> out;
  const auto isUpper = [&](size_t i) { return i < name.size() && name[i] >= 'A' && name[i] <= 'Z'; };
  const auto isLower = [&](size_t i) { return i < name.size() && name[i] >= 'a' && name[i] <= 'z'; };
  bool inWord = false;
  for (size_t i = 0; i < name.size(); ++i) {
    const bool begins = isUpper(i) && (!isUpper(i - 1) || isLower(i + 1)), isLetter = isUpper(i) || isLower(i);
    if (isLetter && (!inWord || begins)) out.emplace_back();
    if (isLetter) out.back() += name.substr(i, 1);
    inWord = isLetter;
  }
  for (std::string& word : out) word = lowerCase(word);
  return out;
}

/// Tells whether a word begins or ends with `part`, apart from "light" at its end: "keyspot", "mydomelight".
bool means(std::string_view word, std::string_view part) {
  for (const std::string_view end : {"lights", "light"})
    if (word.ends_with(end)) word.remove_suffix(end.size());
  return word.starts_with(part) || word.ends_with(part);
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
                {"dome", "ambientlight"},
                {"env", "ambientlight"},
                {"environment", "ambientlight"},
                {"spot", "spotlight"},
                {"distant", "distantlight"},
                {"sun", "distantlight"},
                {"point", "pointlight"}};
  const std::vector<std::string> words = wordsOf(call.name);
  for (const auto& [part, light] : kNames)
    if (std::any_of(words.begin(), words.end(), [&](const std::string& word) {
          return *light ? means(word, part) : word.find(part) != word.npos;  // a wrong lamp is worse than none
        }))
      return area && *light ? "arealight" : light;
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
