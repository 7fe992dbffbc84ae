#include "reyes/hide/facets.h"

#include "reyes/base/rng.h"

namespace tomales {

/// How a point reads a grid: its value is the mean over four vertices, its step along u the scaled difference
/// of two sums.
struct FacetTable::Stencil {
  int at[4];
  int uLo[2], uHi[2], vLo[2], vHi[2];
  float uScale, vScale;

  static Stencil cell(const Grid& g, int cell) {
    const int row = g.nu + 1, a = cell / g.nu * row + cell % g.nu, b = a + 1, c = a + row, d = c + 1;
    return {{a, b, c, d}, {a, c}, {b, d}, {a, b}, {c, d}, 0.5f, 0.5f};
  }
  static Stencil vertex(const Grid& g, int vertex) {
    const int row = g.nu + 1, i = vertex % row, j = vertex / row;
    const int i0 = std::max(i - 1, 0), i1 = std::min(i + 1, g.nu), j0 = std::max(j - 1, 0),
              j1 = std::min(j + 1, g.nv);
    const int uLo = j * row + i0, uHi = j * row + i1, vLo = j0 * row + i, vHi = j1 * row + i;
    return {{vertex, vertex, vertex, vertex},
            {uLo, uLo},
            {uHi, uHi},
            {vLo, vLo},
            {vHi, vHi},
            0.5f / static_cast<float>(i1 - i0),
            0.5f / static_cast<float>(j1 - j0)};
  }

  float mean(const float* f) const { return 0.25f * (f[at[0]] + f[at[1]] + f[at[2]] + f[at[3]]); }
  float uStep(const float* f) const { return uScale * ((f[uHi[0]] - f[uLo[0]]) + (f[uHi[1]] - f[uLo[1]])); }
  float vStep(const float* f) const { return vScale * ((f[vHi[0]] - f[vLo[0]]) + (f[vHi[1]] - f[vLo[1]])); }
};

namespace {

constexpr int kFirstPoints = 128;  ///< Room in a new batch; a bucket of 16 x 16 px often sees as many.

float orOne(float x) { return x != 0 ? x : 1.0f; }

int primvarFloats(const ShadeGroup& group) {
  int n = 0;
  for (const Primvar& p : group.primvars) n += p.width;
  return n;
}

}  // namespace

FacetTable::FacetTable(const Scene& scene, const Camera& camera, const GridTable& grids, DeepTile& tile)
    : scene_(scene),
      camera_(camera),
      grids_(grids),
      tile_(tile),
      facetOf_(grids.cellCount(), ~0U),
      batchOf_(scene.groups.size(), -1) {}

uint32_t FacetTable::facetOf(uint32_t cell) {
  uint32_t& facet = facetOf_[cell];
  if (facet == ~0U) {
    facet = static_cast<uint32_t>(tile_.facets.size());
    const GridTable::Entry& entry = grids_.of(cell);
    tile_.facets.push_back(makeFacet(entry, static_cast<int>(cell - entry.firstCell)));
  }
  return facet;
}

Facet FacetTable::makeFacet(const GridTable::Entry& entry, int cell) {
  const Grid& g = entry.grid();
  const int batch = batchOf(scene_.objects[static_cast<size_t>(g.object)].group);
  if (entry.raster->smooth) {
    const int row = g.nu + 1, a = cell / g.nu * row + cell % g.nu;
    Facet facet{batch, {}, entry.raster->matte};
    const int corner[4] = {a, a + 1, a + row, a + row + 1};
    for (int k = 0; k < 4; ++k) facet.point[k] = cornerPoint(entry, batch, corner[k]);
    return facet;
  }
  const int p = addPoint(g, batch, Stencil::cell(g, cell), hashCombine(g.name, static_cast<uint32_t>(cell)));
  return {batch, {p, p, p, p}, entry.raster->matte};
}

int FacetTable::cornerPoint(const GridTable::Entry& entry, int batch, int vertex) {
  const Grid& g = entry.grid();
  std::vector<int>& points = corners_[entry.firstCell];
  points.resize(static_cast<size_t>(g.vertexCount()), -1);
  int& point = points[static_cast<size_t>(vertex)];
  if (point < 0)
    point =
        addPoint(g, batch, Stencil::vertex(g, vertex), hashCombine(g.name, static_cast<uint32_t>(vertex)));
  return point;
}

int FacetTable::batchOf(int group) {
  int& batch = batchOf_[static_cast<size_t>(group)];
  if (batch < 0) {
    batch = static_cast<int>(tile_.batches.size());
    tile_.batches.emplace_back(group, primvarFloats(scene_.groups[static_cast<size_t>(group)]));
    tile_.batches.back().reserve(kFirstPoints);
  }
  return batch;
}

int FacetTable::addPoint(const Grid& g, int batch, const Stencil& at, uint32_t key) {
  ShadePoints& points = tile_.batches[static_cast<size_t>(batch)];
  const ShadeGroup& group = scene_.groups[static_cast<size_t>(points.group())];
  const int i = points.add(key);
  const auto set = [&](int channel, float value) { points.channel(channel)[i] = value; };
  const float *x = g.P(0, 0), *y = g.P(0, 1), *z = g.P(0, 2);
  const vec3 P(at.mean(x), at.mean(y), at.mean(z));
  const vec3 uEdge(at.uStep(x), at.uStep(y), at.uStep(z)), vEdge(at.vStep(x), at.vStep(y), at.vStep(z));
  // For a cell this is half the cross product of the diagonals: its area, exactly so where it is flat.
  const vec3 span = cross(uEdge, vEdge);
  const float side = group.subtracted ? -1.0f : 1.0f;
  const vec3 shading = side * vec3(at.mean(g.N(0)), at.mean(g.N(1)), at.mean(g.N(2)));
  const vec3 toRiSide = dot(span, shading) < 0 ? -span : span;
  const vec3 N = normalizeOr(shading, normalizeOr(toRiSide, vec3(0, 0, -1)));
  const float u = at.mean(g.u()), v = at.mean(g.v()), du = orOne(at.uStep(g.u())),
              dv = orOne(at.vStep(g.v()));
  points.set3(kPx, i, P);
  points.set3(kNx, i, N);
  points.set3(kNgx, i, normalizeOr(toRiSide, N));
  points.set3(kIx, i, camera_.incident(P));
  points.set3(kDpduX, i, uEdge / du);
  points.set3(kDpdvX, i, vEdge / dv);
  set(kU, u), set(kV, v), set(kDu, du), set(kDv, dv), set(kArea, glm::length(span));
  const vec2 st = group.attributes->textureAt(u, v);
  set(kS, st.x), set(kT, st.y);
  int offset = 0;
  for (const Primvar& p : group.primvars) {
    for (int k = 0; k < p.width; ++k) points.primvar(offset + k)[i] = at.mean(g.primvar(offset + k));
    if (p.name == "s") set(kS, points.primvar(offset)[i]);
    if (p.name == "t") set(kT, points.primvar(offset)[i]);
    offset += p.width;
  }
  return i;
}

}  // namespace tomales
