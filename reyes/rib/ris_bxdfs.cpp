// Materials of the RIS era and the patterns that feed them.
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "reyes/rib/ris_parts.h"

namespace tomales::rib {
namespace {

/// The names of a plug-in's parameters that correspond to those of our shaders; null if it has no such parameter.
struct Bxdf {
  const char* color;
  float grey;  ///< The default of that colour.
  const char *roughness, *diffuseGain, *metallic;
  bool shiny, emits;
  bool metal = false;  ///< True if it is always a metal.
};
constexpr Bxdf kMatte{"diffuseColor", 0.5f, nullptr, nullptr, nullptr, false, false};
constexpr Bxdf kLama{"color", 0.5f, nullptr, nullptr, nullptr, false, false};
constexpr Bxdf kBlack{"no color", 0, nullptr, nullptr, nullptr, false, true};

const std::unordered_map<std::string_view, Bxdf>& bxdfs() {
  static const std::unordered_map<std::string_view, Bxdf> table = {
      {"PxrDiffuse", kMatte},
      {"PxrLMDiffuse", {"frontColor", 0.5f, nullptr, nullptr, nullptr, false, false}},
      {"PxrConstant", {"emitColor", 1, nullptr, nullptr, nullptr, false, true}},
      {"PxrDisney", {"baseColor", 0.5f, "roughness", nullptr, "metallic", true, false}},
      {"PxrDisneyBsdf", {"baseColor", 0.5f, "roughness", nullptr, "metallic", true, false}},
      {"PxrSurface", {"diffuseColor", 0.18f, "specularRoughness", "diffuseGain", nullptr, true, false}},
      {"PxrLayerSurface", {"diffuseColor", 0.18f, "specularRoughness", "diffuseGain", nullptr, true, false}},
      {"PxrLMPlastic", {"diffuseColor", 0.18f, "roughness", nullptr, nullptr, true, false}},
      {"PxrLMMetal", {"specularColor", 1, "roughness", nullptr, nullptr, true, false, true}},
      {"PxrMarschnerHair", kMatte},
      {"PxrBlack", kBlack},
      {"PxrLightEmission", kBlack},  // the light does the rest
      {"LamaDiffuse", kLama},
      {"LamaSSS", kLama},
      {"LamaTranslucent", kLama},
      {"LamaEmission", {"color", 1, nullptr, nullptr, nullptr, false, true}},
      {"LamaConductor", {"reflectivity", 1, "roughness", nullptr, nullptr, true, false, true}}};
  return table;
}

/// The value that a reference to a pattern stands for.
struct Source {
  std::vector<float> color;  ///< Empty if it has none.
  std::string texture;
  bool own = false;  ///< True for Cs of the primitive.
  std::vector<Note> notes;
};

std::vector<float> mean(const std::vector<float>& a, const std::vector<float>& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

/// Follows a reference "handle:output".
Source follow(const Request& r, const char* name, const Nodes& patterns) {
  const std::string reference = wordOf(r.params, name);
  const auto it = patterns.find(reference.substr(0, reference.find(':')));
  if (it == patterns.end()) {
    Note none =
        note(r, fmt::format("refers to a pattern \"{}\", which is unknown: \"{}\" keeps its default", reference, name));
    none.key += " " + reference;
    none.code = "rib-reference";
    return {{}, "", false, {none}};
  }
  const Request& pattern = it->second;
  const std::string& kind = pattern.args[0].strings[0];
  const std::string variable = wordOf(pattern.params, "varname") + wordOf(pattern.params, "variable");
  if (kind == "PxrTexture" && !wordOf(pattern.params, "filename").empty())
    return {
        {1, 1, 1}, wordOf(pattern.params, "filename"), false, {standsIn(pattern, "paintedplastic with its picture")}};
  if (kind == "PxrChecker")
    return {mean(color(pattern, "colorA", 1), color(pattern, "colorB", 0)),
            "",
            false,
            {standsIn(pattern, "the mean of its colours")}};
  if ((kind == "PxrPrimvar" || kind == "PxrVariable") && (variable == "Cs" || variable == "Ci"))
    return {{}, "", true, {standsIn(pattern, "Cs")}};
  return {{}, "", false, {note(pattern, "is not available: what is connected to it keeps its default")}};
}

Source baseColor(const Request& r, const Bxdf& b, const Nodes& patterns) {
  const char* name = findParam(r.params, b.color) ? b.color : "diffuseColor";
  if (isReference(r, name)) {
    Source source = follow(r, name, patterns);
    if (source.color.empty() && !source.own) source.color = std::vector<float>(3, b.grey);
    return source;
  }
  return {color(r, name, b.grey), "", false, {}};
}

/// References to numbers keep the default, which is noted; those to colours have been followed.
void noteReferences(const Request& r, const Bxdf& b, const Nodes& patterns, std::vector<Note>& notes) {
  for (const auto& [name, type] : r.references)
    if (name != b.color && name != "diffuseColor")
      for (Note& n : follow(r, name.c_str(), patterns).notes)
        if (n.text.find("stands in") == std::string::npos) notes.push_back(std::move(n));
}

/// Returns the name of the parameter with the index of refraction of a transparent material; null if it is opaque.
const char* indexOf(const Request& r) {
  static const std::unordered_map<std::string_view, const char*> table = {{"PxrGlass", "ior"},
                                                                          {"PxrLMGlass", "eta"},
                                                                          {"LamaDielectric", "IOR"},
                                                                          {"PxrSurface", "glassIor"},
                                                                          {"PxrLayerSurface", "glassIor"}};
  const std::string& name = r.args[0].strings[0];
  const auto it = table.find(name);
  if (it == table.end() || (it->second == std::string_view("glassIor") && !(number(r, "refractionGain", 0) > 0.5f)))
    return nullptr;
  return it->second;
}

Translation glass(const Request& r, const char* index) {
  ParamList params{param("eta", ValueType::Float, {number(r, index, 1.5f)})};
  for (const char* tint : {"refractionColor", "transmissionTint"})
    if (findParam(r.params, tint)) params.push_back(param("transmitcolor", ValueType::Color, color(r, tint, 1)));
  return {Script(r).say("Surface", {string("glass")}, std::move(params)).list(), {standsIn(r, "glass")}};
}

/// Returns the colour that a metal reflects at normal incidence, from Fresnel's equations for the index n and the
/// absorption k, or from artistic colours.
std::vector<float> metalColor(const Request& r, const Bxdf& b) {
  const auto fresnel = [](float n, float k) { return ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k); };
  const auto physical = [&](const char* index, const char* absorption) {
    std::vector<float> n = color(r, index, 1.5f), k = color(r, absorption, 0);
    for (size_t i = 0; i < 3; ++i) n[i] = fresnel(n[i], k[i]);
    return n;
  };
  if (findParam(r.params, "kappa")) return physical("eta", "kappa");
  if (!b.diffuseGain) return color(r, b.color, b.grey);
  const std::vector<float> edge = color(r, "specularEdgeColor", 1), face = color(r, "specularFaceColor", 0);
  if (number(r, "specularFresnelMode", 0) == 0) return face[0] + face[1] + face[2] > 0 ? face : edge;
  std::vector<float> out = physical("specularIor", "specularExtinctionCoeff");
  for (size_t i = 0; i < 3; ++i) out[i] *= edge[i];
  return out;
}

/// The number of rays by which a point mirrors the scene.
constexpr float kReflections = 4;

/// Adds the parameters that `disney` shares with PxrDisney. PxrSurface gives its specular lobe by the colour at normal
/// incidence, which is 0.08 times disney's. RIS mirrors the scene in metals and coats.
void addDisney(const Request& r, bool metal, ParamList& params) {
  const auto add = [&](const char* name, float value) { params.push_back(param(name, ValueType::Float, {value})); };
  static constexpr std::pair<const char*, const char*> same[] = {
      {"specular", "specular"},   {"specularTint", "speculartint"}, {"sheen", "sheen"},
      {"sheenTint", "sheentint"}, {"clearcoat", "clearcoat"},       {"clearcoatGloss", "clearcoatgloss"}};
  for (const auto& [theirs, ours] : same)
    if (findParam(r.params, theirs)) add(ours, number(r, theirs, 0));
  if (const Param* metallic = findParam(r.params, "metallic"); metallic || metal)
    add("metallic", metallic ? metallic->number(0) : 1);
  if (findParam(r.params, "specularFaceColor")) {
    const std::vector<float> face = color(r, "specularFaceColor", 0);
    add("specular", (face[0] + face[1] + face[2]) / (3 * 0.08f));
  }
  if (metal || number(r, "clearcoat", 0) > 0) add("reflections", kReflections);
}

/// Returns the parameter of a material made of others that names the one that is most of it; null for other materials.
const char* mainPart(const std::string& bxdf) {
  static const std::unordered_map<std::string_view, const char*> table = {{"LamaSurface", "materialFront"},
                                                                          {"LamaLayer", "materialBase"},
                                                                          {"LamaMix", "material1"},
                                                                          {"LamaAdd", "material1"}};
  const auto it = table.find(bxdf);
  return it == table.end() ? nullptr : it->second;
}

/// Follows a material to the simple one that is most of it. Returns the material itself if its parts are missing, or
/// refer to each other without end.
const Request& simpleBxdf(const Request& r, const Nodes& bxdfs) {
  const Request* simple = &r;
  for (size_t steps = 0; steps <= bxdfs.size(); ++steps) {
    const char* part = mainPart(simple->args[0].strings[0]);
    if (!part) return *simple;
    const auto it = bxdfs.find(wordOf(simple->params, part));
    if (it == bxdfs.end()) return r;
    simple = &it->second;
  }
  return r;
}

Translation simpleTranslation(const Request& r, const Nodes& patterns) {
  const std::string& name = r.args[0].strings[0];
  if (const char* index = indexOf(r)) return glass(r, index);
  const auto it = bxdfs().find(name);
  const Bxdf b = it == bxdfs().end() ? kMatte : it->second;
  Source base = baseColor(r, b, patterns);
  const bool metal =
      b.metal || (b.metallic && number(r, b.metallic, 0) > 0.5f) || (b.diffuseGain && number(r, b.diffuseGain, 1) <= 0);
  ParamList params;
  if (b.roughness && findParam(r.params, b.roughness))
    params.push_back(param("roughness", ValueType::Float, {std::clamp(number(r, b.roughness, 0.1f), 0.001f, 1.0f)}));
  std::string shader = b.emits ? "constant" : b.shiny ? "disney" : "matte";
  if (b.shiny) addDisney(r, metal, params);
  if (metal && !b.metallic) base.color = metalColor(r, b);
  if (b.shiny && !base.texture.empty()) {
    params.push_back(param("texturename", base.texture));
  } else if (!base.texture.empty()) {
    shader = "paintedplastic";
    params.push_back(param("texturename", base.texture));
    params.push_back(param("Ks", ValueType::Float, {0}));
    params.push_back(param("Kd", ValueType::Float, {1}));
  }
  Script script(r);
  if (!base.own) script.say("Color", {numbers(base.color)});
  script.say("Surface", {string(shader)}, params);
  std::vector<Note> notes{standsIn(r, shader, it == bxdfs().end() ? Severity::Missing : Severity::Warning)};
  notes.insert(notes.end(), base.notes.begin(), base.notes.end());
  noteReferences(r, b, patterns, notes);
  return {script.list(), std::move(notes)};
}

}  // namespace

Translation risBxdf(const Request& r, const RisState& state) {
  const Request& simple = simpleBxdf(r, state.bxdfs);
  Translation out = simpleTranslation(simple, state.patterns);
  if (&simple != &r)
    out.notes.push_back(standsIn(
        r, fmt::format("{} \"{}\", of which it consists", simple.args[0].strings[0], simple.args[1].strings[0])));
  return out;
}

}  // namespace tomales::rib
