#include "raytrace/emitters.h"

#include <algorithm>

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

EmitterLattice latticeOf(const CoarseGroup& g, const Lattice& lattice) {
  EmitterLattice out{lattice.nu, lattice.nv, g.flipsNormal, {}, {}, lattice.trim ? &g : nullptr, lattice.firstQuad};
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
    for (const Lattice& lattice : groups[g].lattices) table[static_cast<size_t>(light)].push_back(latticeOf(groups[g], lattice));
  }
  return table;
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

Emitters::Emitters(const Scene& scene, const std::vector<CoarseGroup>& groups) : Emitters(tableOf(scene, groups)) {}

Emitters::Emitters(EmitterTable table) : table_(std::move(table)), lights_(table_.size()) {
  for (size_t light = 0; light < table_.size(); ++light)
    for (uint32_t l = 0; l < table_[light].size(); ++l) {
      const EmitterLattice& lattice = table_[light][l];
      Source source{l, {}, std::vector<Cumulated>(lattice.rows)};
      for (uint32_t j = 0; j < lattice.rows; ++j) {
        for (uint32_t i = 0; i < lattice.columns; ++i) source.row[j].add(double{areaOf(lattice.quads[j * lattice.columns + i])});
        source.rows.add(source.row[j].total());
      }
      if (!(source.rows.total() > 0)) continue;
      lights_[light].areas.add(source.rows.total());
      lights_[light].sources.push_back(std::move(source));
    }
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
    const EmitterLattice& lattice = table_[static_cast<size_t>(light)][source.lattice];
    const size_t quad = row * lattice.columns + column;
    vec3 p, normal;
    bilinear(lattice.quads[quad], static_cast<float>(u), static_cast<float>(v), p, normal);
    const double quadArea = source.row[row].sums[column + 1] - source.row[row].sums[column];
    const bool there = !lattice.trimmed || lattice.trimmed->keeps(lattice.firstQuad + static_cast<uint32_t>(quad),
                                                                  static_cast<float>(u), static_cast<float>(v));
    area[i] = quadArea > 0 && there ? static_cast<float>(double{glm::length(normal)} * l.areas.total() / quadArea) : 0.0f;
    normal = normalizeOr(lattice.flipsNormal ? -normal : normal, lattice.normals[quad]);
    P.x[i] = p.x, P.y[i] = p.y, P.z[i] = p.z;
    N.x[i] = normal.x, N.y[i] = normal.y, N.z[i] = normal.z;
  }
  return true;
}

}  // namespace tomales
