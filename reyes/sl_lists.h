// RSL's optional parameter lists, such as trace(P, R, "samples", 16, "samplecone", 0.1): names and values, the same for all points
// (rispec-table 9.6, 10). Part of reyes/sl.h. A name that there is not is an exception, which the renderer reports with shader and object.
#pragma once
#include <stdexcept>

#include "reyes/sl_values.h"

namespace sl {

/// A value of a list.
struct Setting {
  Setting(double v) : number(static_cast<float>(v)) {}
  Setting(const char* v) : text(v) {}
  Setting(const rsl::UniformFloatParam& p) : number(uniform(p)) {}
  Setting(const rsl::Color& c) : color(c) {}
  Setting(const rsl::StringParam& p) : text(uniform(p)) {}
  int whole() const { return static_cast<int>(number); }
  float number = 0;
  const char* text = "";
  rsl::Color color{};
};

inline bool set(TmRayOptions& o, std::string_view name, const Setting& v) {
  const std::string_view text = v.text;
  if (name == "samples") o.samples = v.whole();
  else if (name == "samplecone" || name == "coneangle") o.coneAngle = v.number;
  else if (name == "distribution") o.uniform = text == "uniform";
  else if (name == "bias") o.bias = v.number;
  else if (name == "maxdist") o.maxDistance = v.number;
  else if (name == "samplebase") o.sampleBase = v.number;
  else if (name == "label") o.label = v.text;
  else if (name == "subset") o.subset = v.text;
  else if (name == "excludesubset") o.excludeSubset = v.text;
  else if (name == "hitsides") o.hitSides = text == "front" ? TM_HIT_FRONT : text == "back" ? TM_HIT_BACK : TM_HIT_BOTH;
  else if (name == "hitmode") o.hitMode = text == "primitive" ? TM_HIT_PRIMITIVE : text == "shader" ? TM_HIT_SHADER : TM_HIT_DEFAULT;
  else if (name == "othreshold") o.opacityThreshold = v.number;
  else if (name == "falloff") o.falloff = v.number;
  else if (name == "falloffmode") o.falloffMode = v.whole();
  else if (name == "maxvariation") o.maxVariation = v.number;
  else return false;
  return true;
}

inline bool set(TmTextureLookup& o, std::string_view name, const Setting& v) {
  if (name == "blur") o.sblur = o.tblur = v.number;
  else if (name == "sblur") o.sblur = v.number;
  else if (name == "tblur") o.tblur = v.number;
  else if (name == "width") o.swidth = o.twidth = v.number;
  else if (name == "swidth") o.swidth = v.number;
  else if (name == "twidth") o.twidth = v.number;
  else if (name == "fill") o.fill = v.number;
  else if (name == "filter") o.filter = v.text;
  else if (name == "samples") o.samples = v.whole();
  else if (name != "lerp") return false;  // levels are always blended
  return true;
}

inline bool set(TmShadowLookup& o, std::string_view name, const Setting& v) {
  if (name == "bias") o.bias = v.number;
  else if (name == "blur") o.blur = v.number;
  else if (name == "width") o.width = v.number;
  else if (name == "samples") o.samples = v.whole();
  else return false;
  return true;
}

inline bool set(TmSubsurface& o, std::string_view name, const Setting& v) {
  const auto setColor = [&](float (&to)[3]) { to[0] = v.color.x, to[1] = v.color.y, to[2] = v.color.z, o.material = nullptr; };
  if (name == "coordsystem") o.coordSystem = v.text;
  else if (name == "material") o.material = v.text;
  else if (name == "scattering") setColor(o.scattering);
  else if (name == "absorption") setColor(o.absorption);
  else if (name == "albedo") setColor(o.albedo);
  else if (name == "diffusemeanfreepath") setColor(o.meanFreePath);
  else if (name == "ior") o.ior = v.number;
  else if (name == "unitlength") o.unitLength = v.number;
  else if (name == "maxsolidangle") o.maxSolidAngle = v.number;
  else return false;
  return true;
}

/// `options`, changed as a list says.
template <class Options>
Options listed(Options options) { return options; }
template <class Options, class... More>
Options listed(Options options, const char* name, const Setting& value, const More&... more) {
  if (!set(options, name, value)) throw std::invalid_argument(std::string("has a parameter list with \"") + name + "\", which there is not");
  return listed(options, more...);
}

}  // namespace sl
