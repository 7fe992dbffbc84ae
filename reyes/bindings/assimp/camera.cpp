#include "reyes/bindings/assimp/camera.h"

#include <assimp/defs.h>

#include "reyes/bindings/assimp/nodes.h"

namespace tomales::model {
namespace {

mat4 lookingAlong(const glm::dvec3& from, const glm::dvec3& forward, const glm::dvec3& up) {
  const glm::dvec3 z = glm::normalize(forward), x = glm::normalize(glm::cross(z, up)), y = glm::cross(x, z);
  return mat4(vec4(vec3(x), 0), vec4(vec3(y), 0), vec4(vec3(z), 0), vec4(vec3(from), 1));
}

/// Returns a vector that is not parallel to `forward`.
vec3 usableUp(const vec3& forward, const vec3& up) {
  const vec3 side = cross(normalizeOr(forward, vec3(0, 0, -1)), normalizeOr(up, vec3(0.0f)));
  if (dot(side, side) > 1e-8f) return up;
  return std::abs(forward.y) < 0.9f * glm::length(forward) ? vec3(0, 1, 0) : vec3(0, 0, 1);
}

}  // namespace

aiCamera gltfCamera(const aiCamera& camera) {
  aiCamera out = camera;
  const float aspect = camera.mAspect > 0 ? camera.mAspect : 1, vertical = camera.mHorizontalFOV / aspect;
  out.mPosition = {};
  out.mHorizontalFOV = 2 * std::atan(std::tan(glm::clamp(vertical, 0.01f, 3.1f) / 2) * aspect);
  return out;
}

Camera cameraOf(const aiCamera& camera, const mat4& worldFromNode) {
  Camera out;
  const vec3 forward = normalizeOr(transformVector(worldFromNode, of(camera.mLookAt)), vec3(0, 0, -1)),
             up = transformVector(worldFromNode, of(camera.mUp));
  out.worldFromCamera =
      lookingAlong(transformPoint(worldFromNode, of(camera.mPosition)), forward, usableUp(forward, up));
  if (camera.mAspect > 0.05f && camera.mAspect < 20) out.aspect = camera.mAspect;
  if (camera.mOrthographicWidth > 0) out.orthographic_halfWidth = camera.mOrthographicWidth;
  // Assimp 5.2 does not read cameras of COLLADA that have no name, and converts its default angle, which is in radians,
  // as if it were in degrees.
  out.isAngleKnown = camera.mHorizontalFOV != AI_DEG_TO_RAD(aiCamera().mHorizontalFOV);
  if (!out.isAngleKnown) return out;
  // Without an aspect the angle is that of a square picture.
  const bool landscape = camera.mAspect > 1 && out.aspect == camera.mAspect;
  const float half = std::tan(glm::clamp(camera.mHorizontalFOV, 0.01f, 3.1f) / 2);
  out.fov_degrees = 2 * glm::degrees(std::atan(landscape ? half / out.aspect : half));
  return out;
}

Camera cameraAround(const Bound3& box) {
  constexpr double kMargin = 1.08;
  Camera out;
  const glm::dvec3 lo = box.lo, hi = box.hi, center = 0.5 * (lo + hi),
                   forward = glm::normalize(glm::dvec3(-0.6, -0.45, -1));
  const mat4 axes = lookingAlong(glm::dvec3(0), forward, glm::dvec3(0, 1, 0));
  const double tanY = std::tan(glm::radians(out.fov_degrees) / 2), tanX = tanY * out.aspect;
  double distance = 0;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 p = (glm::dvec3(box.corner(i)) - center) * kMargin;
    const double x = glm::dot(p, glm::dvec3(axes[0])), y = glm::dot(p, glm::dvec3(axes[1])), z = glm::dot(p, forward);
    distance = std::max({distance, std::abs(x) / tanX - z, std::abs(y) / tanY - z});
  }
  out.worldFromCamera = axes;
  out.worldFromCamera[3] = vec4(vec3(center - (distance > 0 ? distance : 1.0) * forward), 1);
  return out;
}

Requests requestsOf(const Camera& camera) {
  constexpr float kHeight_px = 720;
  const float wide = camera.aspect >= 1 ? camera.aspect : 1, high = wide / camera.aspect;
  Requests out{call("Format", std::round(kHeight_px * wide), std::round(kHeight_px * high), 1.0f)};
  if (camera.orthographic_halfWidth > 0) {
    const float w = camera.orthographic_halfWidth, h = w / camera.aspect;
    out.push_back(call("Projection", "orthographic"));
    out.push_back(call("ScreenWindow", -w, w, -h, h));
  } else {
    out.push_back(callWith({param("fov", camera.fov_degrees)}, "Projection", "perspective"));
  }
  out.push_back(call("ConcatTransform", glm::inverse(camera.worldFromCamera)));
  return out;
}

}  // namespace tomales::model
