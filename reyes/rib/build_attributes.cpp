// Attributes other than shaders (RISpec 3.2 section 4.2).
#include <fmt/format.h>

#include "reyes/attribute_table.h"
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

// The limit of a thousand micropolygons per pixel is as many as sampling can distinguish, and takes as long as one can
// wait even for a scene of one layer.
void setShadingRate(GraphicsState& s, const Request& r) {
  s.scope.edit().shadingRate = clamped(s, r, s.scope.shadingRate * s.scope.relativeShadingRate, 1e-3f, 1e8f);
}

void shadingRate(GraphicsState& s, const Request& r) {
  const float rate = r.args[0].number();
  if (!(rate > 0)) return rejectAttribute(s, r, fmt::format("{} is no area", rate));
  s.scope.shadingRate = rate;
  setShadingRate(s, r);
}

// PRMan has factors on ShadingRate, which multiply through nested blocks until one is reset.
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
    Basis b = out;
    if (matrix.kind == RibArg::Kind::Numbers) {
      b.matrix = asMatrix(matrix.numbers);  // Basis::matrix[k] is row k, too
    } else if (const std::optional<Basis> named = basisNamed(matrix.strings[0])) {
      b = *named;
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

/// Checks the value of an attribute that takes one of some words.
void checkWord(GraphicsState& s, const Request& r, const NamedAttribute& row, const std::string& word) {
  if (row.words.empty() || std::find(row.words.begin(), row.words.end(), word) != row.words.end()) return;
  s.warnOnce(std::string(row.name) + ' ' + word, r, "rib-unknown-attribute",
             fmt::format("Attribute \"{}\" knows no \"{}\"; \"{}\" is taken", row.name, word, row.words[0]));
}

// User attributes are read by name where they are used; all others have no effect.
void attribute(GraphicsState& s, const Request& r) {
  const std::string& category = r.args[0].strings[0];
  for (const Param& p : r.params) {
    const std::string key = category + ":" + p.name;
    const bool text = p.type == ValueType::String;
    const NamedAttribute* row = findNamedAttribute(key);
    const auto set = !row ? nullptr : text ? row->setStrings : row->setNumbers;
    const bool empty = text ? p.strings.empty() : p.floats.empty() && p.ints.empty();
    if (category == "render") s.scope.edit().user[key] = p;  // shows that the scene was made for BMRT
    if (empty) {
      rejectAttribute(s, r, "\"" + key + "\" has no value");
    } else if (set) {
      if (text) checkWord(s, r, *row, p.strings[0]);
      set(s.scope.edit(), p);
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
      // "identifier:shadinggroup" is for Cryptomatte (reyes/frame/matte_names.cpp)
      if (category != "user" && key != "identifier:shadinggroup") warnOfIgnored(s, r, key);
    }
  }
}

// Ignores hints that other renderers need; this one bounds primitives itself.
void acceptHint(GraphicsState&, const Request&) {}

}  // namespace

std::optional<Basis> basisNamed(std::string_view name) {
  static const std::unordered_map<std::string_view, Basis (*)()> table = {{"bezier", bezierBasis},
                                                                          {"b-spline", bsplineBasis},
                                                                          {"catmull-rom", catmullRomBasis},
                                                                          {"hermite", hermiteBasis},
                                                                          {"power", powerBasis}};
  const auto it = table.find(name);
  return it == table.end() ? std::nullopt : std::optional(it->second());
}

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
