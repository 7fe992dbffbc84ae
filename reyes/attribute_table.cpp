#include "reyes/attribute_table.h"

#include <algorithm>
#include <unordered_map>

#include "reyes/base/deep_stack.h"

namespace tomales {
namespace {

Param numbersParam(std::vector<float> numbers, ValueType type = ValueType::Float) {
  Param out;
  out.type = type;
  out.floats = std::move(numbers);
  return out;
}
Param numberParam(float number) { return numbersParam({number}); }
Param numberParam(int number) { return numberParam(static_cast<float>(number)); }
Param numberParam(bool flag) { return numberParam(flag ? 1.0f : 0.0f); }
Param colorParam(const vec3& c) { return numbersParam({c.x, c.y, c.z}, ValueType::Color); }
Param stringParam(std::string text) { return wordParam("", std::move(text)); }

Param textureCoordinates(const Attributes& a) {
  std::vector<float> st;
  for (const vec2& c : a.textureCoordinates) {
    st.push_back(c.x);
    st.push_back(c.y);
  }
  return numbersParam(std::move(st));
}

template <bool Visibility::*kRays>
void setVisible(Attributes& a, const Param& p) {
  a.visibility.*kRays = p.number(1) != 0;
}
template <bool Visibility::*kRays>
Param isVisible(const Attributes& a) {
  return numberParam(a.visibility.*kRays);
}
/// "visibility:trace" until PRMan 12, "visibility:indirect" of the RIS era.
void setVisibleToRays(Attributes& a, const Param& p) {
  a.visibility.diffuse = a.visibility.specular = p.number(1) != 0;
}

/// The attribute of PRMan up to version 12: whether shadow rays see the object, and how they find its opacity.
void setTransmission(Attributes& a, const Param& p) {
  a.visibility.transmission = p.strings[0] != "transparent";
  a.transmissionHitMode = p.strings[0] == "shader" ? HitMode::Shader : HitMode::Primitive;
}

/// The attribute of BMRT: "none", "opaque", "Os" and "shade" (its User Guide, attribute "render" "casts_shadows").
void setCastsShadows(Attributes& a, const Param& p) {
  a.visibility.transmission = p.strings[0] != "none";
  a.transmissionHitMode = p.strings[0] == "shade" ? HitMode::Shader : HitMode::Primitive;
}

/// "cache" reads files that may be missing; the object's shader gives the same result.
template <HitMode Attributes::*kRays>
void setHitMode(Attributes& a, const Param& p) {
  a.*kRays = p.strings[0] == "primitive" ? HitMode::Primitive : HitMode::Shader;
}

void setDisplacementBound(Attributes& a, const Param& p) { a.displacementBound = std::max(0.0f, p.number(0)); }

void setTraceDisplacements(Attributes& a, const Param& p) {
  a.trace.displacements = p.number(0) != 0;
  a.trace.displacementsGiven = true;
}

int bounces(float number) { return static_cast<int>(std::clamp<float>(number, 0, kMostBounces)); }

void setTessellationMode(Attributes& a, const Param& p) {
  const std::string& mode = p.strings[0];
  a.trace.rate = mode == "full"              ? TessellationMode::Full
                 : mode == "multiresolution" ? TessellationMode::Multiresolution
                                             : TessellationMode::Fixed;
}

/// "a,b" replaces the sets, "+a,b" joins sets and "-a,b" leaves them.
void editMembership(Attributes& a, const Param& p) {
  std::string_view text = p.strings[0];
  const bool joins = text.starts_with('+'), leaves = text.starts_with('-');
  if (joins || leaves)
    text.remove_prefix(1);
  else
    a.membership.clear();
  while (!text.empty()) {
    const size_t end = std::min(text.find_first_of(", "), text.size());
    if (end > 0 && leaves) a.membership.erase(std::string(text.substr(0, end)));
    if (end > 0 && !leaves) a.membership.emplace(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

void setBleedingColor(Attributes& a, const Param& p) {
  a.indirect.bleedingColor = p.floats.size() == 3 ? vec3(p.floats[0], p.floats[1], p.floats[2]) : vec3(1);
}

const std::vector<NamedAttribute>& rows() {
  using A = Attributes;
  using V = Visibility;
  static const std::vector<NamedAttribute> table = {
      // Requests
      {.name = "ShadingRate", .get = [](const A& a) { return numberParam(a.shadingRate); }},
      {.name = "Matte", .get = [](const A& a) { return numberParam(a.matte); }},
      {.name = "Sides", .get = [](const A& a) { return numberParam(a.sides); }},
      {.name = "Color", .get = [](const A& a) { return colorParam(a.color); }},
      {.name = "Opacity", .get = [](const A& a) { return colorParam(a.opacity); }},
      {.name = "Orientation", .get = [](const A& a) { return stringParam(a.insideOut ? "inside" : "outside"); }},
      {.name = "ShadingInterpolation",
       .get =
           [](const A& a) {
             return stringParam(a.interpolation == ShadingInterpolation::Smooth ? "smooth" : "constant");
           }},
      {.name = "DetailRange",
       .get =
           [](const A& a) {
             return numbersParam({a.detail.lo, a.detail.hi});
           }},
      {.name = "TextureCoordinates", .get = textureCoordinates},

      // Attribute
      {.name = "identifier:name",
       .type = "string",
       .setStrings = [](A& a, const Param& p) { a.name = p.strings[0]; },
       .get = [](const A& a) { return stringParam(a.name); }},
      {.name = "displacementbound:sphere",
       .type = "float",
       .setNumbers = setDisplacementBound,
       .get = [](const A& a) { return numberParam(a.displacementBound); }},
      {.name = "bound:displacement", .type = "float", .setNumbers = setDisplacementBound},  // until PRMan 3.8
      {.name = "displacementbound:coordinatesystem",
       .type = "string",
       .setStrings = [](A& a, const Param& p) { a.displacementBoundSpace = p.strings[0]; }},
      {.name = "visibility:camera", .type = "int", .setNumbers = setVisible<&V::camera>, .get = isVisible<&V::camera>},
      {.name = "visibility:diffuse",
       .type = "int",
       .setNumbers = setVisible<&V::diffuse>,
       .get = isVisible<&V::diffuse>},
      {.name = "visibility:specular",
       .type = "int",
       .setNumbers = setVisible<&V::specular>,
       .get = isVisible<&V::specular>},
      {.name = "visibility:transmission",
       .type = "int",
       .setNumbers = setVisible<&V::transmission>,
       .setStrings = setTransmission,
       .get = isVisible<&V::transmission>},
      {.name = "visibility:photon", .type = "int", .setNumbers = setVisible<&V::photon>, .get = isVisible<&V::photon>},
      {.name = "visibility:trace", .type = "int", .setNumbers = setVisibleToRays},
      {.name = "visibility:indirect", .type = "int", .setNumbers = setVisibleToRays},
      {.name = "render:casts_shadows", .type = "string", .setStrings = setCastsShadows},
      {.name = "trace:bias",
       .type = "float",
       .setNumbers = [](A& a, const Param& p) { a.trace.bias = p.number(0); },
       .get = [](const A& a) { return numberParam(a.trace.bias.value_or(0)); }},
      {.name = "trace:offset",
       .type = "float",
       .setNumbers = [](A& a, const Param& p) { a.trace.offset = p.number(0); }},
      {.name = "trace:displacements", .type = "int", .setNumbers = setTraceDisplacements},
      {.name = "trace:samplemotion",
       .type = "int",
       .setNumbers = [](A& a, const Param& p) { a.trace.sampleMotion = p.number(0) != 0; }},
      {.name = "trace:maxdiffusedepth",
       .type = "int",
       .setNumbers = [](A& a, const Param& p) { a.trace.maxDiffuseDepth = bounces(p.number(1)); },
       .get = [](const A& a) { return numberParam(a.trace.maxDiffuseDepth); }},
      {.name = "trace:maxspeculardepth",
       .type = "int",
       .setNumbers = [](A& a, const Param& p) { a.trace.maxSpecularDepth = bounces(p.number(2)); },
       .get = [](const A& a) { return numberParam(a.trace.maxSpecularDepth); }},
      {.name = "trace:tessellation",
       .type = "float",
       .setNumbers = [](A& a, const Param& p) { a.trace.tessellation = p.number(1); }},
      {.name = "trace:tessellationmode",
       .type = "string",
       .setStrings = setTessellationMode,
       .words = {"fixed", "multiresolution", "full"}},
      {.name = "grouping:membership", .type = "string", .setStrings = editMembership},
      {.name = "grouping:tracesubset",
       .type = "string",
       .setStrings = [](A& a, const Param& p) { a.trace.subset = p.strings[0]; }},
      {.name = "shade:diffusehitmode",
       .type = "string",
       .setStrings = setHitMode<&A::diffuseHitMode>,
       .words = {"shader", "primitive", "cache"}},
      {.name = "shade:specularhitmode",
       .type = "string",
       .setStrings = setHitMode<&A::specularHitMode>,
       .words = {"shader", "primitive", "cache"}},
      {.name = "shade:transmissionhitmode",
       .type = "string",
       .setStrings = setHitMode<&A::transmissionHitMode>,
       .words = {"shader", "primitive", "cache"}},
      {.name = "photon:globalmap",
       .type = "string",
       .setStrings = [](A& a, const Param& p) { a.photon.globalMap = p.strings[0]; },
       .get = [](const A& a) { return stringParam(a.photon.globalMap); }},
      {.name = "photon:causticmap",
       .type = "string",
       .setStrings = [](A& a, const Param& p) { a.photon.causticMap = p.strings[0]; },
       .get = [](const A& a) { return stringParam(a.photon.causticMap); }},
      {.name = "photon:shadingmodel",
       .type = "string",
       .setStrings = [](A& a, const Param& p) { a.photon.shadingModel = p.strings[0]; }},
      {.name = "indirect:receive",
       .type = "int",
       .setNumbers = [](A& a, const Param& p) { a.indirect.receive = p.number(1) != 0; }},
      {.name = "indirect:gain",
       .type = "float",
       .setNumbers = [](A& a, const Param& p) { a.indirect.gain = p.number(1); }},
      {.name = "indirect:bleeding",
       .type = "float",
       .setNumbers = [](A& a, const Param& p) { a.indirect.bleeding = p.number(1); }},
      {.name = "indirect:bleedingcolor", .type = "color", .setNumbers = setBleedingColor},
      {.name = "indirect:surface",
       .type = "string",
       .setStrings = [](A& a, const Param& p) { a.indirect.surface = p.strings[0]; }},
      {.name = "radiosity:screentexels",
       .type = "float",
       .setNumbers =
           [](A& a, const Param& p) {
             a.radiosity = {true, p.number(0)};
           }},
      {.name = "radiosity:worldtexels",
       .type = "float",
       .setNumbers =
           [](A& a, const Param& p) {
             a.radiosity = {false, p.number(0)};
           }},
      {.name = "irradiance:maxerror",
       .type = "float",
       .setNumbers = [](A& a, const Param& p) { a.irradianceMaxError = p.number(0); }},
      {.name = "irradiance:maxpixeldist",
       .type = "float",
       .setNumbers = [](A& a, const Param& p) { a.irradianceMaxPixelDist = p.number(0); }},
      {.name = "cull:hidden",
       .type = "int",
       .setNumbers = [](A& a, const Param& p) { a.cull.hidden = p.number(1) != 0; }},
      {.name = "cull:backfacing",
       .type = "int",
       .setNumbers = [](A& a, const Param& p) { a.cull.backfacing = p.number(1) != 0; }},
      {.name = "dice:binary",
       .type = "int",
       .setNumbers = [](A& a, const Param& p) { a.binaryDice = p.number(0) != 0; }},
      {.name = "dice:rasterorient",
       .type = "int",
       .setNumbers = [](A& a, const Param& p) { a.rasterOrient = p.number(1) != 0; }},

      // State of the reader of RIB, not of objects (reyes/rib/build_attributes.cpp)
      {.name = "trimcurve:sense", .type = "string"},
      {.name = "shade:relativeshadingrate", .type = "float"},
      {.name = "shade:resetrelativeshadingrate", .type = "float"},
      {.name = "dice:roundcurve", .type = "int"},
      {.name = "light:shadows", .type = "string"},

      // Kept as they are given; all but the first have no effect.
      {.name = "identifier:shadinggroup", .type = "string"},
      {.name = "visibility:midpoint", .type = "int"},
      {.name = "dice:strategy", .type = "string"},
      {.name = "dice:hair", .type = "int"},
      {.name = "shade:strategy", .type = "string"},
      {.name = "shade:camerahitmode", .type = "string"},
      {.name = "derivatives:centered", .type = "int"},
      {.name = "derivatives:extrapolate", .type = "int"},
      {.name = "photon:estimator", .type = "int"},
      {.name = "irradiance:nsamples", .type = "int"},
      {.name = "irradiance:shadingrate", .type = "float"},
      {.name = "stitch:enable", .type = "int"},
      {.name = "sides:doubleshaded", .type = "int"},
  };
  return table;
}

}  // namespace

std::span<const NamedAttribute> namedAttributes() { return rows(); }

const NamedAttribute* findNamedAttribute(std::string_view name) {
  static const auto index = [] {
    std::unordered_map<std::string_view, const NamedAttribute*> out;
    for (const NamedAttribute& row : rows()) out.emplace(row.name, &row);
    return out;
  }();
  const auto it = index.find(name);
  return it == index.end() ? nullptr : it->second;
}

}  // namespace tomales
