// Transformations and named coordinate systems (RISpec 3.2 section 4.2.10). The CTM takes new transformations
// on its right: the last one in the file is the first to be applied to a point.
#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include "reyes/rib/handlers.h"

namespace tomales::rib {
namespace {

std::optional<mat4> rotation(const RibArg& a) {
  const vec3 axis = normalizeOr(asVec3(a, 1), vec3(0));
  if (axis == vec3(0)) return std::nullopt;
  return glm::rotate(mat4(1), glm::radians(a.numbers[0]), axis);
}

// The eye at the origin looks along +z: x = z tan(fov/2) becomes 1, and z = 1..infinity becomes 0..1.
std::optional<mat4> perspective(float fov_degrees) {
  if (!(fov_degrees > 0 && fov_degrees < 180)) return std::nullopt;
  const float t = std::tan(glm::radians(fov_degrees) / 2);
  return mat4(vec4(1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, t, t), vec4(0, 0, -t, 0));
}

// Shifts points along b so that a turns by `angle` towards b. Let theta be the angle between a and b, and n the unit
// vector in their plane that is perpendicular to b. Then a + k (n.a) b is at the angle theta - `angle` to b with
//   k = cot(theta - angle) - cot(theta).
std::optional<mat4> skew(const RibArg& r) {
  const vec3 a = normalizeOr(asVec3(r, 1), vec3(0)), b = normalizeOr(asVec3(r, 4), vec3(0));
  const vec3 n = normalizeOr(a - dot(a, b) * b, vec3(0));
  const float theta = std::acos(std::clamp(dot(a, b), -1.0f, 1.0f)), left = theta - glm::radians(r.numbers[0]);
  if (b == vec3(0) || n == vec3(0) || !(left > 0 && left < kPi)) return std::nullopt;
  const float k = 1 / std::tan(left) - 1 / std::tan(theta);
  mat4 m(1);
  for (int column = 0; column < 3; ++column) m[column] += vec4(k * n[column] * b, 0);
  return m;
}

std::optional<mat4> matrixOf(const Request& r) {
  if (r.name == "Identity") return mat4(1);
  const RibArg& a = r.args[0];
  if (r.name == "Translate") return glm::translate(mat4(1), asVec3(a));
  if (r.name == "Scale") return glm::scale(mat4(1), asVec3(a));
  if (r.name == "Rotate") return rotation(a);
  if (r.name == "Skew") return skew(a);
  if (r.name == "Perspective") return perspective(a.number());
  return asMatrix(a.numbers);
}

// Makes keys that rotate about one axis by the angles of Rotate, because matrices do not show whole turns.
Motion spun(const std::vector<const Request*>& keys, Motion motion) {
  constexpr float kMostPieces = 64;
  const auto axis = [&](size_t k) { return normalizeOr(asVec3(keys[k]->args[0], 1), vec3(0)); };
  for (size_t k = 0; k < keys.size(); ++k)
    if (keys[k]->name != "Rotate" || axis(k) != axis(0)) return motion;
  Motion out{{motion.times[0]}, {motion.keys[0]}};
  for (size_t k = 1; k < keys.size(); ++k) {
    const float from = keys[k - 1]->args[0].numbers[0], to = keys[k]->args[0].numbers[0];
    const float pieces =
        std::min(std::ceil(glm::radians(std::abs(to - from)) / Motion::kLargestTurn - 1e-3f), kMostPieces);
    for (float i = 1; i < pieces; ++i) {
      const float time = lerp(motion.times[k - 1], motion.times[k], i / pieces);
      if (!(time > out.times.back() && time < motion.times[k])) continue;
      out.times.push_back(time);
      out.keys.push_back(glm::rotate(mat4(1), glm::radians(lerp(from, to, i / pieces)), axis(0)));
    }
    out.times.push_back(motion.times[k]);
    out.keys.push_back(motion.keys[k]);
  }
  return out;
}

void coordSysTransform(GraphicsState& s, const Request& r) {
  const std::string& name = r.args[0].strings[0];
  for (const auto* systems : {&s.scope.coordinateSystems, &s.globals.coordinateSystems})
    if (const auto it = systems->find(name); it != systems->end()) {
      s.scope.ctm = it->second;
      return;
    }
  if (name == "world" && s.world)
    s.scope.ctm = Motion();
  else if (name == "camera")
    s.scope.ctm = s.world ? inverse(s.world->cameraFromWorld) : Motion();
  else
    s.warn(r, "rib-unknown-space", "no coordinate system is called \"" + name + "\"; ignored");
}

}  // namespace

mat4 asMatrix(const std::vector<float>& sixteen) {
  mat4 m;
  std::copy_n(sixteen.begin(), 16, &m[0][0]);
  return m;
}

bool isTransformation(std::string_view name) {
  static constexpr std::string_view kNames[] = {"Identity",  "Transform", "ConcatTransform", "Perspective",
                                                "Translate", "Rotate",    "Scale",           "Skew"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

void applyTransformation(GraphicsState& s, const std::vector<const Request*>& keys, const std::vector<float>& times) {
  Motion motion{times, {}};
  for (const Request* r : keys) {
    const std::optional<mat4> m = matrixOf(*r);
    if (!m) {
      s.warn(*r, "rib-transformation", "axes or angle make no transformation; ignored");
      return;
    }
    motion.keys.push_back(*m);
  }
  motion = spun(keys, std::move(motion));
  const bool replaces = keys[0]->name == "Identity" || keys[0]->name == "Transform";
  s.scope.ctm = (replaces ? s.identity : s.scope.ctm) * motion;
}

const HandlerTable& transformHandlers() {
  static const HandlerTable table = {
      {"CoordinateSystem",
       [](GraphicsState& s, const Request& r) { s.globals.coordinateSystems[r.args[0].strings[0]] = s.scope.ctm; }},
      {"ScopedCoordinateSystem",
       [](GraphicsState& s, const Request& r) {
         const std::string& name = r.args[0].strings[0];
         s.scope.coordinateSystems[name] = s.scope.ctm;
         // Shaders find it by name in the whole scene (see docs/rib_support.md).
         s.globals.coordinateSystems.try_emplace(name, s.scope.ctm);
       }},
      {"CoordSysTransform", coordSysTransform},
  };
  return table;
}

}  // namespace tomales::rib
