#include "raytrace/emitters.h"

#include <algorithm>

#include "reyes/dice.h"

namespace tomales {
namespace {

using Corners = std::array<vec3, 4>;

float areaOf(const Corners& q) {
  const auto& [a, b, c, d] = q;
  return 0.5f * (glm::length(cross(b - a, d - a)) + glm::length(cross(d - c, b - c)));
}

/// Position and d/du x d/dv of the bilinear quad.
void bilinear(const Corners& q, float u, float v, vec3& P, vec3& normal) {
  const auto& [a, b, c, d] = q;
  P = glm::mix(glm::mix(a, b, u), glm::mix(d, c, u), v);
  normal = cross(glm::mix(b - a, c - d, v), glm::mix(d - a, c - b, u));
}

/// Where rays see displacement, the polygons are the surface.
bool isCurved(const Scene& scene, const Lattice& lattice) {
  const Object& o = scene.objects[static_cast<size_t>(lattice.object)];
  return !displacesForRays(o) && !o.shape().info(lattice.patch).planar;
}

EmitterLattice latticeOf(const Scene& scene, const CoarseGroup& g, const Lattice& lattice) {
  const bool curved = isCurved(scene, lattice);
  EmitterLattice out{lattice.nu, lattice.nv, g.flipsNormal, {}, {}, curved, curved || lattice.trim ? &g : nullptr, lattice.firstQuad};
  for (uint32_t quad = lattice.firstQuad; quad < lattice.firstQuad + lattice.nu * lattice.nv; ++quad) {
    out.quads.push_back({g.corner(quad, 0), g.corner(quad, 1), g.corner(quad, 2), g.corner(quad, 3)});
    out.normals.push_back(g.geometricNormal(quad));
  }
  return out;
}

EmitterTable tableOf(const Scene& scene, const std::vector<CoarseGroup>& groups) {
  EmitterTable table(scene.lights.size());
  for (size_t g = 0; g < groups.size(); ++g) {
    const int light = scene.groups[g].attributes->areaLight;
    if (light < 0 || light >= static_cast<int>(table.size())) continue;
    EmitterLight& out = table[static_cast<size_t>(light)];
    out.reach = std::max(out.reach, kOffsetFactor * groups[g].deviation);
    for (const Lattice& lattice : groups[g].lattices) out.lattices.push_back(latticeOf(scene, groups[g], lattice));
  }
  return table;
}

}  // namespace

Emitters::Emitters(const Scene& scene, const std::vector<CoarseGroup>& groups) : Emitters(tableOf(scene, groups)) { scene_ = &scene; }

Emitters::Emitters(EmitterTable table) : table_(std::move(table)), lights_(table_.size()) {
  for (size_t light = 0; light < table_.size(); ++light)
    for (uint32_t l = 0; l < table_[light].lattices.size(); ++l) {
      const EmitterLattice& lattice = table_[light].lattices[l];
      Source source{l, {}, std::vector<Distribution>(lattice.rows)};
      for (uint32_t j = 0; j < lattice.rows; ++j) {
        for (uint32_t i = 0; i < lattice.columns; ++i) source.row[j].add(double{areaOf(lattice.quads[j * lattice.columns + i])});
        source.rows.add(source.row[j].total());
      }
      if (!(source.rows.total() > 0)) continue;
      lights_[light].areas.add(source.rows.total());
      lights_[light].sources.push_back(std::move(source));
    }
}

void Emitters::place(const EmitterLattice& from, size_t k, float u, float v, vec3& P, vec3& normal) const {
  if (!from.curved) return bilinear(from.quads[k], u, v, P, normal);
  const CoarseGroup& g = *from.surface;
  const auto quad = from.firstQuad + static_cast<uint32_t>(k);
  const Lattice& lattice = g.latticeOf(quad);
  const vec2 uv = g.patchParameters(quad, u, v);
  const TrueSurface s = surfaceAt(*scene_, lattice.object, lattice.patch, uv.x, uv.y);
  P = s.P;
  const vec2 size((lattice.rect.u1 - lattice.rect.u0) / static_cast<float>(lattice.nu),
                  (lattice.rect.v1 - lattice.rect.v0) / static_cast<float>(lattice.nv));
  const float area = glm::length(cross(s.dPdu, s.dPdv)) * size.x * size.y;
  normal = area * normalizeOr(g.flipsNormal ? -s.normal : s.normal, vec3(0));
  if (normal == vec3(0)) bilinear(from.quads[k], u, v, P, normal);
}

float Emitters::reach(int light) const {
  return light >= 0 && light < static_cast<int>(table_.size()) ? table_[static_cast<size_t>(light)].reach : 0.0f;
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
    const EmitterLattice& lattice = table_[static_cast<size_t>(light)].lattices[source.lattice];
    const size_t quad = row * lattice.columns + column;
    vec3 p, normal;
    place(lattice, quad, static_cast<float>(u), static_cast<float>(v), p, normal);
    const double quadArea = source.row[row].weight(column);
    const bool there = !lattice.surface || lattice.surface->keeps(lattice.firstQuad + static_cast<uint32_t>(quad),
                                                                  static_cast<float>(u), static_cast<float>(v));
    area[i] = quadArea > 0 && there ? static_cast<float>(double{glm::length(normal)} * l.areas.total() / quadArea) : 0.0f;
    normal = normalizeOr(lattice.flipsNormal ? -normal : normal, lattice.normals[quad]);
    P.x[i] = p.x, P.y[i] = p.y, P.z[i] = p.z;
    N.x[i] = normal.x, N.y[i] = normal.y, N.z[i] = normal.z;
  }
  return true;
}

}  // namespace tomales
