// RSL's optional parameter lists, such as trace(P, R, "samples", 16, "samplecone", 0.1): names and values, the same for
// all points (rispec-table 9.6, 10). Part of reyes/sl.h. A name that there is not is an exception, which the renderer
// reports with shader and object.
#pragma once
#include <algorithm>
#include <initializer_list>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "reyes/sl_values.h"

namespace sl {

/// A value of a list.
struct Setting {
  Setting(double v) : number(static_cast<float>(v)) {}
  Setting(const char* v) : type(TM_STRING), text(v) {}
  Setting(const rsl::UniformFloatParam& p) : number(uniform(p)) {}
  Setting(const rsl::Color& c) : type(TM_COLOR), color(c) {}
  Setting(const rsl::StringParam& p) : type(TM_STRING), text(uniform(p)) {}
  Setting(const Float& v) : varying{v.data()} {}
  Setting(const Triple& v) : type(TM_COLOR), varying{v.out().x, v.out().y, v.out().z} {}
  Setting(Float* out) : numbers(out) {}
  Setting(Triple* out) : triples(out) {}
  int whole() const { return static_cast<int>(number); }
  TmType type = TM_FLOAT;
  float number = 0;
  const char* text = "";
  rsl::Color color{};
  const float* varying[3] = {nullptr, nullptr, nullptr};  ///< Of LightList alone; null: the same for all.
  Float* numbers = nullptr;                               ///< To be filled in.
  Triple* triples = nullptr;                              ///< Likewise.
};

/// A name that other renderers know and that changes nothing here, which is reported once. `why`: no more is to be done
/// about it.
inline bool isIdle(std::string_view name, std::initializer_list<std::string_view> idle, const char* why) {
  if (std::find(idle.begin(), idle.end(), name) == idle.end()) return false;
  grid()->call->report(grid()->host, grid(), 1, ("\"" + std::string(name) + "\" has no effect: " + why).c_str());
  return true;
}

inline bool set(TmRayOptions& o, std::string_view name, const Setting& v) {
  const std::string_view text = v.text;
  if (name == "samples")
    o.samples = v.whole();
  else if (name == "samplecone" || name == "coneangle")
    o.coneAngle = v.number;
  else if (name == "distribution")
    o.uniform = text == "uniform";
  else if (name == "bias")
    o.bias = v.number;
  else if (name == "maxdist")
    o.maxDistance = v.number;
  else if (name == "samplebase")
    o.sampleBase = v.number;
  else if (name == "label")
    o.label = v.text;
  else if (name == "subset")
    o.subset = v.text;
  else if (name == "excludesubset")
    o.excludeSubset = v.text;
  else if (name == "hitsides")
    o.hitSides = text == "front" ? TM_HIT_FRONT : text == "back" ? TM_HIT_BACK : TM_HIT_BOTH;
  else if (name == "hitmode")
    o.hitMode = text == "primitive" ? TM_HIT_PRIMITIVE : text == "shader" ? TM_HIT_SHADER : TM_HIT_DEFAULT;
  else if (name == "othreshold")
    o.opacityThreshold = v.number;
  else if (name == "falloff")
    o.falloff = v.number;
  else if (name == "falloffmode")
    o.falloffMode = v.whole();
  else if (name == "maxvariation")
    o.maxVariation = v.number;
  else if (name == "weight")
    o.importance = v.number;
  else if (name == "environmentspace")
    o.environmentSpace = v.text;
  else
    return isIdle(name, {"minsamples", "raydepth"},
                  "all rays are shot that are asked for, and the renderer counts bounces");
  return true;
}

/// Of occlusion() and indirectdiffuse(): as rays, and a point cloud, an environment and what else is to be filled in.
struct HemisphereList {
  TmRayOptions rays = rsl::defaultRays();
  bool pointBased = false;
  const char* file = nullptr;
  Triple *environmentColor = nullptr, *environmentDirection = nullptr;
  Float* covered = nullptr;

  /// As TmServices wants them.
  TmRayOptions options(int samples) const {
    TmRayOptions o = rays;
    o.samples = samples, o.pointCloud = pointBased ? file : nullptr;
    return o;
  }
};
inline bool set(HemisphereList& o, std::string_view name, const Setting& v) {
  if (name == "pointbased")
    o.pointBased = v.number != 0;
  else if (name == "filename")
    o.file = v.text;
  else if (name == "channel")
    o.rays.pointChannel = v.text;
  else if (name == "clamp")
    o.rays.clamp = v.whole();
  else if (name == "maxsolidangle")
    o.rays.maxSolidAngle = v.number;
  else if (name == "environmentmap")
    o.rays.environment = *v.text ? v.text : nullptr;
  else if (name == "environmentcolor")
    o.environmentColor = v.triples;
  else if (name == "environmentdir")
    o.environmentDirection = v.triples;
  else if (name == "occlusion")
    o.covered = v.numbers;
  else
    return set(o.rays, name, v) ||
           isIdle(name, {"adaptive", "brightnesswarp", "sortbleeding", "rasterresolution"},
                  "all samples are taken, stratified, and what is nearer hides what is behind it");
  return true;
}

/// Of photonmap().
struct PhotonList {
  TmPhotonLookup photons = TM_PHOTON_DEFAULTS;
  bool radiance = false;  ///< Of baked "_radiosity", instead of irradiance.
};
inline bool set(PhotonList& o, std::string_view name, const Setting& v) {
  if (name == "estimator")
    o.photons.estimator = v.whole();
  else if (name == "maxdist")
    o.photons.maxDistance = v.number;
  else if (name == "lookuptype")
    o.radiance = std::string_view(v.text) == "radiance";
  else
    return false;
  return true;
}

/// Of bake3d() and texture3d(). A radius is in current space.
struct CloudList {
  TmCloudLookup cloud = TM_CLOUD_DEFAULTS;
  Float radius;
  bool hasRadius = false;

  TmCloudLookup options() const {
    TmCloudLookup o = cloud;
    if (hasRadius) o.radius = radius.data();
    return o;
  }
};
inline bool set(CloudList& o, std::string_view name, const Setting& v) {
  if (name == "coordsystem")
    o.cloud.coordSystem = v.text;
  else if (name == "radius" || name == "filterradius")
    o.radius = v.numbers ? *v.numbers : Float(double(v.number)), o.hasRadius = true;
  else if (name == "radiusscale" || name == "filterscale")
    o.cloud.radiusScale = v.number;
  else
    return isIdle(name, {"interpolate", "maxdepth", "lerp"},
                  "points are those that are shaded, and brick maps are read to their depth and blended");
  return true;
}

inline bool set(TmTextureLookup& o, std::string_view name, const Setting& v) {
  if (name == "blur")
    o.sblur = o.tblur = v.number;
  else if (name == "sblur")
    o.sblur = v.number;
  else if (name == "tblur")
    o.tblur = v.number;
  else if (name == "width")
    o.swidth = o.twidth = v.number;
  else if (name == "swidth")
    o.swidth = v.number;
  else if (name == "twidth")
    o.twidth = v.number;
  else if (name == "fill")
    o.fill = v.number;
  else if (name == "filter")
    o.filter = v.text;
  else if (name == "samples")
    o.samples = v.whole();
  else if (name == "mipbias")
    o.mipBias = v.number;
  else if (name == "ignoreabove")
    o.ignoreAbove = v.number;
  else if (name != "lerp")
    return false;  // levels are always blended
  return true;
}

inline bool set(TmShadowLookup& o, std::string_view name, const Setting& v) {
  if (name == "bias")
    o.bias = v.number;
  else if (name == "blur")
    o.blur = v.number;
  else if (name == "width")
    o.width = v.number;
  else if (name == "samples")
    o.samples = v.whole();
  else
    return false;
  return true;
}

inline bool set(TmSubsurface& o, std::string_view name, const Setting& v) {
  const auto setColor = [&](float(&to)[3]) {
    to[0] = v.color.x, to[1] = v.color.y, to[2] = v.color.z, o.material = nullptr;
  };
  if (name == "coordsystem")
    o.coordSystem = v.text;
  else if (name == "material")
    o.material = v.text;
  else if (name == "scattering")
    setColor(o.scattering);
  else if (name == "absorption")
    setColor(o.absorption);
  else if (name == "albedo")
    setColor(o.albedo);
  else if (name == "diffusemeanfreepath")
    setColor(o.meanFreePath);
  else if (name == "ior")
    o.ior = v.number;
  else if (name == "unitlength")
    o.unitLength = v.number;
  else if (name == "maxsolidangle")
    o.maxSolidAngle = v.number;
  else
    return false;
  return true;
}

/// Of illuminance(). Names are "lightcache" ("refresh": lights run again), "send:light:NAME" (the value of a parameter,
/// for lights that have one of that name) and "light:NAME" (to be filled in with what lights have, parameters and
/// outputs, at each sample).
struct LightList {
  /// Its own copy: the caller's variables may change before the last light has run.
  struct Sent {
    Sent(std::string_view parameter, const Setting& v)
        : name(parameter), text(v.text), type(v.type), step(v.varying[0] ? 1 : 0) {
      const float* const same[3] = {v.type == TM_COLOR ? &v.color.x : &v.number, &v.color.y, &v.color.z};
      for (int k = 0; k < (type == TM_COLOR ? 3 : 1); ++k) {
        const float* const from = step ? v.varying[k] : same[k];
        values[k].assign(from, from + (step ? grid()->padded : 1));
      }
    }
    std::string name, text;
    TmType type;
    int step;
    std::vector<float> values[3];
  };
  struct Wanted {
    std::string name;
    Float* number;
    Triple* triple;
  };
  bool refresh = false;
  std::vector<Sent> sent;
  std::vector<Wanted> wanted;

  /// As TmServices wants them; they point into this list.
  std::vector<TmMessage> messages() const {
    std::vector<TmMessage> out;
    for (const Sent& s : sent)
      out.push_back({s.name.c_str(),
                     s.type,
                     {{s.values[0].data(), s.values[1].data(), s.values[2].data()}, s.step, 1, s.text.c_str()}});
    return out;
  }
};
inline bool set(LightList& o, std::string_view name, const Setting& v) {
  constexpr std::string_view kSend = "send:light:", kTell = "light:";
  const std::string_view text = v.text;
  if (name == "lightcache" && (text == "refresh" || text == "reuse"))
    o.refresh = text == "refresh";
  else if (name.substr(0, kSend.size()) == kSend && !v.numbers && !v.triples)
    o.sent.emplace_back(name.substr(kSend.size()), v);
  else if (name.substr(0, kTell.size()) == kTell && (v.numbers || v.triples))
    o.wanted.push_back({std::string(name.substr(kTell.size())), v.numbers, v.triples});
  else
    return false;
  return true;
}

/// `options`, changed as a list says.
template <class Options>
Options listed(Options options) {
  return options;
}
template <class Options, class... More>
Options listed(Options options, const char* name, const Setting& value, const More&... more) {
  if (!std::is_same_v<Options, LightList> && value.varying[0])
    throw std::invalid_argument(std::string("has a parameter list with \"") + name +
                                "\" that differs from point to point, which it must not");
  if (!set(options, name, value))
    throw std::invalid_argument(std::string("has a parameter list with \"") + name + "\", which there is not");
  return listed(std::move(options), more...);
}

}  // namespace sl
