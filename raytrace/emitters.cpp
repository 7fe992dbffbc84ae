#include "raytrace/emitters.h"

#include <algorithm>

#include "reyes/dice.h"

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

size_t Emitters::Cumulated::pick(double& x) const {
  const double at = x * total();
  const auto next = std::upper_bound(sums.begin() + 1, sums.end() - 1, at);
  const auto k = static_cast<size_t>(next - sums.begin()) - 1;
  const double part = sums[k + 1] - sums[k];
  x = part > 0 ? std::clamp((at - sums[k]) / part, 0.0, 1.0) : 0.5;
  return k;
}

Emitters::Emitters(const Scene& scene, const std::vector<CoarseGroup>& groups)
    : scene_(scene), groups_(groups), lights_(scene.lights.size()) {
  for (uint32_t g = 0; g < groups.size(); ++g) {
    const int light = scene.groups[g].attributes->areaLight;
    if (light < 0 || light >= static_cast<int>(lights_.size())) continue;
    Light& out = lights_[static_cast<size_t>(light)];
    for (const Lattice& lattice : groups[g].lattices) {
      const Object& o = scene.objects[static_cast<size_t>(lattice.object)];
      const bool displaced = o.attributes->trace.displacements && o.attributes->displacement;
      Source source{g, lattice.firstQuad, lattice.nu, displaced || o.shape().info(lattice.patch).planar, {},
                    std::vector<Cumulated>(lattice.nv)};
      for (uint32_t j = 0; j < lattice.nv; ++j) {
        for (uint32_t i = 0; i < lattice.nu; ++i)
          source.row[j].add(double{areaOf(groups[g], lattice.firstQuad + j * lattice.nu + i)});
        source.rows.add(source.row[j].total());
      }
      if (!(source.rows.total() > 0)) continue;
      out.areas.add(source.rows.total());
      out.sources.push_back(std::move(source));
    }
  }
}

void Emitters::place(const Source& source, uint32_t quad, float u, float v, vec3& P, vec3& normal) const {
  const CoarseGroup& g = groups_[source.group];
  if (source.exact) return bilinear(g, quad, u, v, P, normal);
  const Lattice& lattice = g.latticeOf(quad);
  const vec2 uv = g.patchParameters(quad, u, v);
  const TrueSurface s = surfaceAt(scene_, lattice.object, lattice.patch, uv.x, uv.y);
  P = s.P;
  const vec2 size((lattice.rect.u1 - lattice.rect.u0) / static_cast<float>(lattice.nu),
                  (lattice.rect.v1 - lattice.rect.v0) / static_cast<float>(lattice.nv));
  const float area = glm::length(cross(s.dPdu, s.dPdv)) * size.x * size.y;
  normal = area * normalizeOr(g.flipsNormal ? -s.normal : s.normal, vec3(0));
  if (normal == vec3(0)) bilinear(g, quad, u, v, P, normal);
}

bool Emitters::sample(int light, int count, const float* xi0, const float* xi1, TmVec3 P, TmVec3 N,
                      float* area) const {
  if (light < 0 || light >= static_cast<int>(lights_.size())) return false;
  const Light& l = lights_[static_cast<size_t>(light)];
  if (l.sources.empty()) return false;
  for (int i = 0; i < count; ++i) {
    double u{xi0[i]}, v{xi1[i]};
    const Source& source = l.sources[l.areas.pick(u)];
    const size_t row = source.rows.pick(v), column = source.row[row].pick(u);
    const auto quad = static_cast<uint32_t>(source.firstQuad + row * source.columns + column);
    const CoarseGroup& g = groups_[source.group];
    vec3 p, normal;
    place(source, quad, static_cast<float>(u), static_cast<float>(v), p, normal);
    const double quadArea = source.row[row].sums[column + 1] - source.row[row].sums[column];
    area[i] = quadArea > 0 && g.keeps(quad, static_cast<float>(u), static_cast<float>(v))
                  ? static_cast<float>(double{glm::length(normal)} * l.areas.total() / quadArea) : 0.0f;
    normal = normalizeOr(g.flipsNormal ? -normal : normal, g.geometricNormal(quad));
    P.x[i] = p.x, P.y[i] = p.y, P.z[i] = p.z;
    N.x[i] = normal.x, N.y[i] = normal.y, N.z[i] = normal.z;
  }
  return true;
}

}  // namespace tomales
