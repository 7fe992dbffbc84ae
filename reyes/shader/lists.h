// The names of RSL's optional parameter lists, such as trace(P, R, "samples", 16, "samplecone", 0.1), and what they set
// (RISpec 15.6, 15.7, and what PRMan added): one table for reyes/sl.h and for compiled shaders. It is installed beside
// reyes/shader.h; header only.
#pragma once
#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "reyes/shader/math.h"
#include "reyes/shader/options.h"

namespace rsl {

/// A value in a parameter list. It records whether its reader asked for another type, or for one number where points
/// differ.
class Setting {
 public:
  Setting() = default;
  explicit Setting(float v) : number_(v) {}
  explicit Setting(const char* v) : type(TM_STRING), text_(v) {}
  explicit Setting(Color v, TmType t = TM_COLOR) : type(t), color_(v) {}
  /// A value for each point. Readers that want one value for all get `first`, the value of a shaded point.
  Setting(TmConstVec3 all, TmType t, Color first)
      : type(t), varying{all.x, all.y, all.z}, number_(first.x), color_(first) {}

  float number() const {
    wanted(TM_FLOAT);
    return number_;
  }
  /// Returns 0 for a number that does not fit an int.
  int whole() const {
    const float x = number();
    return x > -1e9f && x < 1e9f ? static_cast<int>(x) : 0;
  }
  const char* text() const {
    wanted(TM_STRING);
    return text_;
  }
  /// A number stands for all three components.
  Color color() const {
    if (isNumber()) return {number(), number(), number()};
    wanted(type);
    return color_;
  }

  bool isNumber() const { return type == TM_FLOAT; }
  bool isText() const { return type == TM_STRING; }
  bool isFilled() const { return fills.x || target >= 0; }
  /// Returns the values of the points; null if they all have the same.
  const float* each() const { return varying[0]; }

  TmType type = TM_FLOAT;
  const float* varying[3] = {nullptr, nullptr, nullptr};
  TmVec3 fills{};       ///< The arrays to fill: x alone for a number, otherwise all three; null x if there are none.
  int32_t target = -1;  ///< The caller's own number for the variable that the service fills, or -1.
  mutable bool fits = true;        ///< False once a reader has asked for another type.
  mutable bool tookFirst = false;  ///< True once a reader has asked for one value although the points' values differ.

 private:
  void wanted(TmType as) const {
    fits = fits && as == type;
    tookFirst = tookFirst || varying[0];
  }
  float number_ = 0;
  const char* text_ = "";
  Color color_{};
};

/// The result of set() for an entry of a list.
struct Entry {
  bool known = true;
  const char* idle = nullptr;  ///< Why the entry, which other renderers know, changes nothing here. Null otherwise.
};
inline Entry idleOr(std::string_view name, std::initializer_list<std::string_view> idle, const char* why) {
  const bool known = std::find(idle.begin(), idle.end(), name) != idle.end();
  return {known, known ? why : nullptr};
}

inline Entry set(TmRayOptions& o, std::string_view name, const Setting& v) {
  if (name == "samples")
    o.samples = v.whole();
  else if (name == "samplecone" || name == "coneangle")
    o.coneAngle = v.number();
  else if (name == "distribution")
    o.uniform = std::string_view(v.text()) == "uniform";
  else if (name == "bias")
    o.bias = v.number();
  else if (name == "maxdist")
    o.maxDistance = v.number();
  else if (name == "samplebase")
    o.sampleBase = v.number();
  else if (name == "label")
    o.label = v.text();
  else if (name == "subset")
    o.subset = v.text();
  else if (name == "excludesubset")
    o.excludeSubset = v.text();
  else if (name == "hitsides") {
    const std::string_view text = v.text();
    o.hitSides = text == "front" ? TM_HIT_FRONT : text == "back" ? TM_HIT_BACK : TM_HIT_BOTH;
  } else if (name == "hitmode") {
    const std::string_view text = v.text();
    o.hitMode = text == "primitive" ? TM_HIT_PRIMITIVE : text == "shader" ? TM_HIT_SHADER : TM_HIT_DEFAULT;
  } else if (name == "othreshold")
    o.opacityThreshold = v.isNumber() ? v.number() : std::max({v.color().x, v.color().y, v.color().z});
  else if (name == "weight")
    o.importance = v.number();
  else if (name == "environmentspace")
    o.environmentSpace = v.text();
  else
    return idleOr(name, {"minsamples", "raydepth"},
                  "all rays are shot that are asked for, and the renderer counts bounces");
  return {};
}

/// Returns options whose accuracy the scene decides, as RSL has it.
inline TmOcclusion interpolatedWhereAllowed() {
  TmOcclusion o = tmOcclusionDefaults();
  o.maxVariation = -1;
  return o;
}
/// The list of occlusion() and indirectdiffuse(): options of rays, a point cloud, an environment and variables to fill.
struct HemisphereList {
  TmRayOptions rays = tmRayDefaults();
  TmOcclusion options = interpolatedWhereAllowed();
  bool pointBased = false;
  const char* file = nullptr;
};
inline Entry set(HemisphereList& o, std::string_view name, const Setting& v) {
  if (name == "pointbased")
    o.pointBased = v.number() != 0;
  else if (name == "filename")
    o.file = v.text();
  else if (name == "channel")
    o.options.pointChannel = v.text();
  else if (name == "clamp")
    o.options.clamp = v.whole();
  else if (name == "maxsolidangle")
    o.options.maxSolidAngle = v.number();
  else if (name == "falloff")
    o.options.falloff = v.number();
  else if (name == "falloffmode")
    o.options.falloffMode = v.whole();
  else if (name == "maxvariation")
    o.options.maxVariation = v.number();
  else if (name == "environmentmap")
    o.rays.environment = *v.text() ? v.text() : nullptr;
  else if (name == "environmentcolor" && v.fills.y)
    o.options.environmentColor = v.fills;
  else if (name == "environmentdir" && v.fills.y)
    o.options.environmentDirection = v.fills;
  else if (name == "occlusion" && v.fills.x && !v.fills.y)
    o.options.covered = v.fills.x;
  else if (const Entry rays = set(o.rays, name, v); rays.known)
    return rays;
  else
    return idleOr(name, {"adaptive", "brightnesswarp", "sortbleeding", "rasterresolution"},
                  "all samples are taken, stratified, and what is nearer hides what is behind it");
  return {};
}

/// The list of photonmap().
struct PhotonList {
  TmPhotonOptions photons = tmPhotonDefaults();
  bool radiance = false;  ///< True if radiance is wanted, from baked "_radiosity", instead of irradiance.
};
inline Entry set(PhotonList& o, std::string_view name, const Setting& v) {
  if (name == "estimator")
    o.photons.estimator = v.whole();
  else if (name == "maxdist")
    o.photons.maxDistance = v.number();
  else if (name == "lookuptype")
    o.radiance = std::string_view(v.text()) == "radiance";
  else
    return {false};
  return {};
}

/// The list of bake3d() and texture3d(). Radii are in current space.
struct CloudList {
  TmCloudOptions cloud = tmCloudDefaults();
  float radius = 0;
  bool hasRadius = false;  ///< True if one radius was given for all points, from which the caller makes cloud.radius.
};
inline Entry set(CloudList& o, std::string_view name, const Setting& v) {
  if (name == "coordsystem")
    o.cloud.coordSystem = v.text();
  else if (name == "radius" || name == "filterradius") {
    const bool own = v.isNumber() && (v.fills.x || v.each());
    o.cloud.radius = own ? (v.fills.x ? v.fills.x : v.each()) : nullptr;
    o.hasRadius = !own;
    if (!own) o.radius = v.number();
  } else if (name == "radiusscale" || name == "filterscale")
    o.cloud.radiusScale = v.number();
  else
    return idleOr(name, {"interpolate", "maxdepth", "lerp"},
                  "points are those that are shaded, and brick maps are read to their depth and blended");
  return {};
}

inline Entry set(TmTextureOptions& o, std::string_view name, const Setting& v) {
  if (name == "blur")
    o.sblur = o.tblur = v.number();
  else if (name == "sblur")
    o.sblur = v.number();
  else if (name == "tblur")
    o.tblur = v.number();
  else if (name == "width")
    o.swidth = o.twidth = v.number();
  else if (name == "swidth")
    o.swidth = v.number();
  else if (name == "twidth")
    o.twidth = v.number();
  else if (name == "fill")
    o.fill = v.number();
  else if (name == "filter")
    o.filter = v.text();
  else if (name == "samples")
    o.samples = v.whole();
  else if (name == "mipbias")
    o.mipBias = v.number();
  else if (name == "ignoreabove")
    o.ignoreAbove = v.number();
  else
    return {name == "lerp"};  // levels are always blended
  return {};
}

inline Entry set(TmShadowOptions& o, std::string_view name, const Setting& v) {
  if (name == "bias")
    o.bias = v.number();
  else if (name == "blur")
    o.blur = v.number();
  else if (name == "width")
    o.width = v.number();
  else if (name == "samples")
    o.samples = v.whole();
  else
    return {false};
  return {};
}

inline Entry set(TmSubsurfaceOptions& o, std::string_view name, const Setting& v) {
  const auto setColor = [&](float(&to)[3]) {
    const Color c = v.color();
    to[0] = c.x;
    to[1] = c.y;
    to[2] = c.z;
    o.material = nullptr;
  };
  if (name == "coordsystem")
    o.coordSystem = v.text();
  else if (name == "material")
    o.material = v.text();
  else if (name == "scattering")
    setColor(o.scattering);
  else if (name == "absorption")
    setColor(o.absorption);
  else if (name == "albedo")
    setColor(o.albedo);
  else if (name == "diffusemeanfreepath")
    setColor(o.meanFreePath);
  else if (name == "ior")
    o.ior = v.number();
  else if (name == "unitlength")
    o.unitLength = v.number();
  else if (name == "maxsolidangle")
    o.maxSolidAngle = v.number();
  else
    return {false};
  return {};
}

/// The list of illuminance(). "lightcache" "refresh" makes lights run again. "send:light:NAME" sets the parameter NAME
/// of lights that have one. "light:NAME" names a variable that each sample fills with a parameter or output of its
/// light.
struct LightList {
  /// A value to send. It is a copy, since the caller's variables may change before the last light has run.
  struct Sent {
    Sent(std::string_view parameter, const Setting& v, int padded)
        : name(parameter), text(v.isText() ? v.text() : ""), type(v.type), step(v.each() ? 1 : 0) {
      const Color same = v.isText() ? Color{} : v.color();
      const float* const one[3] = {&same.x, &same.y, &same.z};
      for (int k = 0; k < (v.isNumber() || v.isText() ? 1 : 3); ++k) {
        const float* const from = step ? v.varying[k] : one[k];
        values[k].assign(from, from + (step ? padded : 1));
      }
    }
    std::string name, text;
    TmType type;
    int step;
    std::vector<float> values[3];
  };
  struct Wanted {
    std::string name;
    Setting into;
  };
  int padded = 0;  ///< The length of the batch's arrays, in floats.
  bool refresh = false;
  std::vector<Sent> sent;
  std::vector<Wanted> wanted;

  /// Returns the messages in the form that TmServices takes. They point into this list.
  std::vector<TmMessage> messages() const {
    std::vector<TmMessage> out;
    for (const Sent& s : sent)
      out.push_back({s.name.c_str(),
                     {{s.values[0].data(), s.values[1].data(), s.values[2].data()}, s.step, 1, s.text.c_str()},
                     s.type});
    return out;
  }
};
inline Entry set(LightList& o, std::string_view name, const Setting& v) {
  constexpr std::string_view kSend = "send:light:", kTell = "light:";
  if (name == "lightcache" && v.isText()) {
    const std::string_view text = v.text();
    o.refresh = text == "refresh";
    return {text == "refresh" || text == "reuse"};
  }
  if (name.substr(0, kSend.size()) == kSend && !v.isFilled())
    o.sent.emplace_back(name.substr(kSend.size()), v, o.padded);
  else if (name.substr(0, kTell.size()) == kTell && v.isFilled())
    o.wanted.push_back({std::string(name.substr(kTell.size())), v});
  else
    return {false};
  return {};
}

}  // namespace rsl
