#include "gi/atlas/sight_lines.h"

#include "gi/world_from_current.h"

namespace tomales {
namespace {

constexpr float kStands = 0.5f;  ///< Cosine between the normals of a wall and of what it stands on, at most.

}  // namespace

SightAlongSurface sightAlongSurfaces(const RayScene& rays) {
  return [&rays, world = WorldFromCurrent(rays.scene()), current = rays.scene().cameraFromWorldAtOpen()](
             const vec3& worldP, const vec3& worldN, float worldReach) {
    const vec3 P = transformPoint(current, worldP), N = normalizeOr(world.currentNormals * worldN, vec3(0, 0, 1));
    const float reach = worldReach / world.scale, lift = kSightLift * reach;
    const auto hitOf = [&](const vec3& from, const vec3& direction, float tMax) {
      Ray ray{from, direction};
      ray.tMax = tMax;
      return rays.closest(ray, kMaskPhoton);
    };
    const auto groupBelow = [&](const vec3& from) {
      const Hit hit = hitOf(from, -N, 2 * lift);
      return hit.object < 0 ? -1 : rays.groupOf(hit);
    };
    const vec3 start = P + lift * N;
    const int here = groupBelow(start);
    vec3 tangent, bitangent;
    orthonormalBasis(worldN, tangent, bitangent);
    SightLines out;
    for (size_t k = 0; k < kSightLines; ++k) {
      out[k] = worldReach;
      const float angle = 2 * kPi * static_cast<float>(k) / kSightLines;
      const vec3 along =
          normalizeOr(transformVector(current, std::cos(angle) * tangent + std::sin(angle) * bitangent), N);
      const Hit wall = hitOf(start, along, reach);
      if (wall.object < 0 || std::abs(dot(wall.geometricNormal, N)) > kStands) continue;
      const auto goesOnAt = [&](float t) { return here >= 0 && groupBelow(start + t * along) == here; };
      // Two places behind the wall are tried, because the underside of a solid wall may lie on the surface and be met
      // instead of it.
      if (goesOnAt(0.5f * (wall.t + reach)) || goesOnAt(reach)) out[k] = wall.t * world.scale;
    }
    return out;
  };
}

}  // namespace tomales
