#include "reyes/shade/spaces.h"

#include <fmt/format.h>

namespace tomales {
namespace {

/// The raster units of one unit of the space, and the raster position of its origin.
void rasterScale(const Batch& batch, Space::Kind kind, vec2& scale, vec2& origin) {
  const Camera& camera = batch.scene.camera;
  scale = vec2(1.0f);
  origin = vec2(0.0f);
  if (kind == Space::Ndc) scale = {camera.xResolution(), camera.yResolution()};
  if (kind != Space::Screen) return;
  // Screen space is the image plane at z = 1 (orthographic: any), times the focal length.
  const float focal = camera.perspective() ? 1 / std::tan(batch.scene.scene.options.fov_degrees * kPi / 360) : 1.0f;
  origin = camera.raster({0, 0, 1});
  scale = (camera.raster({1, 1, 1}) - origin) / focal;
}

}  // namespace

std::optional<Space> findSpace(const Batch& batch, const std::string& name) {
  if (name == "object") return Space{Space::Linear, batch.group.group->cameraFromObject};
  if (name == "shader") return Space{Space::Linear, batch.running->currentFromShader};
  if (name == "raster") return Space{Space::Raster};
  if (name == "NDC") return Space{Space::Ndc};
  if (name == "screen") return Space{Space::Screen};
  Space space;
  if (!batch.scene.scene.cameraFromNamed(name, space.currentFromSpace)) return std::nullopt;
  return space;
}

vec3 projectedFromCurrent(const Batch& batch, Space::Kind kind, const vec3& p) {
  vec2 scale, origin;
  rasterScale(batch, kind, scale, origin);
  return {(batch.scene.camera.raster(p) - origin) / scale, p.z};
}

vec3 currentFromProjected(const Batch& batch, Space::Kind kind, const vec3& p) {
  vec2 scale, origin;
  rasterScale(batch, kind, scale, origin);
  vec3 eye, direction;
  batch.scene.camera.ray(vec2(p) * scale + origin, eye, direction);
  const float nearest = batch.scene.camera.nearClip();
  const float depth = std::abs(p.z) < nearest ? nearest : p.z;
  return eye + direction * ((depth - eye.z) / direction.z);
}

mat3 environmentDirections(const Batch& batch, const char* name) {
  const std::optional<Space> space = findSpace(batch, name ? name : "world");
  if (space && space->kind == Space::Linear)
    return mat3(batch.scene.cameraFromWorld) * glm::inverse(mat3(space->currentFromSpace));
  batch.report(Severity::Warning, "shader-space",
               fmt::format("looks up an environment in space \"{}\", which is unknown; the world is used", name));
  return mat3(1.0f);
}

}  // namespace tomales
