#include "raytrace/emitters.h"

namespace tomales {
namespace {

float areaOf(const CoarseGroup& g, uint32_t quad) {
  const vec3 a = g.corner(quad, 0), b = g.corner(quad, 1), c = g.corner(quad, 2), d = g.corner(quad, 3);
  return 0.5f * (glm::length(cross(b - a, d - a)) + glm::length(cross(d - c, b - c)));
}

/// Position and d/du x d/dv of the bilinear quad.
void bilinear(const CoarseGroup& g, uint32_t quad, float u, float v, vec3& P, vec3& normal) {
  const vec3 a = g.corner(quad, 0), b = g.corner(quad, 1), c = g.corner(quad, 2), d = g.corner(quad, 3);
  P = glm::mix(glm::mix(a, b, u), glm::mix(d, c, u), v);
  normal = cross(glm::mix(b - a, c - d, v), glm::mix(d - a, c - b, u));
}

}  // namespace

Emitters::Emitters(const Scene& scene, const std::vector<CoarseGroup>& groups)
    : groups_(groups), lights_(scene.lights.size()) {
  for (uint32_t g = 0; g < groups.size(); ++g) {
    const int light = scene.groups[g].attributes->areaLight;
    if (light < 0 || light >= static_cast<int>(lights_.size())) continue;
    Light& out = lights_[static_cast<size_t>(light)];
    if (out.cumulated_area.empty()) out.cumulated_area.push_back(0);
    for (uint32_t quad = 0; quad < groups[g].quads.size(); ++quad) {
      const float area = areaOf(groups[g], quad);
      if (!(area > 0)) continue;
      out.sources.push_back({g, quad});
      out.cumulated_area.push_back(out.cumulated_area.back() + double{area});
    }
  }
}

bool Emitters::sample(int light, int count, const float* xi0, const float* xi1, TmVec3 P, TmVec3 N,
                      float* area) const {
  if (light < 0 || light >= static_cast<int>(lights_.size())) return false;
  const Light& l = lights_[static_cast<size_t>(light)];
  if (l.sources.empty()) return false;
  const double total = l.cumulated_area.back();
  for (int i = 0; i < count; ++i) {
    const double at = double{xi0[i]} * total;
    const auto next = std::upper_bound(l.cumulated_area.begin() + 1, l.cumulated_area.end() - 1, at);
    const auto k = static_cast<size_t>(next - l.cumulated_area.begin()) - 1;
    const double quadArea = l.cumulated_area[k + 1] - l.cumulated_area[k];
    const auto u = static_cast<float>(std::clamp((at - l.cumulated_area[k]) / quadArea, 0.0, 1.0));
    const CoarseGroup& g = groups_[l.sources[k].group];
    vec3 p, normal;
    bilinear(g, l.sources[k].quad, u, xi1[i], p, normal);
    area[i] = static_cast<float>(double{glm::length(normal)} * total / quadArea);
    normal = normalizeOr(g.flipsNormal ? -normal : normal, g.geometricNormal(l.sources[k].quad));
    P.x[i] = p.x, P.y[i] = p.y, P.z[i] = p.z;
    N.x[i] = normal.x, N.y[i] = normal.y, N.z[i] = normal.z;
  }
  return true;
}

}  // namespace tomales
