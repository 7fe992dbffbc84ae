// PxrEnvDayLight: computes the position of the sun, and makes one light for the sun and one for the sky.
#include <cmath>

#include "reyes/rib/ris_parts.h"

namespace tomales::rib {
namespace {

/// Returns the day of the year, without a leap day, which would move the sun by a quarter of a degree at most.
float dayOfYear(float month, float day) {
  static constexpr int kBefore[] = {0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334};
  return static_cast<float>(kBefore[static_cast<int>(std::clamp(month, 1.0f, 12.0f)) - 1]) + day;
}

/// Returns a unit vector, x east, y up, z north (Preetham, Shirley and Smits 1999, appendix 6).
vec3 sunAt(float day, float hour, float zone, float latitude_degrees, float longitude_degrees) {
  const float equationOfTime_h =
      0.170f * std::sin(4 * kPi * (day - 80) / 373) - 0.129f * std::sin(2 * kPi * (day - 8) / 355);
  const float solar_h = hour + equationOfTime_h + (longitude_degrees - 15 * zone) / 15;
  const float declination = 0.4093f * std::sin(2 * kPi * (day - 81) / 368), latitude = glm::radians(latitude_degrees);
  const float turn = kPi * (solar_h - 12) / 12;
  return {-std::cos(declination) * std::sin(turn),
          std::sin(latitude) * std::sin(declination) + std::cos(latitude) * std::cos(declination) * std::cos(turn),
          std::cos(latitude) * std::sin(declination) - std::sin(latitude) * std::cos(declination) * std::cos(turn)};
}

/// Returns the direction to the sun in the light's space: y up, x east, z north.
vec3 sunDirection(const Request& r) {
  const float month = number(r, "month", 0);
  if (month >= 1)  // the defaults are PRMan's, a November afternoon in Seattle
    return sunAt(dayOfYear(month, number(r, "day", 20)), number(r, "hour", 14.633333f), number(r, "zone", -8),
                 number(r, "latitude", 47.602f), number(r, "longitude", -122.332f));
  for (const char* name : {"sunDirection", "direction"})
    if (const Param* p = findParam(r.params, name); p && p->floats.size() == 3)
      return {p->floats[0], p->floats[1], p->floats[2]};
  return {0, 0, 1};
}

}  // namespace

Translation dayLight(const Request& r) {
  const vec3 sun = sunDirection(r);
  const auto say = [&](Script& script, const char* shader, const std::string& handle, const char* tint,
                       ParamList more) {
    ParamList params = emission(r);
    if (findParam(r.params, tint)) params[1] = param("lightcolor", ValueType::Color, color(r, tint, 1));
    params.push_back(param("sundirection", ValueType::Vector, {sun.x, sun.y, sun.z}));
    params.push_back(param("turbidity", ValueType::Float, {number(r, "haziness", 2)}));
    params.insert(params.end(), more.begin(), more.end());
    script.say("LightSource", {string(shader), string(handle)}, params);
  };
  const std::string& handle = r.args[1].strings[0];
  Script script(r);
  say(script, "sunlight", handle + " sun", "sunTint", {param("sunsize", ValueType::Float, {number(r, "sunSize", 1)})});
  say(script, "daylight", handle, "skyTint", {});
  std::vector<Note> notes{standsIn(r, "daylight, with sunlight,")};
  if (!(sun.y > 0))
    notes.push_back(
        {"night " + handle, "Light \"PxrEnvDayLight\": its sun is not above the horizon: it is dark", r.where});
  return {script.list(), notes};
}

}  // namespace tomales::rib
