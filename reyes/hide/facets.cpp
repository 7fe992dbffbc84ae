#include "reyes/hide/facets.h"

#include "reyes/base/rng.h"

namespace tomales {
namespace {

inline float reciprocalLength(float length2) {
  return length2 > 0.0f && length2 < kInfinity ? 1.0f / std::sqrt(length2) : 0.0f;
}

/// Differences at a vertex: centred, one-sided at the border, of the length of one micropolygon.
struct VertexSteps {
  int at, uLo, uHi, vLo, vHi;
  float uScale, vScale;

  VertexSteps(const Grid& g, int vertex) : at(vertex) {
    const int row = g.nu + 1, i = vertex % row, j = vertex / row % (g.nv + 1), first = vertex - j * row - i;
    const int i0 = std::max(i - 1, 0), i1 = std::min(i + 1, g.nu), j0 = std::max(j - 1, 0), j1 = std::min(j + 1, g.nv);
    uLo = first + j * row + i0, uHi = first + j * row + i1, vLo = first + j0 * row + i, vHi = first + j1 * row + i;
    uScale = 1 / static_cast<float>(i1 - i0), vScale = 1 / static_cast<float>(j1 - j0);
  }
  float mean(const float* f) const { return f[at]; }
  float uStep(const float* f) const { return uScale * (f[uHi] - f[uLo]); }
  float vStep(const float* f) const { return vScale * (f[vHi] - f[vLo]); }
};

/// Differences along a cell, the mean of both its sides.
struct CellSteps {
  int a, b, c, d;

  CellSteps(const Grid& g, int cell) : a(cell / g.nu * (g.nu + 1) + cell % g.nu), b(a + 1), c(a + g.nu + 1), d(c + 1) {}
  float mean(const float* f) const { return 0.25f * (f[a] + f[b] + f[c] + f[d]); }
  float uStep(const float* f) const { return 0.5f * ((f[b] - f[a]) + (f[d] - f[c])); }
  float vStep(const float* f) const { return 0.5f * ((f[c] - f[a]) + (f[d] - f[b])); }
};

/// Steps of point i, whose fixed channels are filled. Texture coordinates without primitive variables are bilinear in u, v.
template <class Steps>
void addSteps(const Scene& scene, const Grid& g, const Steps& steps, ShadePoints& points, int i) {
  const ShadeGroup& group = scene.groups[static_cast<size_t>(points.group())];
  const auto put = [&](int value, float u, float v) { points.step(value, false)[i] = u, points.step(value, true)[i] = v; };
  // N as the grid has it may be of any length; that of a shaded point is 1.
  vec3 n;
  for (int axis = 0; axis < 3; ++axis) n[axis] = steps.mean(g.N(axis));
  const float sign = group.subtracted ? -1.0f : 1.0f, scale = sign * reciprocalLength(dot(n, n));
  for (int axis = 0; axis < 3; ++axis) put(kStepN + axis, scale * steps.uStep(g.N(axis)), scale * steps.vStep(g.N(axis)));
  const auto& c = group.attributes->textureCoordinates;
  const float u = points.channel(kU)[i], v = points.channel(kV)[i];
  const vec2 alongU = glm::mix(c[1] - c[0], c[3] - c[2], v), alongV = glm::mix(c[2] - c[0], c[3] - c[1], u);
  const vec2 su = alongU * steps.uStep(g.u()) + alongV * steps.uStep(g.v());
  const vec2 sv = alongU * steps.vStep(g.u()) + alongV * steps.vStep(g.v());
  put(kStepS, su.x, sv.x), put(kStepT, su.y, sv.y);
  int offset = 0;
  for (const Primvar& p : group.primvars) {
    for (int k = 0; k < p.width; ++k) {
      const float* f = g.primvar(offset + k);
      const float uStep = steps.uStep(f), vStep = steps.vStep(f);
      put(kStepPrimvars + offset + k, uStep, vStep);
      if (p.name == "s") put(kStepS, uStep, vStep);
      if (p.name == "t") put(kStepT, uStep, vStep);
    }
    offset += p.width;
  }
}

/// What is left of the way from the first key of a grid to its last, once the motion of the transformation is undone.
template <class Mean>
vec3 driftOf(const Scene& scene, const Grid& g, const Mean& mean) {
  const Object& o = scene.objects[static_cast<size_t>(g.object)];
  if (g.keyCount == 1 || o.shapes.size() == 1) return vec3(0);
  const int last = g.keyCount - 1;
  const vec3 here(mean(g.P(0, 0)), mean(g.P(0, 1)), mean(g.P(0, 2)));
  const vec3 there(mean(g.P(last, 0)), mean(g.P(last, 1)), mean(g.P(last, 2)));
  const mat4 openFromLast = o.cameraFromObject.at(o.keyTimes.front()) * glm::inverse(o.cameraFromObject.at(o.keyTimes.back()));
  return transformPoint(openFromLast, there) - here;
}

/// What is read of the grids, kLanes points at a time.
struct alignas(64) Gathered {
  float P[3][kLanes], N[3][kLanes];
  float uEdge[3][kLanes], vEdge[3][kLanes];  ///< Of P, one micropolygon long.
  float u[kLanes], v[kLanes], du[kLanes], dv[kLanes];

  void readVertex(const Grid& g, int vertex, int i) {
    const VertexSteps steps(g, vertex);
    for (int axis = 0; axis < 3; ++axis) {
      const float* p = g.P(0, axis);
      P[axis][i] = p[vertex], uEdge[axis][i] = steps.uStep(p), vEdge[axis][i] = steps.vStep(p);
      N[axis][i] = g.N(axis)[vertex];
    }
    u[i] = g.u()[vertex], v[i] = g.v()[vertex];
    du[i] = steps.uStep(g.u()), dv[i] = steps.vStep(g.v());
  }

  /// The centre of the cell whose first vertex is `a`.
  void readCell(const Grid& g, int a, int i) {
    const int c = a + g.nu + 1;
    for (int axis = 0; axis < 3; ++axis) {
      const float* p = g.P(0, axis);
      meanAndSteps(p[a], p[a + 1], p[c], p[c + 1], P[axis][i], uEdge[axis][i], vEdge[axis][i]);
      const float* n = g.N(axis);
      N[axis][i] = 0.25f * (n[a] + n[a + 1] + n[c] + n[c + 1]);
    }
    float unused;
    meanAndSteps(g.u()[a], g.u()[a + 1], g.u()[c], g.u()[c + 1], u[i], du[i], unused);
    meanAndSteps(g.v()[a], g.v()[a + 1], g.v()[c], g.v()[c + 1], v[i], unused, dv[i]);
  }

 private:
  static void meanAndSteps(float a, float b, float c, float d, float& mean, float& uStep, float& vStep) {
    mean = 0.25f * (a + b + c + d), uStep = 0.5f * ((b - a) + (d - c)), vStep = 0.5f * ((c - a) + (d - b));
  }
};

/// The fixed channels of kLanes points from `first` on; texture coordinates are the caller's.
struct PointBlock {
  float* channel[kFixedChannels];

  PointBlock(ShadePoints& points, int first) {
    for (int c = 0; c < kFixedChannels; ++c) channel[c] = points.channel(c) + first;
  }
};

/// No branches: all lanes of a vector take both ways.
TOMALES_HOT void derive(const Gathered& g, bool perspective, const PointBlock& out) {
  for (int i = 0; i < kLanes; ++i) {
    const float ux = g.uEdge[0][i], uy = g.uEdge[1][i], uz = g.uEdge[2][i];
    const float vx = g.vEdge[0][i], vy = g.vEdge[1][i], vz = g.vEdge[2][i];
    // For a cell this is half the cross product of the diagonals: its area, exactly so where it is flat.
    const float sx = uy * vz - uz * vy, sy = uz * vx - ux * vz, sz = ux * vy - uy * vx;
    const float nx = g.N[0][i], ny = g.N[1][i], nz = g.N[2][i];
    const float span2 = sx * sx + sy * sy + sz * sz;
    const float toRiSide = sx * nx + sy * ny + sz * nz < 0 ? -1.0f : 1.0f;
    const float perSpan = toRiSide * reciprocalLength(span2);
    const float perNormal = reciprocalLength(nx * nx + ny * ny + nz * nz);
    const bool flat = perSpan == 0, noNormal = perNormal == 0;
    // A direction that is missing is taken from the other normal, and if both are, from the eye.
    const float gx = sx * perSpan, gy = sy * perSpan, gz = sz * perSpan;
    const float hx = nx * perNormal, hy = ny * perNormal, hz = nz * perNormal;
    const float ex = 0, ey = 0, ez = -1;
    const float Nx = noNormal ? (flat ? ex : gx) : hx, Ny = noNormal ? (flat ? ey : gy) : hy,
                Nz = noNormal ? (flat ? ez : gz) : hz;
    const float du = g.du[i] != 0 ? g.du[i] : 1.0f, dv = g.dv[i] != 0 ? g.dv[i] : 1.0f;
    out.channel[kPx][i] = g.P[0][i], out.channel[kPy][i] = g.P[1][i], out.channel[kPz][i] = g.P[2][i];
    out.channel[kNx][i] = Nx, out.channel[kNy][i] = Ny, out.channel[kNz][i] = Nz;
    out.channel[kNgx][i] = flat ? Nx : gx, out.channel[kNgy][i] = flat ? Ny : gy, out.channel[kNgz][i] = flat ? Nz : gz;
    out.channel[kIx][i] = perspective ? g.P[0][i] : 0.0f;
    out.channel[kIy][i] = perspective ? g.P[1][i] : 0.0f;
    out.channel[kIz][i] = perspective ? g.P[2][i] : 1.0f;
    out.channel[kDpduX][i] = ux / du, out.channel[kDpduY][i] = uy / du, out.channel[kDpduZ][i] = uz / du;
    out.channel[kDpdvX][i] = vx / dv, out.channel[kDpdvY][i] = vy / dv, out.channel[kDpdvZ][i] = vz / dv;
    out.channel[kU][i] = g.u[i], out.channel[kV][i] = g.v[i];
    out.channel[kDu][i] = du, out.channel[kDv][i] = dv;
    out.channel[kArea][i] = std::sqrt(span2);
  }
}

int primvarFloats(const ShadeGroup& group) {
  int n = 0;
  for (const Primvar& p : group.primvars) n += p.width;
  return n;
}

/// s and t of points without primitive variables of that name.
void setTextureCoordinates(const ShadeGroup& group, ShadePoints& points) {
  const Attributes& a = *group.attributes;
  const float *u = points.channel(kU), *v = points.channel(kV);
  float *s = points.channel(kS), *t = points.channel(kT);
  for (int i = 0; i < points.count(); ++i) {
    const vec2 st = a.textureAt(u[i], v[i]);
    s[i] = st.x, t[i] = st.y;
  }
  int offset = 0;
  for (const Primvar& p : group.primvars) {
    if (p.name == "s") std::copy_n(points.primvar(offset), points.count(), s);
    if (p.name == "t") std::copy_n(points.primvar(offset), points.count(), t);
    offset += p.width;
  }
}

}  // namespace

FacetTable::FacetTable(const Scene& scene, const Camera& camera, const GridTable& grids, DeepTile& tile)
    : scene_(scene),
      camera_(camera),
      grids_(grids),
      tile_(tile),
      facetOf_(grids.cellCount(), ~0U) {}

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
  const int p = wish(batch, entry, cell, false);
  return {batch, {p, p, p, p}, entry.raster->matte};
}

int FacetTable::cornerPoint(const GridTable::Entry& entry, int batch, int vertex) {
  std::vector<int>& points = corners_[entry.firstCell];
  points.resize(static_cast<size_t>(entry.grid().vertexCount()), -1);
  int& point = points[static_cast<size_t>(vertex)];
  if (point < 0) point = wish(batch, entry, vertex, true);
  return point;
}

int FacetTable::batchOf(int group) {
  // Groups may be added while the bucket is being hidden.
  const auto g = static_cast<size_t>(group);
  if (g >= batchOf_.size()) batchOf_.resize(g + 1, -1);
  int& batch = batchOf_[g];
  if (batch < 0) {
    batch = static_cast<int>(wishes_.size());
    wishes_.push_back({group, {}});
  }
  return batch;
}

int FacetTable::wish(int batch, const GridTable::Entry& entry, int index, bool vertex) {
  std::vector<Wish>& list = wishes_[static_cast<size_t>(batch)].list;
  list.push_back({static_cast<uint32_t>(&entry - grids_.entries().data()), index, vertex});
  return static_cast<int>(list.size()) - 1;
}

void FacetTable::makePoints() {
  tile_.batches.reserve(wishes_.size());
  for (const Wishes& wishes : wishes_) {
    const ShadeGroup& group = scene_.groups[static_cast<size_t>(wishes.group)];
    ShadePoints& points = tile_.batches.emplace_back(wishes.group, primvarFloats(group), group.steps);
    points.reserve(static_cast<int>(wishes.list.size()));
    fill(wishes, points);
    setTextureCoordinates(group, points);
  }
}

void FacetTable::fill(const Wishes& wishes, ShadePoints& points) const {
  Gathered gathered{};
  const bool subtracted = scene_.groups[static_cast<size_t>(wishes.group)].subtracted;
  const int count = static_cast<int>(wishes.list.size()), floats = points.primvarFloats();
  for (int first = 0; first < count; first += kLanes) {
    const int lanes = std::min(kLanes, count - first);
    for (int i = 0; i < lanes; ++i) {
      const Wish& w = wishes.list[static_cast<size_t>(first + i)];
      const Grid& g = grids_.entries()[w.entry].grid();
      const int ofPiece = w.vertex ? g.verticesOfPiece() : g.nu * (g.nv + 1), piece = w.index / ofPiece;
      points.add(hashCombine(g.pieces[static_cast<size_t>(piece)].name, static_cast<uint32_t>(w.index - piece * ofPiece)));
      points.channel(kTime)[first + i] = -1;
      if (w.vertex) {
        gathered.readVertex(g, w.index, i);
        for (int k = 0; k < floats; ++k) points.primvar(k)[first + i] = g.primvar(k)[w.index];
        points.set3(kDriftX, first + i, driftOf(scene_, g, [&](const float* f) { return f[w.index]; }));
      } else {
        const int a = w.index / g.nu * (g.nu + 1) + w.index % g.nu, c = a + g.nu + 1;
        gathered.readCell(g, a, i);
        points.set3(kDriftX, first + i,
                    driftOf(scene_, g, [&](const float* f) { return 0.25f * (f[a] + f[a + 1] + f[c] + f[c + 1]); }));
        for (int k = 0; k < floats; ++k) {
          const float* f = g.primvar(k);
          points.primvar(k)[first + i] = 0.25f * (f[a] + f[a + 1] + f[c] + f[c + 1]);
        }
      }
    }
    if (subtracted)
      for (auto& axis : gathered.N)
        for (float& n : axis) n = -n;
    derive(gathered, camera_.perspective(), PointBlock(points, first));
    for (int i = 0; points.hasSteps() && i < lanes; ++i) {
      const Wish& w = wishes.list[static_cast<size_t>(first + i)];
      const Grid& g = grids_.entries()[w.entry].grid();
      if (w.vertex)
        addSteps(scene_, g, VertexSteps(g, w.index), points, first + i);
      else
        addSteps(scene_, g, CellSteps(g, w.index), points, first + i);
    }
  }
}

}  // namespace tomales
