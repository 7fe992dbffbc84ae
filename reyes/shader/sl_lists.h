// RSL's optional parameter lists, such as trace(P, R, "samples", 16, "samplecone", 0.1), on values of a batch: lists.h
// has their names and meanings. Part of reyes/sl.h. An unknown name throws an exception, which the renderer reports
// with shader and object.
#pragma once
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "reyes/shader/lists.h"
#include "reyes/shader/sl_operators.h"

namespace sl {

/// A value in a parameter list.
struct Setting : rsl::Setting {
  Setting(double v) : rsl::Setting(static_cast<float>(v)) {}
  Setting(const char* v) : rsl::Setting(v) {}
  Setting(const rsl::UniformFloatParam& p) : rsl::Setting(uniform(p)) {}
  Setting(const rsl::Color& c) : rsl::Setting(c) {}
  Setting(const rsl::StringParam& p) : rsl::Setting(uniform(p)) {}
  Setting(const Float& v) { varying[0] = v.data(); }
  Setting(const Triple& v) : rsl::Setting(v, TM_COLOR, {}) {}
  Setting(Float* out) { fills = {out->data(), nullptr, nullptr}; }
  Setting(Triple* out) : rsl::Setting(rsl::Color()) { fills = out->out(); }
};

using rsl::HemisphereList;
using rsl::PhotonList;
struct CloudList : rsl::CloudList {
  Float same;  ///< The common radius of all points, as an array.
  TmCloudOptions options() const {
    TmCloudOptions o = cloud;
    if (hasRadius) o.radius = same.data();
    return o;
  }
};
inline rsl::Entry set(CloudList& o, std::string_view name, const Setting& v) {
  const rsl::Entry entry = set(static_cast<rsl::CloudList&>(o), name, v);
  o.same = Float(double(o.radius));
  return entry;
}
struct LightList : rsl::LightList {
  LightList() { padded = grid()->padded; }
};

/// Returns the options, changed by the list.
template <class Options>
Options listed(Options options) {
  return options;
}
template <class Options, class... More>
Options listed(Options options, const char* name, const Setting& value, const More&... more) {
  if (!std::is_same_v<Options, LightList> && value.varying[0])
    throw std::invalid_argument(std::string("has a parameter list with \"") + name +
                                "\" that differs from point to point, which it must not");
  const rsl::Entry entry = set(options, name, value);
  if (entry.idle)
    grid()->call->report(grid()->host, grid(), TM_WARNING,
                         (std::string("\"") + name + "\" has no effect: " + entry.idle).c_str());
  if (!entry.known)
    throw std::invalid_argument(std::string("has a parameter list with \"") + name + "\", which is unknown");
  return listed(std::move(options), more...);
}

}  // namespace sl
