#include "reyes/state.h"

#include <glm/gtc/quaternion.hpp>

namespace tomales {
namespace {

/// A transformation as move * turn * stretch (polar decomposition, Shoemake and Duff 1992).
struct Parts {
  vec3 move;
  glm::quat turn;
  mat3 stretch;
};

/// Returns the nearest orthogonal matrix, by Newton's iteration (Higham 1986).
mat3 nearestRotation(const mat3& m) {
  constexpr int kMostSteps = 32;
  mat3 r = m;
  for (int step = 0; step < kMostSteps; ++step) {
    const mat3 next = 0.5f * (r + glm::inverse(glm::transpose(r)));
    float change = 0;
    for (int c = 0; c < 3; ++c) change = std::max(change, glm::length(next[c] - r[c]));
    r = next;
    if (change < 1e-6f) break;
  }
  return r;
}

bool affineAndRegular(const mat4& m) {
  const float size = glm::length(vec3(m[0])) * glm::length(vec3(m[1])) * glm::length(vec3(m[2]));
  return m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1 &&
         std::abs(glm::determinant(mat3(m))) > 1e-6f * size;
}

/// Tells whether the motion from a to b can be a rotation. It cannot if only the position differs, nor through a
/// mirror.
bool mayTurn(const mat4& a, const mat4& b) {
  return mat3(a) != mat3(b) && affineAndRegular(a) && affineAndRegular(b) &&
         (glm::determinant(mat3(a)) > 0) == (glm::determinant(mat3(b)) > 0);
}

Parts apart(const mat4& m) {
  const mat3 orthogonal = nearestRotation(mat3(m));
  const mat3 rotation = glm::determinant(orthogonal) < 0 ? -1.0f * orthogonal : orthogonal;
  return {vec3(m[3]), glm::quat_cast(rotation), glm::transpose(rotation) * mat3(m)};
}

mat4 between(const mat4& a, const mat4& b, float t) {
  if (!mayTurn(a, b)) return a * (1.0f - t) + b * t;
  const Parts from = apart(a), to = apart(b);
  const mat3 turn = glm::mat3_cast(glm::slerp(from.turn, to.turn, t));
  mat4 m(turn * (from.stretch * (1.0f - t) + to.stretch * t));
  m[3] = vec4(glm::mix(from.move, to.move, t), 1);
  return m;
}

/// Angle between the rotations of two keys, in radians.
float turned(const mat4& a, const mat4& b) {
  if (!mayTurn(a, b)) return 0;
  return 2 * std::acos(std::min(1.0f, std::abs(glm::dot(apart(a).turn, apart(b).turn))));
}

}  // namespace

mat4 Motion::at(float time) const {
  if (keys.size() == 1 || time <= times.front()) return keys.front();
  if (time >= times.back()) return keys.back();
  size_t k = 1;
  while (times[k] < time) ++k;
  if (times[k] == time) return keys[k];
  return between(keys[k - 1], keys[k], (time - times[k - 1]) / (times[k] - times[k - 1]));
}

Motion Motion::refined() const {
  Motion out{{times[0]}, {keys[0]}};
  for (size_t k = 1; k < keys.size(); ++k) {
    const float pieces = std::ceil(turned(keys[k - 1], keys[k]) / kLargestTurn - 1e-3f);
    for (float i = 1; i < pieces; ++i) {
      const float time = lerp(times[k - 1], times[k], i / pieces);
      if (time > out.times.back() && time < times[k]) {
        out.times.push_back(time);
        out.keys.push_back(at(time));
      }
    }
    out.times.push_back(times[k]);
    out.keys.push_back(keys[k]);
  }
  return out;
}

Motion operator*(const Motion& first, const Motion& second) {
  if (!first.moving() && !second.moving()) return Motion::still(first.keys[0] * second.keys[0]);
  const Motion a = first.refined(), b = second.refined();
  std::vector<float> times;
  if (a.moving()) times.insert(times.end(), a.times.begin(), a.times.end());
  if (b.moving()) times.insert(times.end(), b.times.begin(), b.times.end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  Motion out{times, {}};
  for (const float t : times) out.keys.push_back(a.at(t) * b.at(t));
  return out;
}

}  // namespace tomales
