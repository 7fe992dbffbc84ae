// Attributes other than shaders (RISpec 3.2 section 4.2).
#include <fmt/format.h>

#include "reyes/base/deep_stack.h"
#include "reyes/rib/handlers.h"
#include "reyes/rib/refusals.h"

namespace tomales::rib {
namespace {

void rejectAttribute(GraphicsState& s, const Request& r, const std::string& why) {
  s.warn(r, "rib-attribute", why + "; the attribute is left as it was");
}

void textureCoordinates(GraphicsState& s, const Request& r) {
  const std::vector<float>& a = r.args[0].numbers;
  for (size_t i = 0; i < 4; ++i) s.scope.edit().textureCoordinates[i] = {a[2 * i], a[2 * i + 1]};
}

// A thousand micropolygons a pixel are as many as sampling can tell apart, and take as long as one can wait for a scene
// of one layer.
void setShadingRate(GraphicsState& s, const Request& r) {
  s.scope.edit().shadingRate = clamped(s, r, s.scope.shadingRate * s.scope.relativeShadingRate, 1e-3f, 1e8f);
}

void shadingRate(GraphicsState& s, const Request& r) {
  const float rate = r.args[0].number();
  if (!(rate > 0)) return rejectAttribute(s, r, fmt::format("{} is no area", rate));
  s.scope.shadingRate = rate;
  setShadingRate(s, r);
}

// PRMan has factors of ShadingRate, which multiply down the blocks until one is reset.
void relativeShadingRate(GraphicsState& s, const Request& r, float factor, bool resets) {
  if (!(factor > 0)) return rejectAttribute(s, r, fmt::format("{} is no factor", factor));
  s.scope.relativeShadingRate = std::clamp(resets ? factor : factor * s.scope.relativeShadingRate, 1e-4f, 1e4f);
  setShadingRate(s, r);
}

// RISpec 3.2 section 4.2.9 has "flatness", which no later renderer of polygons uses; the factors are PRMan's.
void geometricApproximation(GraphicsState& s, const Request& r) {
  const std::string& kind = r.args[0].strings[0];
  const float value = r.args[1].number();
  if (kind != "motionfactor" && kind != "focusfactor") {
    s.warnOnce("GeometricApproximation " + kind, r, "rib-unsupported",
               "GeometricApproximation \"" + kind + "\" is not supported: ShadingRate alone says how fine; ignored");
    return;
  }
  if (!(value >= 0)) return rejectAttribute(s, r, fmt::format("\"{}\" cannot be {}", kind, value));
  Attributes& a = s.scope.edit();
  (kind == "motionfactor" ? a.motionFactor : a.focusFactor) = value;
}

void shadingInterpolation(GraphicsState& s, const Request& r) {
  const std::string& kind = r.args[0].strings[0];
  if (kind != "constant" && kind != "smooth") return rejectAttribute(s, r, "unknown interpolation \"" + kind + "\"");
  s.scope.edit().interpolation = kind == "smooth" ? ShadingInterpolation::Smooth : ShadingInterpolation::Constant;
}

void sides(GraphicsState& s, const Request& r) {
  const float n = r.args[0].number();
  if (n != 1 && n != 2) return rejectAttribute(s, r, fmt::format("a surface has 1 or 2 sides, not {}", n));
  s.scope.edit().sides = static_cast<int>(n);
}

// "lh" and "rh" name a handedness; what is stored is relative to that of the current coordinate system.
// Camera space is left-handed, so a positive determinant means left.
void orientation(GraphicsState& s, const Request& r) {
  const std::string& kind = r.args[0].strings[0];
  const mat4 m = s.cameraFromObject().keys.front();
  const bool leftHanded = glm::determinant(mat3(m)) > 0;
  if (kind == "outside" || kind == "inside")
    s.scope.edit().insideOut = kind == "inside";
  else if (kind == "lh" || kind == "rh")
    s.scope.edit().insideOut = (kind == "lh") != leftHanded;
  else
    rejectAttribute(s, r, "unknown orientation \"" + kind + "\"");
}

void basis(GraphicsState& s, const Request& r) {
  const auto read = [&](const RibArg& matrix, const RibArg& step, Basis& out) {
    static const std::unordered_map<std::string_view, Basis (*)()> kNamed = {{"bezier", bezierBasis},
                                                                             {"b-spline", bsplineBasis},
                                                                             {"catmull-rom", catmullRomBasis},
                                                                             {"hermite", hermiteBasis},
                                                                             {"power", powerBasis}};
    Basis b = out;
    if (matrix.kind == RibArg::Kind::Numbers) {
      b.matrix = asMatrix(matrix.numbers);  // Basis::matrix[k] is row k, too
    } else if (const auto it = kNamed.find(matrix.strings[0]); it != kNamed.end()) {
      b = it->second();
    } else {
      return rejectAttribute(s, r, "unknown basis \"" + matrix.strings[0] + "\"");
    }
    b.step = step.integer();
    if (b.step < 1 || b.step > 4) return rejectAttribute(s, r, fmt::format("a basis step of {}", b.step));
    out = b;
  };
  read(r.args[0], r.args[1], s.scope.uBasis);
  read(r.args[2], r.args[3], s.scope.vBasis);
}

// `sense` names the side that is cut away.
void trimSense(GraphicsState& s, const Request& r, const std::string& sense) {
  if (sense != "inside" && sense != "outside")
    return rejectAttribute(s, r, "the sense of trim curves is \"inside\" or \"outside\"");
  s.scope.trim = std::make_shared<TrimLoops>(TrimLoops{s.scope.trim->loops, sense == "outside"});
}

vec3 color(const Param& p) { return p.floats.size() == 3 ? vec3(p.floats[0], p.floats[1], p.floats[2]) : vec3(1); }

// "a,b" replaces the sets, "+a,b" joins sets and "-a,b" leaves them.
void editMembership(std::set<std::string>& sets, std::string_view text) {
  const bool joins = text.starts_with('+'), leaves = text.starts_with('-');
  if (joins || leaves)
    text.remove_prefix(1);
  else
    sets.clear();
  while (!text.empty()) {
    const size_t end = std::min(text.find_first_of(", "), text.size());
    if (end > 0 && leaves) sets.erase(std::string(text.substr(0, end)));
    if (end > 0 && !leaves) sets.emplace(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

// The attribute of PRMan up to version 12: what shadow rays see, and how they find its opacity.
void transmission(Attributes& a, const Param& p) {
  a.visibility.transmission = p.strings[0] != "transparent";
  a.transmissionHitMode = p.strings[0] == "shader" ? HitMode::Shader : HitMode::Primitive;
}

// The attribute of BMRT: "none", "opaque", "Os" and "shade" (its User Guide, attribute "render" "casts_shadows").
void castsShadows(Attributes& a, const Param& p) {
  a.visibility.transmission = p.strings[0] != "none";
  a.transmissionHitMode = p.strings[0] == "shade" ? HitMode::Shader : HitMode::Primitive;
}

// "cache" reads files that may be missing; the object's shader gives the same result.
HitMode hitMode(const Param& p) { return p.strings[0] == "primitive" ? HitMode::Primitive : HitMode::Shader; }

TessellationMode tessellationMode(const Param& p) {
  const std::string& mode = p.strings[0];
  return mode == "full"              ? TessellationMode::Full
         : mode == "multiresolution" ? TessellationMode::Multiresolution
                                     : TessellationMode::Fixed;
}

using Setter = void (*)(Attributes&, const Param&);
const std::unordered_map<std::string_view, Setter>& numberSetters() {
  static const std::unordered_map<std::string_view, Setter> table = {
      {"displacementbound:sphere",
       [](Attributes& a, const Param& p) { a.displacementBound = std::max(0.0f, p.number(0)); }},
      {"bound:displacement",  // until PRMan 3.8
       [](Attributes& a, const Param& p) { a.displacementBound = std::max(0.0f, p.number(0)); }},
      {"visibility:camera", [](Attributes& a, const Param& p) { a.visibility.camera = p.number(1) != 0; }},
      {"visibility:diffuse", [](Attributes& a, const Param& p) { a.visibility.diffuse = p.number(1) != 0; }},
      {"visibility:specular", [](Attributes& a, const Param& p) { a.visibility.specular = p.number(1) != 0; }},
      {"visibility:transmission", [](Attributes& a, const Param& p) { a.visibility.transmission = p.number(1) != 0; }},
      {"visibility:trace",  // until PRMan 12
       [](Attributes& a, const Param& p) { a.visibility.diffuse = a.visibility.specular = p.number(1) != 0; }},
      {"visibility:indirect",  // of the RIS era
       [](Attributes& a, const Param& p) { a.visibility.diffuse = a.visibility.specular = p.number(1) != 0; }},
      {"visibility:photon", [](Attributes& a, const Param& p) { a.visibility.photon = p.number(1) != 0; }},
      {"trace:bias", [](Attributes& a, const Param& p) { a.trace.bias = p.number(0); }},
      {"trace:offset", [](Attributes& a, const Param& p) { a.trace.offset = p.number(0); }},
      {"trace:displacements",
       [](Attributes& a, const Param& p) {
         a.trace.displacements = p.number(0) != 0;
         a.trace.displacementsGiven = true;
       }},
      {"trace:samplemotion", [](Attributes& a, const Param& p) { a.trace.sampleMotion = p.number(0) != 0; }},
      {"trace:maxdiffusedepth",
       [](Attributes& a, const Param& p) {
         a.trace.maxDiffuseDepth = static_cast<int>(std::clamp<float>(p.number(1), 0, kMostBounces));
       }},
      {"trace:maxspeculardepth",
       [](Attributes& a, const Param& p) {
         a.trace.maxSpecularDepth = static_cast<int>(std::clamp<float>(p.number(2), 0, kMostBounces));
       }},
      {"trace:tessellation", [](Attributes& a, const Param& p) { a.trace.tessellation = p.number(1); }},
      {"indirect:receive", [](Attributes& a, const Param& p) { a.indirect.receive = p.number(1) != 0; }},
      {"indirect:gain", [](Attributes& a, const Param& p) { a.indirect.gain = p.number(1); }},
      {"indirect:bleeding", [](Attributes& a, const Param& p) { a.indirect.bleeding = p.number(1); }},
      {"indirect:bleedingcolor", [](Attributes& a, const Param& p) { a.indirect.bleedingColor = color(p); }},
      {"radiosity:screentexels",
       [](Attributes& a, const Param& p) {
         a.radiosity = {true, p.number(0)};
       }},
      {"radiosity:worldtexels",
       [](Attributes& a, const Param& p) {
         a.radiosity = {false, p.number(0)};
       }},
      {"irradiance:maxerror", [](Attributes& a, const Param& p) { a.irradianceMaxError = p.number(0); }},
      {"irradiance:maxpixeldist", [](Attributes& a, const Param& p) { a.irradianceMaxPixelDist = p.number(0); }},
      {"cull:hidden", [](Attributes& a, const Param& p) { a.cull.hidden = p.number(1) != 0; }},
      {"cull:backfacing", [](Attributes& a, const Param& p) { a.cull.backfacing = p.number(1) != 0; }},
      {"dice:binary", [](Attributes& a, const Param& p) { a.binaryDice = p.number(0) != 0; }},
      {"dice:rasterorient", [](Attributes& a, const Param& p) { a.rasterOrient = p.number(1) != 0; }},
  };
  return table;
}

const std::unordered_map<std::string_view, Setter>& textSetters() {
  static const std::unordered_map<std::string_view, Setter> table = {
      {"identifier:name", [](Attributes& a, const Param& p) { a.name = p.strings[0]; }},
      {"visibility:transmission", transmission},
      {"render:casts_shadows", castsShadows},
      {"displacementbound:coordinatesystem",
       [](Attributes& a, const Param& p) { a.displacementBoundSpace = p.strings[0]; }},
      {"photon:globalmap", [](Attributes& a, const Param& p) { a.photon.globalMap = p.strings[0]; }},
      {"photon:causticmap", [](Attributes& a, const Param& p) { a.photon.causticMap = p.strings[0]; }},
      {"photon:shadingmodel", [](Attributes& a, const Param& p) { a.photon.shadingModel = p.strings[0]; }},
      {"grouping:membership", [](Attributes& a, const Param& p) { editMembership(a.membership, p.strings[0]); }},
      {"trace:tessellationmode", [](Attributes& a, const Param& p) { a.trace.rate = tessellationMode(p); }},
      {"grouping:tracesubset", [](Attributes& a, const Param& p) { a.trace.subset = p.strings[0]; }},
      {"shade:diffusehitmode", [](Attributes& a, const Param& p) { a.diffuseHitMode = hitMode(p); }},
      {"shade:specularhitmode", [](Attributes& a, const Param& p) { a.specularHitMode = hitMode(p); }},
      {"shade:transmissionhitmode", [](Attributes& a, const Param& p) { a.transmissionHitMode = hitMode(p); }},
      {"indirect:surface", [](Attributes& a, const Param& p) { a.indirect.surface = p.strings[0]; }},
  };
  return table;
}

/// Checks the word that some attributes have; "cache" counts as "shader".
void checkWord(GraphicsState& s, const Request& r, const std::string& key, const std::string& word) {
  using Words = std::vector<std::string_view>;
  static const std::unordered_map<std::string_view, Words> table = {
      {"trace:tessellationmode", {"fixed", "multiresolution", "full"}},
      {"shade:diffusehitmode", {"shader", "primitive", "cache"}},
      {"shade:specularhitmode", {"shader", "primitive", "cache"}},
      {"shade:transmissionhitmode", {"shader", "primitive", "cache"}},
  };
  const auto known = table.find(key);
  if (known == table.end() || std::find(known->second.begin(), known->second.end(), word) != known->second.end())
    return;
  s.warnOnce(key + ' ' + word, r, "rib-unknown-attribute",
             fmt::format("Attribute \"{}\" knows no \"{}\"; \"{}\" is taken", key, word, known->second[0]));
}

// User attributes are read by name where they are used; all others have no effect.
void attribute(GraphicsState& s, const Request& r) {
  const std::string& category = r.args[0].strings[0];
  for (const Param& p : r.params) {
    const std::string key = category + ":" + p.name;
    const bool text = p.type == ValueType::String;
    const auto& setters = text ? textSetters() : numberSetters();
    const bool empty = text ? p.strings.empty() : p.floats.empty() && p.ints.empty();
    if (category == "render") s.scope.edit().user[key] = p;  // shows that the scene was made for BMRT
    if (empty) {
      rejectAttribute(s, r, "\"" + key + "\" has no value");
    } else if (const auto it = setters.find(key); it != setters.end()) {
      if (text) checkWord(s, r, key, p.strings[0]);
      it->second(s.scope.edit(), p);
    } else if (key == "trimcurve:sense") {
      trimSense(s, r, text ? p.strings[0] : "");
    } else if (key == "shade:relativeshadingrate" || key == "shade:resetrelativeshadingrate") {
      relativeShadingRate(s, r, p.number(1), key == "shade:resetrelativeshadingrate");
    } else if (key == "dice:roundcurve") {
      s.scope.roundCurves = p.number(0) != 0;
    } else if (key == "light:shadows") {
      s.scope.lightsCastShadows = text ? p.strings[0] == "on" : p.number(0) != 0;
    } else {
      s.scope.edit().user[key] = p;
      // "identifier:shadinggroup" is for Cryptomatte (reyes/frame/write_frame.cpp)
      if (category != "user" && key != "identifier:shadinggroup") warnOfIgnored(s, r, key);
    }
  }
}

// Ignores hints that other renderers cannot work without; this one bounds primitives itself.
void acceptHint(GraphicsState&, const Request&) {}

}  // namespace

const HandlerTable& attributeHandlers() {
  static const HandlerTable table = {
      {"Attribute", attribute},
      {"Color", [](GraphicsState& s, const Request& r) { s.scope.edit().color = asVec3(r.args[0]); }},
      {"Opacity", [](GraphicsState& s, const Request& r) { s.scope.edit().opacity = asVec3(r.args[0]); }},
      {"TextureCoordinates", textureCoordinates},
      {"ShadingRate", shadingRate},
      {"GeometricApproximation", geometricApproximation},
      {"ShadingInterpolation", shadingInterpolation},
      {"Matte", [](GraphicsState& s, const Request& r) { s.scope.edit().matte = r.args[0].number() != 0; }},
      {"Sides", sides},
      {"Orientation", orientation},
      {"ReverseOrientation",
       [](GraphicsState& s, const Request&) {
         Attributes& a = s.scope.edit();
         a.insideOut = !a.insideOut;
       }},
      {"Basis", basis},
      {"TrimCurve", trimCurve},
      {"Bound", acceptHint},
  };
  return table;
}

}  // namespace tomales::rib
