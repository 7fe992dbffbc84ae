#include "gi/photon_cone.h"

#include "gi/photon_emission.h"

namespace tomales {

PhotonCone::PhotonCone(const vec3& center, const vec3& light, float radius) : origin_(center + light) {
  const float distance = glm::length(light);
  if (distance <= radius) return;
  const vec3 axis = -light / distance;
  vec3 tangent, bitangent;
  orthonormalBasis(axis, tangent, bitangent);
  const double sine = double{radius} / double{distance};
  frame_ = mat3(tangent, bitangent, axis);
  origin_ = center;
  height_ = static_cast<float>(sine * sine / (1 + std::sqrt(1 - sine * sine)));
  distance_ = distance;
  start_ = std::max(0.0f, distance - kOutside * radius);
}

vec3 PhotonCone::local(size_t cell, vec2 at) const {
  const auto row = static_cast<float>(cell / kColumns), column = static_cast<float>(cell % kColumns);
  const float missing = height_ * (row + at.y) / kRows, phi = 2 * kPi * (column + at.x) / kColumns;
  const float r = std::sqrt(std::max(0.0f, missing * (2 - missing)));
  return {r * std::cos(phi), r * std::sin(phi), missing};
}

double PhotonCone::cellSolidAngle() const { return 2 * double{kPi} * double{height_} / kCells; }

vec3 PhotonCone::place(const vec3& local, float distance) const {
  return origin_ + frame_ * vec3(distance * local.x, distance * local.y, (distance - distance_) - distance * local.z);
}

}  // namespace tomales
