// Private to the translations of RIS requests: functions that they share.
#pragma once
#include "reyes/rib/arguments.h"
#include "reyes/rib/ris.h"

namespace tomales::rib {

inline Param param(const std::string& name, ValueType type, std::vector<float> floats) {
  Param p;
  p.name = name;
  p.type = type;
  p.floats = std::move(floats);
  return p;
}
inline Param param(const std::string& name, const std::string& value) {
  Param p;
  p.name = name;
  p.type = ValueType::String;
  p.strings = {value};
  return p;
}

inline float number(const Request& r, const char* name, float fallback) {
  const Param* p = findParam(r.params, name);
  return p ? p->number(fallback) : fallback;
}
inline std::vector<float> color(const Request& r, const char* name, float grey) {
  const Param* p = findParam(r.params, name);
  return p && p->floats.size() == 3 ? p->floats : std::vector<float>(3, grey);
}
/// Collects requests that have the place of `from`.
class Script {
 public:
  explicit Script(const Request& from) : from_(from) {}
  Script& say(const char* name, std::vector<RibArg> args = {}, ParamList params = {}) {
    list_.push_back({name, std::move(args), std::move(params), from_.where});
    return *this;
  }
  std::vector<Request> list() { return std::move(list_); }

 private:
  const Request& from_;
  std::vector<Request> list_;
};

/// Makes a note about a plug-in: `what` ends the sentence that begins with its request and name.
Note note(const Request& request, const std::string& what, Severity severity = Severity::Warning);
Note standsIn(const Request& request, const std::string& substitute, Severity severity = Severity::Warning);

Translation risBxdf(const Request& request, const RisState& state);
Translation risLight(const Request& request);
/// Translate AreaLightSource of PRMan 19 and 20, and Geometry "envsphere", which makes one a sky.
Translation stdLight(const Request& request, RisState& state);
Translation envSphere(const Request& request, const RisState& state);
/// Translates Option and Attribute "Ri".
Translation riValues(const Request& request);
/// Translates PxrEnvDayLight.
Translation dayLight(const Request& request);
/// Returns "intensity" and "lightcolor" of any light.
ParamList emission(const Request& request);

}  // namespace tomales::rib
